# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fresnel reflectance of a plane boundary between two lossless media."""

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float


def reflectance_s(cos_in: ArrayLike, index_in: ArrayLike, index_out: ArrayLike) -> FloatArray:
    """Return the power reflectance for light polarised across the plane of incidence.

    Args:
        cos_in: Cosine of the angle of incidence in its own medium; the sign is ignored.
        index_in: Index of the medium of incidence, above 0, broadcastable.
        index_out: Index of the other medium, above 0, broadcastable.

    Returns:
        Reflectance in [0, 1], broadcast shape; 1 beyond the critical angle.

    References:
        Born and Wolf, Principles of Optics, 7th ed., section 1.5.2.
    """
    return _amplitude_s(cos_in, index_in, index_out)[0] ** 2


def reflectance_p(cos_in: ArrayLike, index_in: ArrayLike, index_out: ArrayLike) -> FloatArray:
    """Return the power reflectance for light polarised in the plane of incidence.

    Args:
        cos_in: Cosine of the angle of incidence in its own medium; the sign is ignored.
        index_in: Index of the medium of incidence, above 0, broadcastable.
        index_out: Index of the other medium, above 0, broadcastable.

    Returns:
        Reflectance in [0, 1], broadcast shape; 1 beyond the critical angle.

    References:
        Born and Wolf, Principles of Optics, 7th ed., section 1.5.2.
    """
    amplitude, ratio = _amplitude_s(cos_in, index_in, index_out)
    return (amplitude * ratio) ** 2


def reflectance_unpolarised(
    cos_in: ArrayLike, index_in: ArrayLike, index_out: ArrayLike
) -> FloatArray:
    """Return the power reflectance for unpolarised light, the mean of s and p.

    Args:
        cos_in: Cosine of the angle of incidence in its own medium; the sign is ignored.
        index_in: Index of the medium of incidence, above 0, broadcastable.
        index_out: Index of the other medium, above 0, broadcastable.

    Returns:
        Reflectance in [0, 1], broadcast shape; 1 beyond the critical angle. What it lacks
        from 1 is transmitted.

    References:
        Born and Wolf, Principles of Optics, 7th ed., section 1.5.3.
    """
    amplitude, ratio = _amplitude_s(cos_in, index_in, index_out)
    return 0.5 * amplitude**2 * (1.0 + ratio**2)


def _amplitude_s(
    cos_in: ArrayLike, index_in: ArrayLike, index_out: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Return |r_s| and |r_p / r_s|.

    The difference n cos - n' cos' is written as (n^2 - n'^2) over the sum, so nearly equal media
    lose no digits; r_p / r_s = cos(i + i') / cos(i - i').
    """
    cosine = np.abs(as_float(cos_in))
    n_in, n_out = as_float(index_in), as_float(index_out)
    contrast = (n_in - n_out) * (n_in + n_out)
    squared = (n_in * cosine) ** 2 - contrast
    total = squared < 0.0
    normal_out = np.sqrt(np.where(total, 0.0, squared))
    both = n_in * cosine + normal_out
    # Equal media reflect nothing, even at exactly grazing incidence where both is 0.
    safe = np.where(both > 0.0, both, 1.0)
    amplitude = np.where(total, 1.0, np.minimum(np.abs(contrast) / safe**2, 1.0))
    cos_product = cosine * normal_out
    sin_product = n_in * (1.0 - cosine) * (1.0 + cosine)
    ratio = np.where(total, 1.0, (cos_product - sin_product) / (cos_product + sin_product))
    return amplitude, ratio
