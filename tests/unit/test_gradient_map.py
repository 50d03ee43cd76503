# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V: stated errors, masks, and the filling beyond them."""

import numpy as np
import pytest

from hoe_addon.core.errors import CancelledError, SpecError
from hoe_addon.core.gradient_map import LIMIT, TOLERANCE, GradientMap, bake
from hoe_addon.core.map_filling import distance_from, filled
from hoe_addon.core.waves import PointSource

MM = 1e-3
SIZE = (10 * MM, 6 * MM)


def flat(x, y):
    return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))


def random_points(rng, count=5000):
    half = 0.5 * np.array((*SIZE, 0.0))
    return rng.uniform(-1.0, 1.0, (count, 3)) * half


def inside_circle(points, radius=3.5 * MM):
    return np.hypot(points[..., 0] - 1 * MM, points[..., 1]) < radius


@pytest.mark.parametrize("distance_mm", [200.0, 10.0, 2.0])
def test_the_stated_error_is_the_error(rng, distance_mm):
    wave = PointSource((1 * MM, -0.5 * MM, -distance_mm * MM))
    made = bake(wave.gradient, flat, SIZE)
    points = random_points(rng)
    error = np.abs(made.gradient(points) - wave.gradient(points)).max()
    assert made.error <= TOLERANCE
    # The middles of some cells stand for all places.
    assert error <= max(2.0 * made.error, 1e-15)


def test_it_stops_at_the_largest_size_and_says_so(rng):
    wave = PointSource((0.0, 0.0, -0.05 * MM))
    made = bake(wave.gradient, flat, SIZE, largest=64)
    assert made.texels.shape == (64, 64, 4)
    assert made.error > 1e-3


def test_points_lie_on_the_curved_element():
    seen = []

    def sag(x, y):
        return (x**2 + y**2) / (2 * 50 * MM)

    def gradient(points):
        seen.append(points)
        return np.zeros(points.shape)

    bake(gradient, sag, SIZE)
    for points in seen:
        np.testing.assert_array_equal(points[:, 2], sag(points[:, 0], points[:, 1]))


def test_a_mask_is_conservative_and_its_inside_is_exact(rng):
    wave = PointSource((0.0, 0.0, -20 * MM))

    def gradient(points):
        return np.where(inside_circle(points)[..., None], wave.gradient(points), np.nan)

    made = bake(gradient, flat, SIZE)
    points = random_points(rng, 40_000)
    by_map, exact = made.gradient(points), gradient(points)
    recorded, truly = (np.isfinite(g[:, 0]) for g in (by_map, exact))
    assert not np.any(recorded & ~truly)
    assert np.abs(by_map - exact)[recorded].max() < LIMIT
    # No more than three texels of the border are lost.
    deep = inside_circle(points, 3.5 * MM - 3.0 * np.hypot(*made.pitch))
    assert deep.mean() > 0.3
    assert np.all(recorded[deep])


def test_a_bend_at_the_border_is_given_up_not_guessed(rng):
    # Beside a caustic grad V goes with the square root of the distance.
    def gradient(points):
        x = points[..., 0] / MM
        with np.errstate(invalid="ignore"):
            root = np.sqrt(x - 0.3)
        return np.stack((0.1 * root, 0.0 * x, 1.0 + 0.0 * root), axis=-1)

    made = bake(gradient, flat, SIZE, largest=512)
    points = random_points(rng, 40_000)
    by_map, exact = made.gradient(points), gradient(points)
    recorded = np.isfinite(by_map[:, 0])
    assert not np.any(recorded & np.isnan(exact[:, 0]))
    assert recorded.mean() > 0.4
    # The check looks at the middles of cells; elsewhere in them it is hardly worse.
    assert np.abs(by_map - exact)[recorded].max() < 2.0 * LIMIT


def test_nothing_recorded_is_an_error():
    with pytest.raises(SpecError, match="nothing is recorded"):
        bake(lambda points: np.full(points.shape, np.nan), flat, SIZE)


def test_progress_rises_and_can_stop_the_work():
    wave, told = PointSource((0.0, 0.0, -1 * MM)), []
    bake(wave.gradient, flat, SIZE, progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0

    def stop(_share):
        raise CancelledError("stopped")

    with pytest.raises(CancelledError):
        bake(wave.gradient, flat, SIZE, progress=stop)


def test_off_the_element_there_is_nothing():
    made = bake(PointSource((0.0, 0.0, -50 * MM)).gradient, flat, SIZE)
    assert isinstance(made, GradientMap)
    assert np.isnan(made.gradient([[5.1 * MM, 0.0, 0.0], [np.nan, 0.0, 0.0]])).all()


def test_filling_continues_a_cubic_and_keeps_what_is_known(rng):
    y, x = np.mgrid[0:40, 0:40] / 10.0
    values = np.stack((x**3 - x * y**2, y**3 + x), axis=-1)
    known = (x + y < 5.0) & (x < 3.0)
    hole = np.where(known[..., None], values, np.nan)
    result = filled(hole, known)
    assert np.isfinite(result).all()
    np.testing.assert_array_equal(result[known], values[known])
    beside = (distance_from(known, 4) == 1) & (x >= 3.0) & (y < 1.5)
    assert beside.any()
    np.testing.assert_allclose(result[beside], values[beside], atol=1e-9)


def test_distance_counts_steps():
    places = np.zeros((5, 6), dtype=bool)
    places[2, 1] = True
    distance = distance_from(places, 3)
    assert distance[2].tolist() == [1, 0, 1, 2, 3, 3]
    assert distance[0, 3] == 2


@pytest.mark.parametrize("radius", [0.1e-3, 0.4e-3], ids=["no node of the coarse grid", "one"])
def test_small_recorded_spot_is_found(radius: float) -> None:
    """Of a 40 mm element; the first grid of 30 x 30 nodes has next to none in it."""

    def gradient(points: np.ndarray) -> np.ndarray:
        inside = np.hypot(points[..., 0], points[..., 1] - 1e-3) < radius
        return np.where(inside[..., None], (0.1, 0.2, 0.0), np.nan)

    made = bake(gradient, lambda x, y: np.zeros_like(x), (0.04, 0.04))
    value = made.gradient((0.0, 1e-3, 0.0))
    if radius > 0.2e-3:  # else the border takes all of it
        np.testing.assert_allclose(value, (0.1, 0.2, 0.0), atol=1e-6)
    assert np.isnan(made.gradient((5e-3, 5e-3, 0.0))).all()
