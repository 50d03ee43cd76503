# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Array types and the small vector helpers that all optics modules share."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

type FloatArray = NDArray[np.float64]
type ComplexArray = NDArray[np.complex128]
type IntArray = NDArray[np.int64]
type BoolArray = NDArray[np.bool_]


def as_float(values: ArrayLike) -> FloatArray:
    """Return the values as a float64 array, without a copy where possible."""
    return np.asarray(values, dtype=np.float64)


def dot(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the scalar product over the last axis.

    Args:
        first: Vectors, shape ``(..., k)``.
        second: Vectors, broadcastable to ``first``.

    Returns:
        Products, the broadcast shape without its last axis.
    """
    return np.asarray(np.sum(first * second, axis=-1), dtype=np.float64)


def unit(vectors: ArrayLike) -> FloatArray:
    """Return vectors scaled to length 1; NaN where the length is zero or not finite.

    Args:
        vectors: Vectors of any length, shape ``(..., k)``.

    Returns:
        Unit vectors, same shape.
    """
    values = as_float(vectors)
    # Scaling by the largest component first keeps the squares from overflow and underflow.
    with np.errstate(invalid="ignore", divide="ignore"):
        scaled = values / np.max(np.abs(values), axis=-1, keepdims=True)
        return scaled / np.sqrt(np.sum(scaled * scaled, axis=-1, keepdims=True))
