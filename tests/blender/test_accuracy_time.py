# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The time of a sample, where most of the time of a render is not that of its samples."""

import numpy as np
import pytest

from hoe_addon.blender.accuracy.timing import FixedTime, SampleTime, sample_time

EACH, FIXED, SCATTER = 0.0158, 0.7, 0.12
"""As measured on small pictures, in seconds."""

MANY = [count for count in (8, 16, 32, 64, 128, 256, 512) for _ in range(2)]
TRIALS = 200
CALIBRATED = (0.6, 1.4)
"""Scatter over standard error told: 1 for many renders; the few of a run know it to some 30 %."""


def times(rng: np.random.Generator, work: list[int], fixed: float = FIXED) -> list[float]:
    scatter = 1.0 + SCATTER * rng.standard_normal(len(work))
    return list((fixed + EACH * np.array(work)) * scatter)


def found(rng: np.random.Generator, work: list[int], fixed: float = FIXED) -> list[SampleTime]:
    """Times of runs, each after a reference of its own."""
    known = [sample_time(MANY, times(rng, MANY), FixedTime()) for _ in range(TRIALS)]
    return [sample_time(work, times(rng, work, fixed), each.for_other_settings()) for each in known]


def test_exact_times_give_the_slope() -> None:
    one = sample_time(MANY, [FIXED + EACH * count for count in MANY], FixedTime())
    assert one.seconds == pytest.approx(EACH, rel=0.01)
    assert one.fixed.seconds == pytest.approx(FIXED, rel=0.05)
    two = sample_time(MANY, [2 * FIXED + EACH * count for count in MANY], FixedTime(), passes=2)
    assert two.seconds == pytest.approx(EACH, rel=0.01)
    assert two.fixed.seconds == pytest.approx(FIXED, rel=0.05)


@pytest.mark.parametrize("fixed", [0.8 * FIXED, FIXED, 1.2 * FIXED])
def test_short_and_long_renders_give_the_time_with_its_error(
    rng: np.random.Generator, fixed: float
) -> None:
    runs = found(rng, [8, 16, 180], fixed)
    values = np.array([run.seconds for run in runs])
    assert np.median(values) == pytest.approx(EACH, rel=0.1)
    low, high = np.percentile(values, [2.5, 97.5])
    assert 0.6 * EACH < low < high < 1.5 * EACH
    told = np.sqrt(np.mean([((run.seconds - EACH) / run.error) ** 2 for run in runs]))
    assert CALIBRATED[0] < told < CALIBRATED[1]
    assert np.mean([run.is_known for run in runs]) > 0.8


def test_what_is_too_short_to_time_is_told(rng: np.random.Generator) -> None:
    runs = found(rng, [8, 16])
    assert not any(run.is_known for run in runs)
    assert all(run.seconds >= run.error > 0.0 for run in runs)
    # The fixed time is never counted as that of samples.
    assert np.median([run.seconds for run in runs]) < 1.5 * EACH


def test_long_renders_do_not_need_to_know_the_fixed_time() -> None:
    run = sample_time([8, 8], [50.0, 50.0], FixedTime())
    assert run.is_known
    assert run.seconds == pytest.approx(49.5 / 8.0, rel=0.01)


def test_no_time_is_below_zero() -> None:
    quick_first = sample_time([8, 16, 32], [0.1, 0.4, 0.9], FixedTime())
    assert quick_first.fixed.seconds >= 0.0
    falling = sample_time([8, 16], [0.9, 0.3], FixedTime())
    assert falling.seconds >= falling.error > 0.0
    assert not falling.is_known
