# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinoform orders in scalar theory: continuous relief and relief of N levels.

With the phase depth alpha (in periods of 2 pi) the order m has the amplitude

    continuous:  D_m = (-1)^m e^{i alpha pi} sinc(alpha - m)
    N levels:    D_m = (-1)^m e^{i alpha pi} sinc(m / N) K_N(alpha - m)

where sinc(x) = sin(pi x) / (pi x) and K_N(x) = sin(pi x) / (N sin(pi x / N)). The levels are
sampled at the middle of each step. Every sine is reduced to the nearest integer, and K_N to the
nearest multiple of N, so that the removable singularities are reached smoothly.

References:
    Swanson (1989), Binary optics technology: the theory and design of multi-level diffractive
    optical elements, MIT Lincoln Laboratory technical report 854.
    O'Shea, Suleski, Kathman, Prather (2004), Diffractive Optics, SPIE.
"""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray, IntArray, as_float
from ..errors import SpecError
from ..media import Medium

CONTINUOUS = 0
"""The number of levels that stands for a continuous relief."""

_FLAT_TOP = 1e-9
"""Both kernels are 1 - O(x^2) at 0: closer than this they are 1 in double precision."""


def check_levels(levels: int) -> None:
    """Raise SpecError unless the relief is continuous (0) or has at least two levels."""
    if levels != CONTINUOUS and levels < 2:
        raise SpecError(f"levels: must be 0 (continuous) or at least 2, got {levels}")


def phase_depth(wavelength: ArrayLike, design_wavelength: float, relief: Medium) -> FloatArray:
    """Return the phase depth alpha of a relief in air, in periods of 2 pi.

    Args:
        wavelength: Vacuum wavelength, metres, shape ``(...)``.
        design_wavelength: Wavelength at which alpha is 1, metres.
        relief: Material of the relief.

    Returns:
        ``(n(lambda) - 1) / (n(lambda_0) - 1) * lambda_0 / lambda``, shape ``(...)``.

    Raises:
        SpecError: If the relief has the index of air at the design wavelength.
    """
    wavelengths = as_float(wavelength)
    step_design = float(relief.index(design_wavelength)) - 1.0
    if step_design == 0.0:
        raise SpecError("relief: index must not be 1 at the design wavelength, got 1.0")
    step = as_float(relief.index(wavelengths)) - 1.0
    return (step / step_design) * (design_wavelength / wavelengths)


def amplitude(order: ArrayLike, alpha: ArrayLike, levels: int) -> ComplexArray:
    """Return the complex amplitude D_m of a kinoform order.

    Args:
        order: Diffraction order m, integer, shape ``(...)``.
        alpha: Phase depth in periods of 2 pi, broadcastable to ``order``.
        levels: Number of levels, or 0 for a continuous relief.

    Returns:
        Amplitudes, broadcast shape. The phase is that of levels sampled at the middle of
        each step; a staircase that starts at 0 has ``e^{-i alpha pi / N}`` in addition.

    Raises:
        SpecError: If ``levels`` is 1 or negative.
    """
    depth = as_float(alpha)
    whole, rest = _split(depth)
    # (-1)^m e^{i pi alpha}, with both whole parts taken out as one sign.
    sign = _alternate(whole - np.asarray(order, dtype=np.int64))
    phase = sign * (np.cos(np.pi * rest) + 1j * np.sin(np.pi * rest))
    return np.asarray(phase * _envelope(order, depth, levels), dtype=np.complex128)


def efficiency(order: ArrayLike, alpha: ArrayLike, levels: int) -> FloatArray:
    """Return the power efficiency |D_m|^2 of a kinoform order.

    Args:
        order: Diffraction order m, integer, shape ``(...)``.
        alpha: Phase depth in periods of 2 pi, broadcastable to ``order``.
        levels: Number of levels, or 0 for a continuous relief.

    Returns:
        Efficiencies in [0, 1], broadcast shape. Over all orders they sum to 1. With N levels
        the orders that are multiples of N, except 0, are exactly 0.

    Raises:
        SpecError: If ``levels`` is 1 or negative.
    """
    return _envelope(order, as_float(alpha), levels) ** 2


def _envelope(order: ArrayLike, alpha: FloatArray, levels: int) -> FloatArray:
    """Return the real part of the amplitude: sinc, or sinc times the N-level kernel."""
    check_levels(levels)
    orders = np.asarray(order, dtype=np.int64)
    whole, rest = _split(alpha)
    distance = whole - orders
    if levels == CONTINUOUS:
        return _sinc(distance, rest)
    # m / N = j + (m - j N) / N: an exact whole part, and a rest of one rounding.
    turns = np.rint(orders / levels).astype(np.int64)
    return _sinc(turns, (orders - turns * levels) / levels) * _kernel(distance, rest, levels)


def _split(values: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return the nearest integers and the exact rests in [-1/2, 1/2]; NaN keeps a NaN rest."""
    nearest = as_float(np.rint(values))
    whole = np.where(np.isfinite(nearest), nearest, 0.0)
    with np.errstate(invalid="ignore"):
        return whole.astype(np.int64), values - nearest


def _alternate(whole: IntArray) -> FloatArray:
    """Return (-1) to the power of an integer."""
    return np.where(whole % 2 == 0, 1.0, -1.0)


def _sinc(whole: IntArray, rest: FloatArray) -> FloatArray:
    """Return sin(pi x) / (pi x) for x = whole + rest."""
    position = whole + rest
    flat = np.abs(position) < _FLAT_TOP
    safe = np.where(flat, 1.0, position)
    return np.where(flat, 1.0, _alternate(whole) * np.sin(np.pi * rest) / (np.pi * safe))


def _kernel(whole: IntArray, rest: FloatArray, levels: int) -> FloatArray:
    """Return sin(pi x) / (N sin(pi x / N)) for x = whole + rest."""
    turns = np.rint(whole / levels).astype(np.int64)
    near = whole - turns * levels
    position = near + rest
    flat = np.abs(position) < _FLAT_TOP
    safe = np.where(flat, 1.0, position)
    ratio = _alternate(near) * np.sin(np.pi * rest) / (levels * np.sin(np.pi * safe / levels))
    # K_N(x + N) = (-1)^(N - 1) K_N(x)
    return _alternate(turns * (levels - 1)) * np.where(flat, 1.0, ratio)
