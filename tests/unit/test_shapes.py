# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes against mpmath: where rays meet them, their normals, their heights."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.errors import SpecError
from hoe_addon.core.shapes import Conic, Cylinder, EvenAsphere, Plane, Shape

mpmath.mp.dps = 50

EPS = float(np.finfo(np.float64).eps)

ROUNDINGS = 16
"""Of float64, in a distance: each moves a point of the ray by EPS times how far away it is, and
toward grazing the crossing moves by that over the cosine."""

NORMAL = 8 * EPS
HALF = 15.0
"""mm; half the width of the part of each surface that is tried."""

SHAPES: dict[str, Shape] = {
    "plane": Plane(),
    "sphere": Conic(50.0),
    "sphere the other way": Conic(-40.0),
    "nearly flat sphere": Conic(1e9),
    "flat sphere": Conic(math.inf),
    "paraboloid": Conic(30.0, -1.0),
    "hyperboloid": Conic(-30.0, -2.5),
    "oblate": Conic(60.0, 2.0),
    "cylinder along x": Cylinder(35.0, "x"),
    "cylinder along y": Cylinder(-35.0, "y"),
    "asphere": EvenAsphere(50.0, -0.7, (1e-6, -2e-9), 25.0),
    "asphere on a plane": EvenAsphere(math.inf, 0.0, (1e-5,), 25.0),
}

every_shape = pytest.mark.parametrize("name", SHAPES)


def exact_height(shape: Shape, x: Any, y: Any) -> Any:
    """The sag from its definition, in 50 digits."""
    x, y = mpmath.mpf(x), mpmath.mpf(y)
    if isinstance(shape, Plane):
        return mpmath.mpf(0)
    c = 0 if math.isinf(shape.radius) else 1 / mpmath.mpf(shape.radius)
    if isinstance(shape, Cylinder):
        square, weight = (y if shape.axis == "x" else x) ** 2, 1
    else:
        square, weight = x**2 + y**2, 1 + mpmath.mpf(shape.conic)
    z = c * square / (1 + mpmath.sqrt(1 - weight * c**2 * square))
    for place, value in enumerate(getattr(shape, "coefficients", ())):
        z += mpmath.mpf(value) * square ** (place + 2)
    return z


def exact_distance(shape: Shape, origin: Any, direction: Any, near: float) -> Any:
    """The root of the height over the surface, from a start near it."""
    start, way = ([mpmath.mpf(float(v)) for v in row] for row in (origin, direction))

    def above(t: Any) -> Any:
        x, y, z = (a + t * b for a, b in zip(start, way, strict=True))
        return z - exact_height(shape, x, y)

    return mpmath.findroot(above, mpmath.mpf(near), tol=1e-60, verify=False)


