# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays fitted through a chain of surfaces: derivatives, apertures, status, messages."""

from dataclasses import replace

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.ray_fitting import (
    FitStatus,
    NoRayError,
    OpticalSurface,
    OpticalSystem,
    check_reaches,
    fit_rays,
)
from hoe_addon.core.ray_fitting.chain import trace
from hoe_addon.core.tracer import Frame
from hoe_addon.core.waves import PlaneWave, PointSource

MM = 1e-3
LANDING = 1e-13
"""m; what the fit promises, 1e-10 mm."""

INFINITE = float("inf")


def surface(z_mm, radius_mm, index_after, semi_diameter_mm=12.0, conic=0.0, normal=(0.0, 0.0, 1.0)):
    frame = Frame.at((0.0, 0.0, z_mm * MM), normal)
    return OpticalSurface(frame, radius_mm * MM, conic, semi_diameter_mm * MM, index_after)


def triplet(semi_diameter_mm=12.0):
    """Two lenses and a plate, one of them tilted."""
    faces = ((-60, 50, 1.52), (-55, -40, 1.62), (-52, -200, 1.0), (-40, INFINITE, 1.5))
    normals = ((0.0, 0.0, 1.0), (0.1, 0.0, 1.0), (0.0, 0.05, 1.0), (0.0, 0.0, -1.0))
    return OpticalSystem(
        PointSource((2 * MM, 1 * MM, -150 * MM)),
        tuple(
            surface(*face, semi_diameter_mm, normal=normal)
            for face, normal in zip(faces, normals, strict=True)
        ),
    )


def square(half_mm, count, z_mm=0.0):
    side = np.linspace(-half_mm, half_mm, count) * MM
    x, y = np.meshgrid(side, side)
    return np.stack((x, y, np.full_like(x, z_mm * MM)), axis=-1)


@pytest.mark.parametrize(
    "system",
    [
        triplet(),
        OpticalSystem(PlaneWave((0.1, -0.2, 1.0), 1.3), triplet().surfaces),
        OpticalSystem(
            PointSource((1 * MM, 0.0, 90 * MM), converging=True),
            (surface(-60, -80, 1.7, conic=-2.0), surface(-40, 120, None, 30.0, conic=0.5)),
        ),
    ],
    ids=["point", "plane", "converging, mirror"],
)
def test_carried_derivatives_are_those_of_the_trace(system, rng):
    start = rng.uniform(-7.0, 7.0, (40, 2)) * MM
    rays = trace(system, start)
    step = 1e-6
    for column in (0, 1):
        move = np.zeros(2)
        move[column] = step
        after, before = trace(system, start + move), trace(system, start - move)
        place = (after.place - before.place) / (2 * step)
        heading = (after.heading - before.heading) / (2 * step)
        # Third derivatives over a square micron, and 1e-16 / 1e-6 of rounding.
        np.testing.assert_allclose(rays.place_change[:, column], place, atol=3e-7)
        np.testing.assert_allclose(rays.heading_change[:, column], heading, atol=3e-5)


def test_every_point_is_met_within_the_promise():
    fit = fit_rays(triplet(), square(5.0, 64))
    assert np.all(fit.status == FitStatus.FITTED)
    assert fit.error.max() <= LANDING
    np.testing.assert_allclose(np.linalg.norm(fit.direction, axis=-1), 1.0, rtol=1e-14)


def test_a_crowd_gets_what_each_point_gets_alone(rng):
    system, points = triplet(5.0), square(7.0, 80).reshape(-1, 3)
    crowd = fit_rays(system, points)
    kinds = np.bincount(crowd.status, minlength=3)
    assert kinds[FitStatus.FITTED] > 500 and kinds[FitStatus.VIGNETTED] > 500
    some = rng.choice(len(points), 600, replace=False)
    alone = fit_rays(system, points[some])
    np.testing.assert_array_equal(alone.status, crowd.status[some])
    np.testing.assert_allclose(alone.direction, crowd.direction[some], atol=1e-12)


