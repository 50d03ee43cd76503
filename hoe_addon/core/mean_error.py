# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How well the mean luminance of one noisy picture is known, told by its pixels alone."""

import math

import numpy as np

from .arrays import BoolArray, FloatArray


def mean_error(luminance: FloatArray, field: BoolArray) -> float:
    """Tell the standard error of a mean, or somewhat more.

    Neighbours have independent noise; half of their squared difference is on average its variance
    and what they show differently, so that detail makes the error larger, never smaller. Of rows
    and columns those with less detail tell more.

    Args:
        luminance: Shape ``(height, width)``.
        field: Pixels that are averaged, same shape.

    Returns:
        Standard error of the mean over the field at most, in the unit of the luminance; NaN where
        no two of its pixels are neighbours.
    """
    variances = [
        _variance(values, inside) for values, inside in ((luminance, field), (luminance.T, field.T))
    ]
    known = [each for each in variances if math.isfinite(each)]
    return math.sqrt(min(known) / int(field.sum())) if known else math.nan


def _variance(luminance: FloatArray, field: BoolArray) -> float:
    both = field[:, 1:] & field[:, :-1]
    squares = 0.5 * np.diff(luminance, axis=1) ** 2
    return float(squares[both].mean()) if both.any() else math.nan
