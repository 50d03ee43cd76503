# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bicubic B-splines."""

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.spline import Spline2D

# Round-off of sums of 16 products of numbers near 1.
ROUND_OFF = 1e-12
ORIGIN = (-2.0, 1.0)


def nodes(count_x: int, count_y: int, pitch: tuple[float, float]):
    return np.meshgrid(
        ORIGIN[0] + np.arange(count_x) * pitch[0], ORIGIN[1] + np.arange(count_y) * pitch[1]
    )


def cubic(x, y):
    return 1.0 + x - 2.0 * y + x * y**2 - 0.3 * x**3 * y + 0.1 * x**3 * y**3


def wavy(x, y):
    return np.sin(1.3 * x + 0.4) * np.cos(0.9 * y)


def wavy_slope(x, y):
    return np.stack(
        [
            1.3 * np.cos(1.3 * x + 0.4) * np.cos(0.9 * y),
            -0.9 * np.sin(1.3 * x + 0.4) * np.sin(0.9 * y),
        ],
        axis=-1,
    )


@pytest.mark.parametrize("count", [(4, 4), (5, 4), (6, 9), (31, 12)])
def test_bicubic_polynomial_comes_back_exactly(count, rng):
    pitch = (0.3, 0.2)
    spline = Spline2D.through(cubic(*nodes(*count, pitch)), ORIGIN, pitch)
    x = rng.uniform(spline.lower[0], spline.upper[0], 500)
    y = rng.uniform(spline.lower[1], spline.upper[1], 500)
    scale = np.abs(cubic(x, y)).max()
    np.testing.assert_allclose(spline.value(x, y), cubic(x, y), atol=ROUND_OFF * scale * 100)


def test_passes_through_samples_up_to_the_border(rng):
    samples = rng.normal(size=(9, 7, 3))
    pitch = (0.1, 0.7)
    spline = Spline2D.through(samples, ORIGIN, pitch)
    x, y = nodes(7, 9, pitch)
    np.testing.assert_allclose(spline.value(x, y), samples, atol=100 * ROUND_OFF)


def error(count: int, rng) -> tuple[float, float]:
    pitch = (4.0 / (count - 1), 3.0 / (count - 1))
    spline = Spline2D.through(wavy(*nodes(count, count, pitch)), ORIGIN, pitch)
    x, y = rng.uniform(-2.0, 2.0, 4000), rng.uniform(1.0, 4.0, 4000)
    return (
        float(np.abs(spline.value(x, y) - wavy(x, y)).max()),
        float(np.abs(spline.derivative(x, y) - wavy_slope(x, y)).max()),
    )


def test_error_falls_with_the_fourth_power_and_its_slope_with_the_third(rng):
    coarse, fine = error(33, rng), error(65, rng)
    assert np.log2(coarse[0] / fine[0]) == pytest.approx(4.0, abs=0.4)
    assert np.log2(coarse[1] / fine[1]) == pytest.approx(3.0, abs=0.4)


def test_derivative_is_that_of_the_value(rng):
    spline = Spline2D(rng.normal(size=(8, 6, 2)), ORIGIN, (0.5, 0.25))
    x = rng.uniform(spline.lower[0] + 0.01, spline.upper[0] - 0.01, 300)
    y = rng.uniform(spline.lower[1] + 0.01, spline.upper[1] - 0.01, 300)
    step = 1e-5
    slope = np.stack(
        [
            (spline.value(x + step, y) - spline.value(x - step, y)) / (2 * step),
            (spline.value(x, y + step) - spline.value(x, y - step)) / (2 * step),
        ],
        axis=-1,
    )
    # Second differences of a cubic over the step, and the kinks of its third derivative.
    np.testing.assert_allclose(spline.derivative(x, y), slope, atol=1e-6)


def test_nan_outside_and_for_nan(rng):
    spline = Spline2D.through(rng.normal(size=(5, 5)), (0.0, 0.0), (1.0, 1.0))
    x = np.array([-0.001, 4.001, 2.0, 2.0, np.nan, np.inf])
    y = np.array([2.0, 2.0, -0.001, 4.001, 2.0, 2.0])
    assert np.isnan(spline.value(x, y)).all()
    assert np.isnan(spline.derivative(x, y)).all()
    assert np.isfinite(spline.value([0.0, 4.0], [0.0, 4.0])).all()


def test_shapes_broadcast(rng):
    spline = Spline2D.through(rng.normal(size=(5, 6, 2, 3)), (0.0, 0.0), (1.0, 1.0))
    x, y = np.linspace(0.0, 5.0, 7), np.linspace(0.0, 4.0, 3)[:, None]
    assert spline.value(x, y).shape == (3, 7, 2, 3)
    assert spline.derivative(x, y).shape == (3, 7, 2, 3, 2)


@pytest.mark.parametrize(
    ("samples", "pitch", "field"),
    [
        (np.zeros((3, 9)), (1.0, 1.0), "samples: must be at least 4 x 4, got 3 x 9"),
        (np.zeros(7), (1.0, 1.0), "samples: must be at least 4 x 4, got 7"),
        (np.full((4, 4), np.nan), (1.0, 1.0), r"samples\[0, 0\]: must be finite"),
        (np.zeros((4, 4)), (1.0, 0.0), "pitch: must be above 0"),
    ],
)
def test_bad_grids_are_refused(samples, pitch, field):
    with pytest.raises(SpecError, match=field):
        Spline2D.through(samples, (0.0, 0.0), pitch)