@pytest.mark.parametrize("count", [30, 70])
def test_a_stop_casts_its_exact_shadow(count):
    # A surface without power: light goes straight, and passes where the line meets the stop.
    system = OpticalSystem(
        PointSource((1 * MM, 0.0, -40 * MM)), (surface(-10, INFINITE, 1.0, 3.0),)
    )
    points = square(6.0, count)
    fit = fit_rays(system, points)
    source = np.array((1.0, 0.0, -40.0)) * MM
    at_stop = source + (points - source) * (30.0 / 40.0)
    passes = np.hypot(at_stop[..., 0], at_stop[..., 1]) <= 3.0 * MM
    assert 0.1 < passes.mean() < 0.9
    np.testing.assert_array_equal(fit.status == FitStatus.FITTED, passes)
    np.testing.assert_array_equal(fit.status == FitStatus.VIGNETTED, ~passes)
    away = (points - source)[passes]
    length = np.linalg.norm(away, axis=-1)
    np.testing.assert_allclose(fit.direction[passes], away / length[:, None], atol=1e-14)
    np.testing.assert_allclose(fit.path[passes], length, rtol=1e-15)


def test_total_reflection_leaves_points_dark():
    system = OpticalSystem(
        PointSource((0.0, 0.0, -20 * MM), index=1.6), (surface(-10, INFINITE, 1.0, 40.0),)
    )
    # A point shines out within the critical angle; a plane wave at 45 degrees does not get out.
    steep = OpticalSystem(PlaneWave((1.0, 0.0, 1.0), 1.6), system.surfaces)
    points = square(5.0, 10)
    assert np.all(fit_rays(system, points).status == FitStatus.FITTED)
    assert np.all(fit_rays(steep, points).status == FitStatus.VIGNETTED)


def test_a_focus_is_a_caustic():
    system = OpticalSystem(PlaneWave((0.0, 0.0, -1.0)), (surface(0, 100, None, 40.0, conic=-1.0),))
    fit = fit_rays(system, np.array([[0.0, 0.0, 50.0], [0.0, 0.0, 49.0], [0.0, 0.0, 30.0]]) * MM)
    assert fit.status.tolist() == [FitStatus.CAUSTIC, FitStatus.FITTED, FitStatus.FITTED]
    assert np.isnan(fit.direction[0]).all()


def test_points_before_the_last_surface_get_nothing():
    fit = fit_rays(triplet(), square(2.0, 5, z_mm=-45.0))
    assert np.all(fit.status == FitStatus.VIGNETTED)


def test_what_is_no_point_is_not_fitted():
    fit = fit_rays(triplet(), [[np.nan, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert fit.status.tolist() == [FitStatus.VIGNETTED, FitStatus.FITTED]
    assert fit_rays(triplet(), np.empty((0, 3))).status.shape == (0,)


def test_the_report_says_how_many_and_where():
    system = OpticalSystem(PlaneWave((0.0, 0.0, 1.0)), (surface(-10, INFINITE, 1.0, 3.0),))
    points = np.array([[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [5.0, -2.0, 0.0]]) * MM
    assert fit_rays(system, points).report() == (
        "1 of 3 fitted; 2 vignetted within (4, -2, 0) mm to (5, 1, 0) mm, first (4, 1, 0) mm"
    )


@pytest.mark.parametrize(
    ("number", "change"),
    [
        (1, {"semi_diameter": 1e-9}),
        (2, {"frame": Frame.at((0.1, 0.0, -52 * MM))}),
    ],
)
def test_a_system_that_throws_no_ray_names_the_surface(number, change):
    system = triplet()
    check_reaches(system, square(5.0, 9))
    faces = list(system.surfaces)
    faces[number] = replace(faces[number], **change)
    broken = OpticalSystem(system.source, tuple(faces))
    with pytest.raises(NoRayError, match=rf"surfaces\[{number}\]: must let a ray pass; .*, got 0"):
        check_reaches(broken, square(5.0, 9))


def test_rays_beside_the_element_name_the_last_surface():
    far = square(5.0, 9) + np.array((1.0, 0.0, 0.0))
    with pytest.raises(NoRayError, match=r"surfaces\[3\]: must send a ray to the element"):
        check_reaches(triplet(), far)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: surface(0, 10, 1.5, 11.0), "semi_diameter: must not reach beyond"),
        (lambda: surface(0, 10, 1.5, 0.0), "semi_diameter: must be above 0"),
        (
            lambda: surface(0, 10, 0.9),
            "semi_diameter: must not reach|index_after: must be at least",
        ),
        (lambda: surface(0, 0.0, 1.5), "radius: must be"),
        (lambda: OpticalSystem(PlaneWave((0, 0, 1)), ()), "surfaces: must be at least one"),
    ],
)
def test_bad_surfaces_are_refused(make, field):
    with pytest.raises(SpecError, match=field):
        make()
