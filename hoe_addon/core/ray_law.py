# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ray law of a diffracting surface: n' s' = n s + m (lambda / lambda_0) g + gamma N."""

from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, IntArray, as_float, dot


class Status(IntEnum):
    """What became of a ray."""

    OK = 0
    """The ray goes on."""
    EVANESCENT = 1
    """The order does not propagate; it carries no power."""
    MISS = 2
    """The ray does not meet the surface."""
    UNDEFINED = 3
    """The input has no answer: a point on its own recording source, or a NaN."""


def diffract(
    direction: ArrayLike,
    normal: ArrayLike,
    gradient: ArrayLike,
    order: ArrayLike,
    wavelength_ratio: ArrayLike,
    index_in: ArrayLike,
    index_out: ArrayLike,
    reflected: ArrayLike,
) -> tuple[FloatArray, IntArray]:
    """Return the direction of a diffracted order, transmitted or reflected.

    All arguments broadcast. The squared normal component of n' s' is formed from the change of
    index, the incident normal component and the tangential step, not as n'^2 - |t|^2: order 0
    of a grazing ray then keeps all digits of its small cosine.

    Args:
        direction: Unit direction of the incident light, shape ``(..., 3)``.
        normal: Unit normal, to either side of the surface, shape ``(..., 3)``.
        gradient: ``n_O s_O - n_R s_R`` of the recording, shape ``(..., 3)``; order 0 ignores it.
        order: Diffraction order m, or how many grating vectors are added, shape ``(...)``.
        wavelength_ratio: Wavelength over recording wavelength, shape ``(...)``.
        index_in: Index of the medium of incidence, shape ``(...)``.
        index_out: Index of the other medium, shape ``(...)``; unused for reflected orders.
        reflected: True for an order that goes back, shape ``(...)``.

    Returns:
        Unit directions, shape ``(..., 3)``, NaN where no ray goes on; and the status of each,
        shape ``(...)``. A tangential part of exactly n' is still OK, with the ray in the plane.
        An incident ray exactly in the plane counts as travelling along the normal.

    References:
        Welford (1975), Opt. Commun. 14(3), 322-323.
    """
    incident, axis, vector = as_float(direction), as_float(normal), as_float(gradient)
    n_in = as_float(index_in)
    n_out = np.where(reflected, n_in, as_float(index_out))
    cos_in = dot(incident, axis)
    tangent_in = n_in[..., None] * (incident - cos_in[..., None] * axis)
    step = _tangential_step(vector, axis, as_float(order) * as_float(wavelength_ratio))
    with np.errstate(invalid="ignore"):
        tangent = tangent_in + step
        normal_squared = (
            (n_out - n_in) * (n_out + n_in) + (n_in * cos_in) ** 2 - dot(step, tangent_in + tangent)
        )
        status = np.where(normal_squared >= 0.0, Status.OK, Status.EVANESCENT)
        status = np.where(np.isfinite(normal_squared), status, Status.UNDEFINED)
        onward = np.where(cos_in < 0.0, -1.0, 1.0) * np.where(reflected, -1.0, 1.0)
        normal_part = onward * np.sqrt(normal_squared)
        outgoing = (tangent + normal_part[..., None] * axis) / n_out[..., None]
    outgoing = np.where((status == Status.OK)[..., None], outgoing, np.nan)
    return outgoing, status.astype(np.int64)


def _tangential_step(vector: FloatArray, axis: FloatArray, scale: FloatArray) -> FloatArray:
    """Return the tangential part of the gradient times the scale; exactly 0 for scale 0."""
    tangential = vector - dot(vector, axis)[..., None] * axis
    # Order 0 is the same ray with or without a grating, also where the gradient is not defined.
    return np.where(scale[..., None] == 0.0, 0.0, scale[..., None] * tangential)
