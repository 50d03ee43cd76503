# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves behind optics against exact solutions that know nothing of our tracer.

Stigmatic surfaces (paraboloid, ellipsoid, hyperboloid) have waves in closed form; a singlet is
solved by Fermat's principle in 30 digits.
"""

import mpmath as mp
import numpy as np
import pytest

from hoe_addon.core.arrays import unit
from hoe_addon.core.ray_fitting import FitStatus, OpticalSurface, OpticalSystem, fit_rays
from hoe_addon.core.tracer import Frame
from hoe_addon.core.waves import PlaneWave, PointSource
from hoe_addon.core.waves.system import SystemWave

DIRECTION = 1e-11
"""rad; a landing error of 1e-16 m over centimetres is 1e-14, and surfaces add their rounding."""

PATH = 1e-14
"""m; some roundings of half a metre."""

DIFFERENCES = 1e-7
"""Differences of fourth order over 10 um: 1e-16 m of rounding over 1e-5 m is 1e-11."""

MM = 1e-3
INFINITE = float("inf")

# Everything is turned and moved off the hologram's frame, so that no axis is special.
PLACED = Frame.at((3 * MM, -2 * MM, 5 * MM), (0.3, -0.2, 0.9))


def surface(z_mm, radius_mm, conic, semi_diameter_mm, index_after, normal=(0.0, 0.0, 1.0)):
    """A surface on the axis of the placed frame."""
    vertex = PLACED.point_to_world(np.array([0.0, 0.0, z_mm * MM]))
    frame = Frame.at(vertex, PLACED.vector_to_world(unit(normal)))
    return OpticalSurface(frame, radius_mm * MM, conic, semi_diameter_mm * MM, index_after)


def place(x_mm, y_mm, z_mm):
    return tuple(PLACED.point_to_world(np.array([x_mm, y_mm, z_mm]) * MM).tolist())


def along(x, y, z):
    return tuple(PLACED.vector_to_world(np.array([x, y, z], dtype=float)).tolist())


def points(rng, radius_mm, z_mm, count=300):
    """Points of a disc at about z, not all in one plane."""
    r, phi = radius_mm * np.sqrt(rng.random(count)), rng.uniform(0, 2 * np.pi, count)
    local = np.stack((r * np.cos(phi), r * np.sin(phi), z_mm + rng.uniform(-1, 1, count)), axis=-1)
    return PLACED.point_to_world(local * MM)


def check_against(system, exact, where):
    """The fit equals an exact wave: directions, and paths up to one constant."""
    fit = fit_rays(system, where)
    assert np.all(fit.status == FitStatus.FITTED), fit.report()
    assert fit.error.max() <= 1e-13
    difference = system.index * fit.direction - exact.gradient(where)
    assert np.abs(difference).max() < DIRECTION
    offset = fit.path - exact.eikonal(where)
    assert np.ptp(offset) < PATH
    check_slope(SystemWave(system), where[:50])


def check_slope(wave, where):
    """The path's differences are n s, and |n s| is n."""
    step = 1e-5
    slope = np.empty(where.shape)
    for column, axis in enumerate(np.eye(3)):
        near, far = (
            wave.eikonal(where + k * step * axis) - wave.eikonal(where - k * step * axis)
            for k in (1, 2)
        )
        slope[:, column] = (8 * near - far) / (12 * step)
    gradient = wave.gradient(where)
    assert np.abs(slope - gradient).max() < DIFFERENCES
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=-1), wave.index, rtol=1e-14)


def test_point_at_the_focus_of_a_paraboloid_mirror_gives_a_plane_wave(rng):
    # Light goes toward -z, meets the hollow side, comes back along +z.
    system = OpticalSystem(PointSource(place(0, 0, 50)), (surface(0, 100, -1.0, 40, None),))
    check_against(system, PlaneWave(along(0, 0, 1)), points(rng, 30, 90))


def test_plane_wave_on_a_paraboloid_mirror_converges_to_its_focus(rng):
    system = OpticalSystem(PlaneWave(along(0, 0, -1)), (surface(0, 100, -1.0, 40, None),))
    check_against(system, PointSource(place(0, 0, 50), converging=True), points(rng, 15, 25))


def test_ellipsoid_mirror_from_focus_to_focus(rng):
    eccentricity, radius = 0.6, 60.0
    near, far = radius / (1 + eccentricity), radius / (1 - eccentricity)
    mirror = surface(0, radius, -(eccentricity**2), 30, None)
    system = OpticalSystem(PointSource(place(0, 0, near)), (mirror,))
    exact = PointSource(place(0, 0, far), converging=True)
    check_against(system, exact, points(rng, 8, 60))
    # The other way round, and beyond the near focus, where the beam diverges again.
    system = OpticalSystem(PointSource(place(0, 0, far)), (mirror,))
    check_against(system, PointSource(place(0, 0, near)), points(rng, 10, 70))


def test_hyperbolic_exit_face_focuses_a_plane_wave_out_of_glass(rng):
    # A Cartesian surface of a focus and a point at infinity has the conic -n^2; f = R / (n - 1).
    index, radius = 1.7, 35.0
    system = OpticalSystem(
        PlaneWave(along(0, 0, 1), index), (surface(0, -radius, -(index**2), 20, 1.0),)
    )
    exact = PointSource(place(0, 0, radius / (index - 1)), converging=True)
    check_against(system, exact, points(rng, 8, 20))


