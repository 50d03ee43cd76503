# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bessel functions J_n of whole order, by the recurrence run downward.

References:
    Abramowitz, Stegun (1964), Handbook of Mathematical Functions, section 9.12 (Miller's
    algorithm), equations 9.1.27 (recurrence), 9.1.46 (its norm), and 9.1.10 (series).
"""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, IntArray, as_float

_SMALL = 1e-3
"""Below this argument three terms of the series are exact in double precision."""

_LARGE = 1e100
"""A recurrence that has grown beyond this is scaled down."""


def bessel_j(order: ArrayLike, argument: ArrayLike) -> FloatArray:
    """Return J_n(z).

    Args:
        order: Whole n of any sign, shape ``(...)``.
        argument: Real z, broadcastable to ``order``.

    Returns:
        Values, broadcast shape, within some roundings of the larger of J_n(z) and 1e-300.
    """
    orders, values = np.broadcast_arrays(np.asarray(order, dtype=np.int64), as_float(argument))
    size, place = np.abs(orders), np.abs(values)
    found = np.where(place < _SMALL, _series(size, place), _recurrence(size, place))
    # J_-n(z) = J_n(-z) = (-1)^n J_n(z)
    odd = (size % 2 == 1) & ((orders < 0) != (values < 0.0))
    return np.where(odd, -found, found)


def _series(orders: IntArray, values: FloatArray) -> FloatArray:
    half = np.where(values < _SMALL, 0.5 * values, 0.0)
    first = np.ones(orders.shape)
    for step in range(1, int(orders.max(initial=0)) + 1):
        first = np.where(step <= orders, first * half / step, first)
    square = half * half
    return first * (1.0 - square / (orders + 1) * (1.0 - square / (2.0 * (orders + 2))))


def _recurrence(orders: IntArray, values: FloatArray) -> FloatArray:
    usable = np.isfinite(values) & (values >= _SMALL)
    safe = np.where(usable, values, 1.0)
    reach = max(float(safe.max(initial=1.0)), float(orders.max(initial=0)))
    # Beyond the larger of n and z, J falls within some 10 cube roots of z below 1e-17.
    top = 2 * int(np.ceil(0.5 * (reach + 10.0 * np.cbrt(reach) + 20.0)))
    above, here = np.zeros(safe.shape), np.full(safe.shape, 1e-200)
    found, norm = np.where(orders == top, here, 0.0), 2.0 * here
    for step in range(top, 0, -1):
        above, here = here, 2.0 * step / safe * here - above
        found = np.where(orders == step - 1, here, found)
        if step % 2 == 1:
            # J_0 + 2 J_2 + 2 J_4 + ... = 1
            norm = norm + (here if step == 1 else 2.0 * here)
        scale = np.where(np.abs(here) > _LARGE, 1.0 / _LARGE, 1.0)
        above, here, found, norm = above * scale, here * scale, found * scale, norm * scale
    return np.where(usable, found / norm, np.nan)
