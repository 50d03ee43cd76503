# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Least and greatest value of a noisy picture, told by independent renders of it.

Noise picks the darkest pixel of a noisy picture: its value is too small. So each render tells the
value of the pixel that the other renders together choose, for its own noise has no part in the
choice. That pixel is not always the right one, which errs inward, as the plain extreme errs
outward; half of what lies between the two counts as error too.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from .arrays import FloatArray
from .picture_error import Estimate


def extremes(renders: Sequence[FloatArray]) -> tuple[Estimate, Estimate]:
    """Tell the least and the greatest value of what was rendered.

    Args:
        renders: At least two pictures of the same with independent noise of the same strength.

    Returns:
        Least and greatest value with their standard errors; the mean of all lies between them.
    """
    values = np.stack([each.ravel() for each in renders])
    mean = float(values.mean())
    least, greatest = (_extreme(values, pick) for pick in (np.argmin, np.argmax))
    # Strong noise may tell otherwise; the mean is known much better than any one pixel.
    return (
        Estimate(min(least.value, mean), least.standard_error),
        Estimate(max(greatest.value, mean), greatest.standard_error),
    )


def ratio(least: Estimate, greatest: Estimate) -> Estimate:
    """Least over greatest value with its standard error; 0 for black."""
    if not greatest.value > 0.0:
        return Estimate(0.0, 0.0)
    value = least.value / greatest.value
    error = math.hypot(least.standard_error, value * greatest.standard_error) / greatest.value
    return Estimate(value, error)


def _extreme(values: FloatArray, pick: Callable[[FloatArray], np.intp]) -> Estimate:
    """The extreme of the mean of some renders, each a row."""
    total = values.sum(axis=0)
    told = [float(own[pick(total - own)]) for own in values]
    value, plain = float(np.mean(told)), float(total[pick(total)]) / len(values)
    noise = float(np.std(told, ddof=1)) / math.sqrt(len(told))
    return Estimate(value, math.hypot(noise, 0.5 * (value - plain)))
