# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error told by two halves: right on average, and a bound that holds as often as it says."""

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.sampling_error import (
    CONFIDENCE,
    Halves,
    denoised_error,
    lit_field,
    noise_error,
    relative_variance,
)

SHAPE = (48, 64)
RUNS = 120

COVERAGE_SLACK = 0.05
"""120 runs know a probability of 0.95 to 2 %; 2.5 of these standard errors."""

MEAN_SLACK = 0.02
"""The mean of 120 estimates, each known to 5 % at most, is known to a quarter of this."""


def _truth() -> NDArray[np.float64]:
    """A picture with dark and bright parts, and a half that is black."""
    y, x = np.mgrid[0 : SHAPE[0], 0 : SHAPE[1]]
    return np.where(x < SHAPE[1] // 2, 1.0 + np.sin(x / 5.0) * np.cos(y / 7.0), 0.0)


def _noise(rng: np.random.Generator, kind: str, truth: NDArray[np.float64]) -> NDArray[np.float64]:
    if kind == "even":
        return rng.normal(0.0, 0.3, SHAPE)
    if kind == "with the light":
        return rng.normal(0.0, 0.3, SHAPE) * truth
    # Rare and bright: one sample in 200 carries all the light of a pixel.
    return truth * (rng.poisson(0.5, SHAPE) / 0.5 - 1.0)


@pytest.mark.parametrize("kind", ["even", "with the light", "rare"])
def test_error_is_right_and_its_bound_holds(rng: np.random.Generator, kind: str) -> None:
    """Against the true error of each picture, in many runs."""
    truth = _truth()
    field = truth > 0.0
    told, true, held = [], [], 0
    for _ in range(RUNS):
        halves = Halves(truth + _noise(rng, kind, truth), truth + _noise(rng, kind, truth))
        found = noise_error(halves, field)
        error = np.sqrt(((halves.mean - truth)[field] ** 2).mean()) / truth[field].mean()
        told.append(found.error**2)
        true.append(error**2)
        held += error <= found.upper
    assert np.mean(told) == pytest.approx(np.mean(true), rel=MEAN_SLACK)
    assert held / RUNS >= CONFIDENCE - COVERAGE_SLACK
    assert found.confidence == CONFIDENCE


def test_rare_bright_pixels_widen_the_bound(rng: np.random.Generator) -> None:
    truth = np.ones(SHAPE)
    field = truth > 0.0
    even = noise_error(Halves(*(rng.normal(1.0, 0.3, (2, *SHAPE)))), field)
    rare = noise_error(Halves(*(rng.poisson(1e-3, (2, *SHAPE)) / 1e-3)), field)
    assert even.upper / even.error < 1.05
    assert rare.upper / rare.error > 1.2


def _box(picture: NDArray[np.float64]) -> NDArray[np.float64]:
    """A denoiser: the mean over 5 x 5 pixels, round the border."""
    shifts = [(dy, dx) for dy in range(-2, 3) for dx in range(-2, 3)]
    return np.mean([np.roll(picture, shift, (0, 1)) for shift in shifts], axis=0)


@pytest.mark.parametrize("sigma", [0.1, 0.6], ids=["mostly blur", "mostly noise"])
def test_denoised_halves_tell_noise_and_blur(rng: np.random.Generator, sigma: float) -> None:
    """Without the truth they find the error that the truth shows."""
    truth = _truth()
    field = truth > 0.0
    told, true, held = [], [], 0
    for _ in range(RUNS):
        first, second = truth + rng.normal(0.0, sigma, (2, *SHAPE))
        clean = Halves(_box(first), _box(second))
        found = denoised_error(Halves(first, second), clean, field)
        error = np.sqrt(((clean.mean - truth)[field] ** 2).mean()) / truth[field].mean()
        told.append(found.error**2)
        true.append(error**2)
        held += error <= found.upper
    assert np.mean(told) == pytest.approx(np.mean(true), rel=MEAN_SLACK)
    assert held / RUNS >= CONFIDENCE - COVERAGE_SLACK


def test_a_denoiser_that_does_nothing_leaves_the_error(rng: np.random.Generator) -> None:
    halves = Halves(*rng.normal(1.0, 0.2, (2, *SHAPE)))
    field = np.ones(SHAPE, dtype=bool)
    plain, same = noise_error(halves, field), denoised_error(halves, halves, field)
    assert same.error == pytest.approx(plain.error, rel=1e-12)


@pytest.mark.parametrize("field", [np.zeros(SHAPE, dtype=bool), np.ones(SHAPE, dtype=bool)])
def test_nothing_to_see_has_no_known_error(field: NDArray[np.bool_]) -> None:
    black = Halves(np.zeros(SHAPE), np.zeros(SHAPE))
    assert noise_error(black, field).upper == np.inf


def test_same_halves_same_bound(rng: np.random.Generator) -> None:
    halves = Halves(*rng.normal(1.0, 0.2, (2, *SHAPE)))
    field = np.ones(SHAPE, dtype=bool)
    assert noise_error(halves, field) == noise_error(halves, field)


def test_pixels_outside_the_field_do_not_count(rng: np.random.Generator) -> None:
    halves = Halves(*rng.normal(1.0, 0.2, (2, *SHAPE)))
    field = _truth() > 0.0
    wild = Halves(np.where(field, halves.first, 1e6), np.where(field, halves.second, -1e6))
    assert noise_error(wild, field) == noise_error(halves, field)


def test_black_pixels_are_not_lit() -> None:
    truth = _truth()
    assert np.array_equal(lit_field(truth), truth > 0.01 * truth.mean())
    assert not lit_field(np.zeros(SHAPE)).any()


def test_variances_of_parts_add_up(rng: np.random.Generator) -> None:
    field = np.ones(SHAPE, dtype=bool)
    parts = [Halves(*rng.normal(1.0, sigma, (2, *SHAPE))) for sigma in (0.1, 0.4)]
    whole = Halves(parts[0].first + parts[1].first, parts[0].second + parts[1].second)
    told = sum(relative_variance(part, whole.mean, field) for part in parts)
    # The noise of the parts is independent: what they have in common averages out to 2 %.
    assert told == pytest.approx(noise_error(whole, field).error ** 2, rel=0.05)
