# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The standard error of a mean, told by the pixels of one picture."""

import math

import numpy as np
import pytest

from hoe_addon.core.mean_error import mean_error

SHAPE = (60, 80)
NOISE = 0.3


def everywhere() -> np.ndarray:
    return np.ones(SHAPE, dtype=bool)


def test_noise_of_a_smooth_picture_is_told(rng: np.random.Generator) -> None:
    truth = np.broadcast_to(np.linspace(1.0, 3.0, SHAPE[1]), SHAPE)
    found = mean_error(truth + NOISE * rng.standard_normal(SHAPE), everywhere())
    assert found == pytest.approx(NOISE / math.sqrt(truth.size), rel=0.05)


@pytest.mark.parametrize("axis", [0, 1])
def test_stripes_do_not_count_as_noise(rng: np.random.Generator, axis: int) -> None:
    """Rows or columns, whichever has less detail."""
    truth = np.broadcast_to(np.arange(SHAPE[1]) % 2 * 10.0, SHAPE)
    picture = truth + NOISE * rng.standard_normal(SHAPE)
    found = mean_error(picture.T if axis else picture, everywhere().T if axis else everywhere())
    assert found == pytest.approx(NOISE / math.sqrt(truth.size), rel=0.05)


def test_detail_makes_the_error_larger_never_smaller(rng: np.random.Generator) -> None:
    truth = 3.0 * (rng.random(SHAPE) < 0.1)
    found = mean_error(truth + NOISE * rng.standard_normal(SHAPE), everywhere())
    assert found > NOISE / math.sqrt(truth.size)


def test_only_the_field_counts(rng: np.random.Generator) -> None:
    picture = NOISE * rng.standard_normal(SHAPE)
    picture[:, 40:] *= 100.0
    field = everywhere()
    field[:, 40:] = False
    assert mean_error(picture, field) == pytest.approx(NOISE / math.sqrt(2400), rel=0.05)
    lonely = np.zeros(SHAPE, dtype=bool)
    lonely[3, 3] = True
    assert math.isnan(mean_error(picture, lonely))