def aimed_rays(
    shape: Shape, rng: np.random.Generator, count: int, cos: float, far: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rays that come to the surface from either side at a given cosine, from a given distance."""
    x, y = rng.uniform(-HALF, HALF, (2, count))
    place = np.stack((x, y, shape.sag(x, y)), axis=1)
    normal = shape.normal(place)
    aside = np.cross(normal, rng.normal(size=(count, 3)))
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    side = rng.choice([-1.0, 1.0], (count, 1))
    direction = side * cos * normal + math.sqrt(1.0 - cos**2) * aside
    return place - far * direction, direction


@every_shape
@pytest.mark.parametrize("cos", [1.0, 0.5, 0.05])
@pytest.mark.parametrize("far", [0.5, 1e3, 1e9])
def test_distance(name: str, cos: float, far: float, rng: np.random.Generator) -> None:
    """From near and far, steep and grazing; a root of the same equation in 50 digits."""
    shape = SHAPES[name]
    origin, direction = aimed_rays(shape, rng, 15, cos, far)
    distance = shape.intersect(origin, direction)
    assert np.isfinite(distance).all()
    for start, way, found in zip(origin, direction, distance, strict=True):
        exact = exact_distance(shape, start, way, found)
        point = np.array(
            [
                float(mpmath.mpf(float(s)) + exact * float(w))
                for s, w in zip(start, way, strict=True)
            ]
        )
        slant = abs(float(np.dot(way, shape.normal(point))))
        allowed = ROUNDINGS * EPS * (far + 2 * HALF) / slant
        assert abs(float(mpmath.mpf(float(found)) - exact)) <= allowed


@every_shape
def test_first_crossing_is_the_one_that_is_found(name: str, rng: np.random.Generator) -> None:
    """No ray crosses the surface before the distance given, on a fine scan."""
    shape = SHAPES[name]
    origin, direction = aimed_rays(shape, rng, 200, 0.4, 12.0)
    distance = shape.intersect(origin, direction)
    assert np.all(distance <= 12.0 * (1.0 + 1e-12))
    before = distance[:, None] * np.linspace(0.0, 1.0 - 1e-9, 400)
    place = origin[:, None] + before[..., None] * direction[:, None]
    height = place[..., 2] - shape.sag(place[..., 0], place[..., 1])
    sides = np.sign(height)
    first = np.nanmax(sides, axis=1), np.nanmin(sides, axis=1)
    assert np.all(first[0] == first[1])


@every_shape
def test_normal_and_height(name: str, rng: np.random.Generator) -> None:
    shape = SHAPES[name]
    for x, y in rng.uniform(-HALF, HALF, (40, 2)):
        exact = exact_height(shape, x, y)
        z = float(shape.sag(x, y))
        assert abs(z - float(exact)) <= 8 * EPS * max(abs(float(exact)), 1e-3)
        slope = [
            mpmath.diff(lambda v: exact_height(shape, v, y), x),  # noqa: B023
            mpmath.diff(lambda v: exact_height(shape, x, v), y),  # noqa: B023
        ]
        length = mpmath.sqrt(1 + slope[0] ** 2 + slope[1] ** 2)
        expected = [float(-slope[0] / length), float(-slope[1] / length), float(1 / length)]
        np.testing.assert_allclose(shape.normal((x, y, z)), expected, atol=NORMAL)


def test_outside_the_domain_there_is_nothing() -> None:
    down, up = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)
    sphere = Conic(10.0)
    assert np.isnan(sphere.sag(10.1, 0.0))
    assert sphere.sag(10.0, 0.0) == 10.0
    assert np.isnan(sphere.intersect((10.1, 0.0, 30.0), down))
    # The far half of the sphere does not count: only the vertex sheet does.
    assert sphere.intersect((0.0, 0.0, 30.0), down) == pytest.approx(30.0, abs=1e-14)
    assert np.isnan(sphere.intersect((0.0, 0.0, 5.0), up))
    # Nor does the second bowl of a hyperboloid.
    hyperboloid = Conic(10.0, -2.0)
    assert np.isnan(hyperboloid.intersect((0.0, 0.0, -1.0), down))
    asphere = EvenAsphere(10.0, -1.0, (1e-3,), 5.0)
    assert np.isnan(asphere.sag(5.01, 0.0))
    assert np.isnan(asphere.intersect((5.01, 0.0, 30.0), down))
    assert np.isfinite(asphere.intersect((5.0, 0.0, 30.0), down))


@every_shape
def test_a_ray_away_from_the_surface_misses(name: str, rng: np.random.Generator) -> None:
    shape = SHAPES[name]
    x, y = rng.uniform(-HALF, HALF, (2, 100))
    above = np.stack((x, y, shape.sag(x, y) + 1e-3), axis=1)
    below = above - (0.0, 0.0, 2e-3)
    assert np.isnan(shape.intersect(below, (0.0, 0.0, -1.0))).all()
    up = shape.intersect(above, (0.0, 0.0, 1.0))
    assert np.isnan(up).all()


def test_parallel_to_a_plane_and_on_it() -> None:
    assert np.isnan(Plane().intersect((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))
    assert np.isnan(Plane().intersect((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)))
    assert Plane().intersect((3.0, 0.0, 0.0), (0.6, 0.0, 0.8)) == 0.0
    for shape in SHAPES.values():
        assert shape.intersect((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)) == 0.0


def test_second_wall_of_a_bowl_and_both_of_its_sides() -> None:
    """A level ray crosses a bowl twice; from inside it meets the far wall."""
    for shape in (Conic(20.0), Conic(20.0, -1.0), EvenAsphere(20.0, 0.0, (), 19.0)):
        level = float(shape.sag(12.0, 0.0))
        across = (1.0, 0.0, 0.0)
        assert shape.intersect((-30.0, 0.0, level), across) == pytest.approx(18.0, abs=1e-13)
        assert shape.intersect((0.0, 0.0, level), across) == pytest.approx(12.0, abs=1e-13)
        assert np.isnan(shape.intersect((13.0, 0.0, level), across))


def test_asphere_without_coefficients_is_the_conic(rng: np.random.Generator) -> None:
    conic, asphere = Conic(40.0, 0.6), EvenAsphere(40.0, 0.6, (), 25.0)
    origin, direction = aimed_rays(conic, rng, 1000, 0.3, 50.0)
    expected = conic.intersect(origin, direction)
    hit = origin + expected[:, None] * direction
    inside = np.hypot(hit[:, 0], hit[:, 1]) < 25.0
    found = asphere.intersect(origin, direction)
    np.testing.assert_allclose(found[inside], expected[inside], rtol=1e-13)
    assert inside.sum() > 700


def test_asphere_far_from_its_conic_is_scanned(rng: np.random.Generator) -> None:
    """Steep waves around a plane: rays cross several times, and the first one counts."""
    shape = EvenAsphere(math.inf, 0.0, (4e-3, -4.4e-5, 1.1e-7), 12.0)
    x, y = rng.uniform(-8.0, 8.0, (2, 400))
    origin = np.stack((x, y, np.full(400, 60.0)), axis=1)
    aim = np.concatenate((rng.uniform(-6.0, 6.0, (400, 2)), np.zeros((400, 1))), axis=1)
    direction = (aim - origin) / np.linalg.norm(aim - origin, axis=1, keepdims=True)
    distance = shape.intersect(origin, direction)
    place = origin + distance[:, None] * direction
    met = np.isfinite(distance)
    assert met.mean() > 0.9
    height = place[met, 2] - shape.sag(place[met, 0], place[met, 1])
    assert np.abs(height).max() < 1e-11
    before = (
        origin[:, None]
        + (distance[:, None] * np.linspace(0, 0.999, 500))[..., None] * direction[:, None]
    )
    above = before[..., 2] - shape.sag(before[..., 0], before[..., 1])
    assert np.nanmin(above[met]) > 0.0


@pytest.mark.parametrize("tilt", [0.0, -0.02, 0.03])
def test_near_wall_of_a_bowl_of_fourth_degree(tilt: float) -> None:
    """Newton from the plane below, far ahead, would arrive at the far wall."""
    shape = EvenAsphere(math.inf, 0.0, (1e-3,), 12.0)
    level = np.linspace(1.0, 12.0, 23)
    near = -((level / 1e-3) ** 0.25)
    direction = np.array((math.cos(tilt), 0.0, math.sin(tilt)))
    place = np.stack((near, np.zeros(23), level), axis=1)
    distance = shape.intersect(place - 30.0 * direction, direction)
    np.testing.assert_allclose(distance, 30.0, rtol=1e-12)
    inside = shape.intersect(place + 1e-3 * direction, direction)
    assert np.all(inside > 1.0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Conic(0.0), "radius: must be a number other than 0, got 0.0"),
        (lambda: Conic(math.nan), "radius: must be"),
        (lambda: Conic(1.0, math.inf), "conic: must be a finite number, got inf"),
        (lambda: Cylinder(0.0, "x"), "radius: must be"),
        (lambda: Cylinder(1.0, "z"), "axis: must be x or y, got z"),  # type: ignore[arg-type]
        (lambda: EvenAsphere(1.0, 0.0, (math.nan,), 0.5), "coefficients: must be finite"),
        (lambda: EvenAsphere(1.0, 0.0, (), 0.0), "semi_diameter: must be above 0, got 0.0"),
        (lambda: EvenAsphere(1.0, 0.0, (), 1.5), "semi_diameter: must lie on the conic"),
    ],
)
def test_bad_numbers_are_refused(make: Callable[[], Shape], message: str) -> None:
    with pytest.raises(SpecError, match=message):
        make()
