# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How samples are shared among the parts of a picture."""

import numpy as np
import pytest

from hoe_addon.core.sampling_plan import GROWTH, LEAST_GROWTH, next_samples, share_samples


def test_samples_are_shared_at_the_least_cost() -> None:
    """Any other division that reaches the variance costs more."""
    variances, costs = np.array([4.0, 0.25, 0.0]), np.array([1.0, 3.0, 2.0])
    samples = np.array(share_samples(variances, costs, variance=0.01))
    assert samples[2] == 0.0
    assert variances[:2] @ (1.0 / samples[:2]) == pytest.approx(0.01)
    for shift in (0.9, 1.1):
        first = shift * samples[0]
        second = variances[1] / (0.01 - variances[0] / first)
        assert first * costs[0] + second * costs[1] > samples @ costs


def test_a_batch_goes_as_far_as_the_variance_asks() -> None:
    """One part: samples are its variance over that of the mean."""
    (samples,) = next_samples([100], [2.0], [1.0], variance=0.01)
    assert samples == pytest.approx(200, abs=1)  # rounded up


@pytest.mark.parametrize(("variance", "growth"), [(1e-9, GROWTH), (10.0, LEAST_GROWTH)])
def test_a_batch_is_neither_too_large_nor_too_small(variance: float, growth: float) -> None:
    (samples,) = next_samples([1000], [2.0], [1.0], variance=variance)
    assert samples == pytest.approx(growth * 1000, abs=1)


def test_a_noisy_part_gets_more_and_none_loses_what_it_has() -> None:
    first, second = next_samples([64, 64], [9.0, 0.01], [1.0, 1.0], variance=1e-9)
    assert first == GROWTH * 64
    assert second == 64


@pytest.mark.parametrize("unknown", [0.0, np.inf])
def test_parts_without_known_noise_grow_alike(unknown: float) -> None:
    samples = next_samples([8, 8], [unknown, unknown], [1.0, 1.0], variance=1e-12)
    assert samples == [GROWTH * 8, GROWTH * 8]


def test_a_part_that_showed_no_noise_is_not_left_alone() -> None:
    """A few samples may just have missed its light."""
    samples = [8, 8]
    for _ in range(6):
        samples = next_samples(samples, [1.0, 0.0], [1.0, 1.0], variance=1e-12)
    assert samples[0] > samples[1] >= samples[0] // 16


def test_every_part_gets_its_least_samples_at_once() -> None:
    """Where the noise would call for none, and no more than that."""
    assert next_samples([2, 2], [1.0, 1e-6], [1.0, 1.0], variance=100.0, least=8) == [8, 8]


def test_a_part_that_lacks_almost_nothing_waits() -> None:
    first, second = next_samples([100, 97], [1.0, 1.0], [1.0, 1.0], variance=0.0125)
    assert (first, second) == (160, 160)
    first, second = next_samples([100, 155], [1.0, 1.0], [1.0, 1.0], variance=0.0125)
    assert (first, second) == (160, 155)
