# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of one period of a thin relief, each with the exact amplitudes of its orders.

The height h(x) over one period, x in [0, 1) growing along Q, is in units of the full phase depth
alpha (in periods of 2 pi), and an order has the amplitude

    D_m = integral over x from 0 to 1 of exp(2 pi i (alpha h(x) - m x)).

The powers |D_m|^2 of all orders sum to 1. Shapes without a closed form are in `segments`.

References:
    Magnusson, Gaylord (1978), Diffraction efficiencies of thin phase gratings with arbitrary
    grating shape, J. Opt. Soc. Am. 68, 806, doi:10.1364/JOSA.68.000806.
    Goodman (2005), Introduction to Fourier Optics, section 4.4 (thin sinusoidal phase grating).
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray, as_float
from . import kinoform
from .bessel import bessel_j
from .kernels import alternate, sinc, turned
from .segments import Segments


class Profile(Protocol):
    """One period of a relief."""

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m.

        Args:
            order: Diffraction order m, integer, shape ``(...)``.
            alpha: Phase depth in periods of 2 pi, broadcastable to ``order``.

        Returns:
            Amplitudes, broadcast shape.
        """
        ...

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; arguments and shape as in `amplitude`."""
        ...


@dataclass(frozen=True)
class Sawtooth:
    """h = x, continuous or in steps that take their middle.

    Attributes:
        levels: Number of steps, or 0 for the continuous relief.
        edge_width: Share of the period that each wall takes.
    """

    levels: int = kinoform.CONTINUOUS
    edge_width: float = 0.0

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m; see `Profile`."""
        return kinoform.amplitude(order, alpha, self.levels, self.edge_width)

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; see `Profile`."""
        return kinoform.efficiency(order, alpha, self.levels, self.edge_width)


@dataclass(frozen=True)
class Sinusoid:
    """h = (1 + cos(2 pi x)) / 2: D_m = e^{i pi alpha} i^m J_m(pi alpha)."""

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m; see `Profile`."""
        depth = as_float(alpha)
        quarter = np.array((1.0, 1.0j, -1.0, -1.0j))[np.asarray(order, dtype=np.int64) % 4]
        cosine, sine = turned(depth)
        return (cosine + 1j * sine) * quarter * bessel_j(order, np.pi * depth)

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; see `Profile`."""
        return bessel_j(order, np.pi * as_float(alpha)) ** 2


@dataclass(frozen=True)
class Binary:
    """h = 1 on a share d of the period around its middle, and 0 elsewhere.

    With c = e^{2 pi i alpha} - 1: D_0 = 1 + d c, and D_m = (-1)^m c d sinc(m d).

    Attributes:
        duty: The share d, between 0 and 1.
    """

    duty: float = 0.5

    def segments(self) -> Segments:
        """The same profile as pieces."""
        edges = np.array((0.0, 0.5 - self.duty / 2.0, 0.5 + self.duty / 2.0, 1.0))
        heights = np.array((0.0, 1.0, 0.0))
        return Segments(edges, heights, heights)

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m; see `Profile`."""
        orders = np.asarray(order, dtype=np.int64)
        cosine, sine = turned(as_float(alpha))
        # e^{2 i t} - 1 = 2 i sin t e^{i t}
        change = 2j * sine * (cosine + 1j * sine)
        shape = alternate(orders) * self.duty * sinc(orders * self.duty)
        return np.where(orders == 0, 1.0, 0.0) + change * shape

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; see `Profile`."""
        orders = np.asarray(order, dtype=np.int64)
        cosine, sine = turned(as_float(alpha))
        # |1 + d c|^2 as a sum of squares, which loses no digits where it is small.
        straight = cosine**2 + ((1.0 - 2.0 * self.duty) * sine) ** 2
        turned_away = (2.0 * self.duty * sine * sinc(orders * self.duty)) ** 2
        return np.where(orders == 0, straight, turned_away)