def test_plane_then_hyperbolic_face_collimates_a_converging_beam_reversed(rng):
    # The same lens from the other end: a point in air becomes a plane wave in glass, and goes
    # straight through a plane face into air.
    index, radius = 1.7, 35.0
    focus = radius / (index - 1)
    system = OpticalSystem(
        PointSource(place(0, 0, -focus)),
        (surface(0, radius, -(index**2), 20, index), surface(12, INFINITE, 0.0, 20, 1.0)),
    )
    check_against(system, PlaneWave(along(0, 0, 1)), points(rng, 12, 40))


def test_elliptic_face_focuses_a_plane_wave_into_glass(rng):
    # Into glass the conic is -1/n^2, and the focus lies at n R / (n - 1).
    index, radius = 1.5, 20.0
    system = OpticalSystem(
        PlaneWave(along(0, 0, 1)), (surface(0, radius, -1 / index**2, 14, index),)
    )
    exact = PointSource(place(0, 0, index * radius / (index - 1)), converging=True, index=index)
    check_against(system, exact, points(rng, 5, 30))


def test_aplanatic_sphere_takes_a_converging_beam_to_its_other_point(rng):
    # A sphere of index n in air: a beam headed to n R from the centre converges at R / n.
    index, radius = 1.6, 25.0
    system = OpticalSystem(
        PointSource(place(0, 0, radius + index * radius), converging=True),
        (surface(0, radius, 0.0, 15, index),),
    )
    exact = PointSource(place(0, 0, radius + radius / index), converging=True, index=index)
    check_against(system, exact, points(rng, 5, 15))


def test_far_source_keeps_all_digits(rng):
    # A point a thousand kilometres away makes a plane wave within the float64 of its distance.
    mirror = (surface(0, 100, -1.0, 40, None),)
    where = points(rng, 15, 25)
    far = fit_rays(OpticalSystem(PointSource(place(0, 0, 1e9)), mirror), where)
    plane = fit_rays(OpticalSystem(PlaneWave(along(0, 0, -1)), mirror), where)
    # The waves differ by an angle of 25 mm over 1000 km, the size of the point's own parallax.
    assert np.abs(far.direction - plane.direction).max() < 1e-7
    assert far.error.max() <= 1e-13


# A tilted singlet: positions along the axis in mm, tilt of the second face, index.
TILTED = (0.1, -0.05, 1.0)
SINGLET = (surface(0, 40, 0.0, 9, 1.62), surface(6, -55, 0.0, 9, 1.0, TILTED))


def fermat(source, where, sign):
    """Direction and path at a point by Fermat's principle, in 30 digits.

    The heights of both spheres over their vertex planes are functions of two coordinates; the
    path is stationary in all four.
    """
    with mp.workdps(30):
        faces = [
            (
                mp.matrix(face.frame.rotation.tolist()),
                mp.matrix(face.frame.origin.tolist()),
                mp.mpf(face.radius),
            )
            for face in SINGLET
        ]
        s, p = mp.matrix(list(source)), mp.matrix(where.tolist())
        glass = mp.mpf(SINGLET[0].index_after)

        def on(face, x, y):
            rotation, origin, radius = face
            root = mp.sqrt(radius**2 - x**2 - y**2) * mp.sign(radius)
            slopes = (
                rotation * mp.matrix(column) for column in ([1, 0, x / root], [0, 1, y / root])
            )
            return origin + rotation * mp.matrix([x, y, radius - root]), *slopes

        def slope(a, b, c, d):
            one, one_x, one_y = on(faces[0], a, b)
            two, two_x, two_y = on(faces[1], c, d)
            first = sign * (one - s) / mp.norm(one - s)
            inside = glass * (two - one) / mp.norm(two - one)
            last = (p - two) / mp.norm(p - two)
            return [
                mp.fdot(first - inside, one_x),
                mp.fdot(first - inside, one_y),
                mp.fdot(inside - last, two_x),
                mp.fdot(inside - last, two_y),
            ]

        a, b, c, d = mp.findroot(slope, (0, 0, 0, 0), tol=1e-50)
        one, two = on(faces[0], a, b)[0], on(faces[1], c, d)[0]
        path = sign * mp.norm(one - s) + glass * mp.norm(two - one) + mp.norm(p - two)
        direction = (p - two) / mp.norm(p - two)
        return [float(value) for value in direction], float(path)


@pytest.mark.parametrize(("source_mm", "converging"), [((4, -3, -90), False), ((-2, 5, 150), True)])
def test_singlet_meets_fermats_principle(rng, source_mm, converging):
    source = PointSource(place(*source_mm), converging=converging)
    system = OpticalSystem(source, SINGLET)
    where = points(rng, 3, 15, count=25)
    fit = fit_rays(system, where)
    assert np.all(fit.status == FitStatus.FITTED), fit.report()
    exact = [fermat(source.position, point, -1 if converging else 1) for point in where]
    assert np.abs(fit.direction - [direction for direction, _ in exact]).max() < DIRECTION
    assert np.abs(fit.path - [path for _, path in exact]).max() < PATH
    check_slope(SystemWave(system), where)
