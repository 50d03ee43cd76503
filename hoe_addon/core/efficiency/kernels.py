# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two kernels of thin gratings, accurate to rounding at and near their singular points.

sinc(x) = sin(pi x) / (pi x), and for N steps K_N(x) = sin(pi x) / (N sin(pi x / N)). Every sine is
reduced to the nearest integer, and K_N to the nearest multiple of N.
"""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, IntArray, as_float

_FLAT_TOP = 1e-9
"""Both kernels are 1 - O(x^2) at 0: closer than this they are 1 in double precision."""


def split(values: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return the nearest integers and the exact rests in [-1/2, 1/2]; NaN keeps a NaN rest."""
    nearest = as_float(np.rint(values))
    whole = np.where(np.isfinite(nearest), nearest, 0.0)
    with np.errstate(invalid="ignore"):
        return whole.astype(np.int64), values - nearest


def alternate(whole: IntArray) -> FloatArray:
    """Return (-1) to the power of an integer."""
    return np.where(whole % 2 == 0, 1.0, -1.0)


def turned(turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return cosine and sine of pi times a number."""
    whole, rest = split(turns)
    sign = alternate(whole)
    # The cosine as a sine, which is exactly 0 at 1/2.
    return sign * np.sin(np.pi * (0.5 - np.abs(rest))), sign * np.sin(np.pi * rest)


def sinc(values: ArrayLike) -> FloatArray:
    """Return sin(pi x) / (pi x)."""
    return sinc_of(*split(as_float(values)))


def sinc_of(whole: IntArray, rest: FloatArray) -> FloatArray:
    """Return sin(pi x) / (pi x) for x = whole + rest, whose sum may have lost digits."""
    position = whole + rest
    flat = np.abs(position) < _FLAT_TOP
    safe = np.where(flat, 1.0, position)
    return np.where(flat, 1.0, alternate(whole) * np.sin(np.pi * rest) / (np.pi * safe))


def sinc_of_quotient(order: IntArray, parts: int) -> FloatArray:
    """Return sinc(m / N), exactly 0 where m is a multiple of N other than 0."""
    # m / N = j + (m - j N) / N: an exact whole part, and a rest of one rounding.
    turns = np.rint(order / parts).astype(np.int64)
    return sinc_of(turns, (order - turns * parts) / parts)


def step_kernel(whole: IntArray, rest: FloatArray, steps: int) -> FloatArray:
    """Return sin(pi x) / (N sin(pi x / N)) for x = whole + rest."""
    turns = np.rint(whole / steps).astype(np.int64)
    near = whole - turns * steps
    position = near + rest
    flat = np.abs(position) < _FLAT_TOP
    safe = np.where(flat, 1.0, position)
    ratio = alternate(near) * np.sin(np.pi * rest) / (steps * np.sin(np.pi * safe / steps))
    # K_N(x + N) = (-1)^(N - 1) K_N(x)
    return alternate(turns * (steps - 1)) * np.where(flat, 1.0, ratio)
