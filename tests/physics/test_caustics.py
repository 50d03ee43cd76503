# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Caustics behind optics: where several rays meet nothing is fitted, elsewhere nothing is wrong.

A ball lens has its rays by angles in one plane, a spherical mirror by the law of reflection.
"""

import numpy as np

from hoe_addon.core.arrays import unit
from hoe_addon.core.ray_fitting import FitStatus, OpticalSurface, OpticalSystem, fit_rays
from hoe_addon.core.tracer import Frame
from hoe_addon.core.waves import PlaneWave, PointSource

DIRECTION = 1e-11
"""rad; a landing error of 1e-16 m over centimetres is 1e-14, and surfaces add their rounding."""

MM = 1e-3

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


BALL_RADIUS, BALL_INDEX, BALL_SOURCE = 5.0, 1.5, -40.0
BALL = tuple(surface(z, r, 0.0, 4.9, n) for z, r, n in ((-5, 5, BALL_INDEX), (5, -5, 1.0)))


def ball_rays(count=400_001):
    """Meridional rays of a point on the axis through a ball: height and slope at its exit.

    By angles alone: with the central angle theta of the entry and the angles of incidence and
    refraction, the exit lies pi - 2 t further on, and the ray is turned by 2 (i - t).
    """
    theta = np.linspace(0.0, np.arcsin(4.9 / BALL_RADIUS), count)
    entry = BALL_RADIUS * np.stack((np.sin(theta), -np.cos(theta)))
    slope = np.arctan2(entry[0], entry[1] - BALL_SOURCE)
    incidence = theta + slope
    refraction = np.arcsin(np.sin(incidence) / BALL_INDEX)
    usable = incidence < np.pi / 2
    # Central angles count from the side of the source.
    exit_angle = theta + np.pi - 2 * refraction
    place_x, place_z = BALL_RADIUS * np.sin(exit_angle), -BALL_RADIUS * np.cos(exit_angle)
    usable &= (place_z > 0.0) & (np.abs(place_x) <= 4.9)
    leaving = slope - 2 * (incidence - refraction)
    return place_x[usable], place_z[usable], leaving[usable]


def test_ball_lens_marks_its_caustic_and_nothing_is_wrong(rng):
    z_mm = 6.0
    radius = np.concatenate((rng.uniform(0.02, 1.2, 200), rng.uniform(1.2, 9.0, 200)))
    phi = rng.uniform(0, 2 * np.pi, 400)
    local = np.stack((radius * np.cos(phi), radius * np.sin(phi), np.full(400, z_mm)), axis=-1)
    system = OpticalSystem(PointSource(place(0, 0, BALL_SOURCE)), BALL)
    fit = fit_rays(system, PLACED.point_to_world(local * MM))

    x, z, leaving = ball_rays()
    landing = x + (z_mm - z) * np.tan(leaving)
    count = np.zeros(400, dtype=int)
    slopes = np.full(400, np.nan)
    for number, r in enumerate(radius):
        for side in (r, -r):
            crossings = np.flatnonzero(np.diff(np.sign(landing - side)))
            count[number] += len(crossings)
            if len(crossings):
                slopes[number] = np.sign(side) * leaving[crossings[0]]
    fitted = fit.status == FitStatus.FITTED
    # All three kinds of place occur, so nothing below is empty.
    assert (count == 0).any() and (count == 1).any() and (count > 1).any()
    assert np.all(count[fitted] == 1)
    assert np.all(fit.status[count > 1] == FitStatus.CAUSTIC)
    assert np.isnan(fit.direction[~fitted]).all() and np.isnan(fit.path[~fitted]).all()
    # One ray may be given up beside the fold only, not elsewhere.
    assert fitted[count == 1].mean() > 0.8
    wanted = np.stack(
        (np.sin(slopes) * np.cos(phi), np.sin(slopes) * np.sin(phi), np.cos(slopes)), axis=-1
    )
    found = PLACED.vector_to_local(fit.direction)
    # The meridional rays are sampled: 400,001 over a radian.
    assert np.abs(found - wanted)[fitted].max() < 1e-4


def test_spherical_mirror_far_off_axis_gives_exact_rays_or_none(rng):
    # A wide spherical mirror near its caustic: |r| = R/2 is reached several times.
    system = OpticalSystem(PlaneWave(along(0.2, 0.1, -1)), (surface(0, 100, 0.0, 85, None),))
    where = points(rng, 25, 42, count=2000)
    fit = fit_rays(system, where)
    kinds = {FitStatus(kind).name: np.count_nonzero(fit.status == kind) for kind in FitStatus}
    assert min(kinds["FITTED"], kinds["CAUSTIC"]) > 50, kinds
    fitted = fit.status == FitStatus.FITTED
    # Law of reflection at the hit: where the reversed ray meets the sphere, its mirror image
    # about the normal has to be the incident direction.
    local, heading = (
        PLACED.point_to_local(where[fitted]),
        PLACED.vector_to_local(fit.direction[fitted]),
    )
    centre = np.array([0.0, 0.0, 0.1])
    offset = local - centre
    b = np.sum(offset * -heading, axis=-1)
    far = -b + np.sqrt(b**2 - np.sum(offset**2, axis=-1) + 0.1**2)
    hit = local - far[:, None] * heading
    normal = unit(centre - hit)
    incident = heading - 2 * np.sum(heading * normal, axis=-1)[:, None] * normal
    assert np.abs(incident - unit((0.2, 0.1, -1.0))).max() < DIRECTION
    assert np.hypot(hit[:, 0], hit[:, 1]).max() <= 85 * MM


def test_beside_a_fold_two_rays_are_never_taken_for_one():
    # An entry so small that nothing else than the two rays beside the fold reaches the place.
    entry = surface(-5, 5, 0.0, 3.2, BALL_INDEX)
    system = OpticalSystem(PointSource(place(0, 0, BALL_SOURCE)), (entry, BALL[1]))
    x, z, leaving = ball_rays()
    height = np.linspace(0.0, np.arcsin(4.9 / BALL_RADIUS), 400_001)[: len(x)]
    landing = (x + (6.0 - z) * np.tan(leaving))[BALL_RADIUS * np.sin(height) <= 3.2]
    fold = landing.max()
    assert 0.0 < landing[-1] < 0.99 * fold
    share = 1.0 - np.logspace(-9, -2.2, 100)
    phi = np.linspace(0.0, 2 * np.pi, 100)
    radius = share * fold
    local = np.stack((radius * np.cos(phi), radius * np.sin(phi), np.full(100, 6.0)), axis=-1)
    fit = fit_rays(system, PLACED.point_to_world(local * MM))
    assert np.all(fit.status == FitStatus.CAUSTIC), fit.report()
    # Well inside there is one ray, and outside none.
    clear = np.stack((0.7 * local[0], 1.3 * local[0]))
    clear[:, 2] = 6.0
    status = fit_rays(system, PLACED.point_to_world(clear * MM)).status
    assert status[0] == FitStatus.FITTED and status[1] != FitStatus.FITTED
