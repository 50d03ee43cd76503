# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinoform orders in scalar theory: continuous relief and relief of N levels.

With the phase depth alpha (in periods of 2 pi) the order m has the amplitude

    continuous:  D_m = (-1)^m e^{i alpha pi} sinc(alpha - m)
    N levels:    D_m = (-1)^m e^{i alpha pi} sinc(m / N) K_N(alpha - m)

with the kernels of `kernels`. The levels are sampled at the middle of each step.

Where each wall is not upright but takes the share w of the period, as the box average of the height
over w, the profile is a chain of straight lines. With x = alpha - m the second factors become

    continuous:  (1 - w) sinc((1 - w) x) + (-1)^m w sinc((1 - w) alpha + m w)
    N levels:    (1 - N w) sinc(m / N - m w) K_N(x) + (N - 1) w sinc(alpha / N - m w) K_{N-1}(x')
                 + (-1)^m w sinc((N - 1) alpha / N + m w),    x' = (N - 1) x / N

At the design depth the first one leaves (1 - w)^2 of the power in the order 1, the known loss of a
flyback.

References:
    Swanson (1989), Binary optics technology: the theory and design of multi-level diffractive
    optical elements, MIT Lincoln Laboratory technical report 854.
    O'Shea, Suleski, Kathman, Prather (2004), Diffractive Optics, SPIE.
    McManamon et al. (1996), Optical phased array technology, Proc. IEEE 84, 268 (the flyback).
    Testorf (2000), On the zero-thickness model of diffractive optical elements, J. Opt. Soc. Am. A
    17, 1132 (why the phase of oblique light goes with n cos theta).
"""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray, IntArray, as_float
from ..errors import SpecError
from ..media import Medium
from .kernels import alternate, sinc, sinc_of, sinc_of_quotient, split, step_kernel

CONTINUOUS = 0
"""The number of levels that stands for a continuous relief."""


def check_levels(levels: int) -> None:
    """Raise SpecError unless the relief is continuous (0) or has at least two levels."""
    if levels != CONTINUOUS and levels < 2:
        raise SpecError(f"levels: must be 0 (continuous) or at least 2, got {levels}")


def phase_depth(
    wavelength: ArrayLike,
    design_wavelength: float,
    relief: Medium,
    tangential: ArrayLike | None = None,
) -> FloatArray:
    """Return the phase depth alpha of a relief in air, in periods of 2 pi.

    The relief is ``lambda_0 / (n(lambda_0) - 1)`` deep. Over this depth the two ways through
    relief and air differ by ``n cos theta - cos theta_air``, each from the tangential part t of
    n s, which is the same in both: ``n cos theta = sqrt(n^2 - t^2)``. Where t is beyond the
    critical angle of air (t > 1) the air's term is 0, and beyond that of the relief both are.

    Args:
        wavelength: Vacuum wavelength, metres, shape ``(...)``.
        design_wavelength: Wavelength at which alpha is 1 for light along the normal, metres.
        relief: Material of the relief.
        tangential: Tangential part of n s of the light, shape ``(..., 2)``; None for light along
            the normal.

    Returns:
        ``depth / lambda (n cos theta - cos theta_air)``, shape ``(...)``; along the normal
        ``(n(lambda) - 1) / (n(lambda_0) - 1) * lambda_0 / lambda``.

    Raises:
        SpecError: If the relief has the index of air at the design wavelength.
    """
    wavelengths = as_float(wavelength)
    step_design = float(relief.index(design_wavelength)) - 1.0
    if step_design == 0.0:
        raise SpecError("relief: index must not be 1 at the design wavelength, got 1.0")
    index = as_float(relief.index(wavelengths))
    alpha = ((index - 1.0) / step_design) * (design_wavelength / wavelengths)
    if tangential is None:
        return alpha
    squared = np.sum(as_float(tangential) ** 2, axis=-1)
    in_relief = np.sqrt(np.maximum(index * index - squared, 0.0))
    in_air = np.sqrt(np.maximum(1.0 - squared, 0.0))
    # The difference as a quotient of sums: (n^2 - 1) / (n cos theta + cos theta_air).
    below = np.where(squared < 1.0, in_relief + in_air, 1.0)
    deep = (design_wavelength / wavelengths) / step_design * in_relief
    return np.where(squared < 1.0, alpha * ((index + 1.0) / below), deep)


def amplitude(
    order: ArrayLike, alpha: ArrayLike, levels: int, edge_width: float = 0.0
) -> ComplexArray:
    """Return the complex amplitude D_m of a kinoform order.

    Args:
        order: Diffraction order m, integer, shape ``(...)``.
        alpha: Phase depth in periods of 2 pi, broadcastable to ``order``.
        levels: Number of levels, or 0 for a continuous relief.
        edge_width: Share of the period that each wall takes, 0 to 1 over the levels.

    Returns:
        Amplitudes, broadcast shape. The phase is that of levels sampled at the middle of
        each step; a staircase that starts at 0 has ``e^{-i alpha pi / N}`` in addition.

    Raises:
        SpecError: If ``levels`` is 1 or negative.
    """
    depth = as_float(alpha)
    whole, rest = split(depth)
    # (-1)^m e^{i pi alpha}, with both whole parts taken out as one sign.
    sign = alternate(whole - np.asarray(order, dtype=np.int64))
    phase = sign * (np.cos(np.pi * rest) + 1j * np.sin(np.pi * rest))
    return np.asarray(phase * _envelope(order, depth, levels, edge_width), dtype=np.complex128)


def efficiency(
    order: ArrayLike, alpha: ArrayLike, levels: int, edge_width: float = 0.0
) -> FloatArray:
    """Return the power efficiency |D_m|^2 of a kinoform order.

    Args:
        order: Diffraction order m, integer, shape ``(...)``.
        alpha: Phase depth in periods of 2 pi, broadcastable to ``order``.
        levels: Number of levels, or 0 for a continuous relief.
        edge_width: Share of the period that each wall takes, 0 to 1 over the levels.

    Returns:
        Efficiencies in [0, 1], broadcast shape. Over all orders they sum to 1. With N levels and
        upright walls the orders that are multiples of N, except 0, are exactly 0.

    Raises:
        SpecError: If ``levels`` is 1 or negative.
    """
    return _envelope(order, as_float(alpha), levels, edge_width) ** 2


def _envelope(order: ArrayLike, alpha: FloatArray, levels: int, width: float) -> FloatArray:
    """Return the real part of the amplitude: sinc, or sinc times the N-level kernel."""
    check_levels(levels)
    orders = np.asarray(order, dtype=np.int64)
    if width != 0.0:
        return _with_walls(orders, alpha, levels, width)
    whole, rest = split(alpha)
    distance = whole - orders
    if levels == CONTINUOUS:
        return sinc_of(distance, rest)
    return sinc_of_quotient(orders, levels) * step_kernel(distance, rest, levels)


def _with_walls(orders: IntArray, alpha: FloatArray, levels: int, width: float) -> FloatArray:
    """The same where each wall takes a share of the period."""
    whole, rest = split(alpha)
    back = alternate(orders) * width
    if levels == CONTINUOUS:
        facet = (1.0 - width) * sinc((1.0 - width) * ((whole - orders) + rest))
        return facet + back * sinc((1.0 - width) * alpha + orders * width)
    flats = (1.0 - levels * width) * sinc(orders * (1.0 / levels - width))
    flats = flats * step_kernel(whole - orders, rest, levels)
    apart = split((levels - 1.0) / levels * ((whole - orders) + rest))
    rises = width * sinc(alpha / levels - orders * width) * (levels - 1)
    return (
        flats
        + rises * step_kernel(*apart, levels - 1)
        + back * sinc((levels - 1.0) / levels * alpha + orders * width)
    )
