# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many samples the parts of a picture get, so that its noise falls fastest for its cost."""

import math
from collections.abc import Sequence

import numpy as np

GROWTH = 4.0
"""Most that one batch multiplies the samples by: the first ones tell the noise only roughly."""

LEAST_GROWTH = 1.15
"""Least, so that looking at the error costs little against the batch."""

LEAST_SHARE = 1 / 16
"""No part gets fewer samples than this part of the most: few samples may have missed its light."""

WORTH_WHILE = 1.05
"""A part that lacks less than this factor waits: every start of a render takes its time."""


def share_samples(
    variances: Sequence[float], costs: Sequence[float], *, variance: float
) -> list[float]:
    """Least costly samples of several parts of a picture that reach a variance together.

    Args:
        variances: Variance of one sample of each part.
        costs: Cost of one sample of each part, above 0, in any unit.
        variance: Variance of the sum that is asked for, above 0.

    Returns:
        Samples of each part, not rounded.

    References:
        Neyman (1934), J. R. Stat. Soc. 97, 588-625, doi:10.2307/2342192: samples go as the
        standard deviation over the root of the cost.
    """
    deviation = np.sqrt(np.asarray(variances, dtype=np.float64))
    root_cost = np.sqrt(np.asarray(costs, dtype=np.float64))
    samples = deviation / root_cost * float(deviation @ root_cost) / variance
    return [float(number) for number in samples]


def next_samples(
    now: Sequence[int],
    variances: Sequence[float],
    costs: Sequence[float],
    *,
    variance: float,
    least: int = 1,
) -> list[int]:
    """Samples of every part after the next batch, on the way to a variance of their sum.

    Args:
        now: Samples of each part so far, at least 1.
        variances: Variance of one sample of each part; where none is known and above 0 in sum,
            all parts count alike.
        costs: Cost of one sample of each part, above 0.
        variance: Variance of the sum that is asked for, above 0.
        least: Samples that every part gets in any case.

    Returns:
        Samples of each part; at least one has more than now, and none has fewer.
    """
    known = np.asarray(variances, dtype=np.float64)
    if not np.all(np.isfinite(known)) or not known.any():
        known = np.ones(len(now))
    wanted = np.asarray(share_samples(known.tolist(), costs, variance=variance))
    wanted = np.maximum(wanted, LEAST_SHARE * wanted.max())
    have = np.asarray(now, dtype=np.float64)
    # All parts move toward their shares together; the one that lacks most sets the pace.
    pace = float((wanted / have).max())
    wanted *= min(max(pace, LEAST_GROWTH), GROWTH) / pace
    return [
        math.ceil(max(count, least)) if max(count, least) >= WORTH_WHILE * had else had
        for count, had in zip(wanted, now, strict=True)
    ]
