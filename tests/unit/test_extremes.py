# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Least and greatest value of noisy fields whose true ones are known."""

import numpy as np
import pytest

from hoe_addon.core.extremes import extremes, ratio
from hoe_addon.core.picture_error import Estimate

TRIALS = 100
RENDERS = 4
TRUTH = 0.2
"""Least over greatest luminance of a field that falls evenly."""


def field() -> np.ndarray:
    return np.linspace(TRUTH, 1.0, 800).reshape(20, 40)


def surveys(rng: np.random.Generator, truth: np.ndarray, noise: float) -> list[np.ndarray]:
    """Some surveys of independent renders, with relative noise."""
    shape = (RENDERS, *truth.shape)
    return [truth * rng.gamma(1 / noise**2, noise**2, shape) for _ in range(TRIALS)]


@pytest.mark.parametrize("noise", [0.3, 0.1, 0.03])
def test_uniformity_does_not_fall_with_noise(rng: np.random.Generator, noise: float) -> None:
    renders = surveys(rng, field(), noise)
    uniformities = [ratio(*extremes(list(each))) for each in renders]
    means = np.array([each.mean(axis=0) for each in renders])
    plain = means.min(axis=(1, 2)) / means.max(axis=(1, 2))
    values, errors = (
        np.array([getattr(each, name) for each in uniformities])
        for name in ("value", "standard_error")
    )
    assert abs(values.mean() - TRUTH) < 0.6 * abs(plain.mean() - TRUTH)
    assert abs(values.mean() - TRUTH) < 0.25 * TRUTH
    deviations = (values - TRUTH) / errors
    assert np.mean(np.abs(deviations) < 2.0) > 0.85
    assert np.sqrt(np.mean((values - TRUTH) ** 2)) < 1.5 * errors.mean()


def test_field_without_noise_is_exact() -> None:
    least, greatest = extremes([field()] * RENDERS)
    assert (least.value, greatest.value) == pytest.approx((TRUTH, 1.0))
    assert (least.standard_error, greatest.standard_error) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_even_field_is_even_within_its_error(rng: np.random.Generator) -> None:
    uniformities = [ratio(*extremes(list(each))) for each in surveys(rng, np.ones((20, 40)), 0.2)]
    assert all(each.value <= 1.0 for each in uniformities)
    assert np.mean([1.0 - each.value < 2.0 * each.standard_error for each in uniformities]) > 0.9


def test_ratio_of_black_and_of_sure_values() -> None:
    assert ratio(Estimate(0.0, 0.0), Estimate(0.0, 0.0)) == Estimate(0.0, 0.0)
    found = ratio(Estimate(1.0, 0.1), Estimate(2.0, 0.1))
    assert found.value == 0.5
    assert found.standard_error == pytest.approx((0.05**2 + 0.025**2) ** 0.5)
