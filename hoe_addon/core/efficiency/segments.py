# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Relief profiles of any shape, made of steps or of straight lines.

A straight piece of width w with the middle (x, h) that rises by r adds

    w sinc(alpha r - m w) exp(2 pi i (alpha h - m x))

to the amplitude, exactly. Pieces that are level and equally wide are a discrete Fourier transform:
D_m = sinc(m / n) e^{-i pi m / n} / n times the transform of exp(2 pi i alpha h_j) at m modulo n.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray, as_float
from .kernels import sinc, sinc_of_quotient, turned

_MOST_NUMBERS = 1 << 20
"""Complex numbers in one block of work."""


@dataclass(frozen=True, eq=False)
class Segments:
    """Straight pieces over one period.

    Attributes:
        edges: Where the S pieces meet, strictly increasing, over a range of 1, shape ``(S + 1,)``.
        start: Height at the left end of each piece, in phase depths, shape ``(S,)``.
        end: Height at the right end, shape ``(S,)``.
    """

    edges: FloatArray
    start: FloatArray
    end: FloatArray

    @property
    def pieces(self) -> int:
        """The number S of pieces."""
        return len(self.start)

    @property
    def width(self) -> FloatArray:
        """Width of each piece, shape ``(S,)``."""
        return np.diff(self.edges)

    @property
    def middle(self) -> FloatArray:
        """Middle of each piece, shape ``(S,)``."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])

    @property
    def height(self) -> FloatArray:
        """Height at the middle of each piece, shape ``(S,)``."""
        return 0.5 * (self.start + self.end)

    @property
    def rise(self) -> FloatArray:
        """Height that each piece gains, shape ``(S,)``."""
        return self.end - self.start

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m; see `profiles.Profile`."""
        orders, depths = np.broadcast_arrays(np.asarray(order, dtype=np.int64), as_float(alpha))
        total = np.zeros(orders.shape, dtype=np.complex128)
        block = max(1, _MOST_NUMBERS // max(1, orders.size))
        for first in range(0, self.pieces, block):
            part = slice(first, first + block)
            m, depth, width = orders[..., None], depths[..., None], self.width[part]
            cosine, sine = turned(2.0 * (depth * self.height[part] - m * self.middle[part]))
            weight = width * sinc(depth * self.rise[part] - m * width)
            total += np.sum(weight * (cosine + 1j * sine), axis=-1)
        return total

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; see `profiles.Profile`."""
        return np.abs(self.amplitude(order, alpha)) ** 2


@dataclass(frozen=True, eq=False)
class Steps:
    """Level pieces of equal width; orders that are multiples of n, except 0, get exactly nothing.

    Attributes:
        heights: Height on [j / n, (j + 1) / n), in phase depths, shape ``(n,)``.
    """

    heights: FloatArray

    @property
    def pieces(self) -> int:
        """The number n of steps."""
        return len(self.heights)

    def amplitude(self, order: ArrayLike, alpha: ArrayLike) -> ComplexArray:
        """Return the amplitude D_m; see `profiles.Profile`."""
        count, depths = self.pieces, as_float(alpha)
        orders = np.asarray(order, dtype=np.int64)
        shape = np.broadcast_shapes(orders.shape, depths.shape)
        turns = np.broadcast_to(orders % count, shape)
        source = np.broadcast_to(np.arange(depths.size).reshape(depths.shape), shape)
        summed = np.zeros(shape, dtype=np.complex128)
        block = max(1, _MOST_NUMBERS // count)
        for first in range(0, depths.size, block):
            cosine, sine = turned(2.0 * depths.ravel()[first : first + block, None] * self.heights)
            found = np.fft.fft(cosine + 1j * sine, axis=-1)
            chosen = (source >= first) & (source < first + block)
            summed[chosen] = found[source[chosen] - first, turns[chosen]]
        cosine, sine = turned(-orders / count)
        return summed / count * sinc_of_quotient(orders, count) * (cosine + 1j * sine)

    def efficiency(self, order: ArrayLike, alpha: ArrayLike) -> FloatArray:
        """Return the power |D_m|^2; see `profiles.Profile`."""
        return np.abs(self.amplitude(order, alpha)) ** 2

    def segments(self) -> Segments:
        """The same profile as pieces."""
        return Segments(np.linspace(0.0, 1.0, self.pieces + 1), self.heights, self.heights)


def joined_samples(heights: ArrayLike) -> Segments:
    """Join equally spaced samples of one period by straight lines, the last one to the first.

    Args:
        heights: Height at x = j / n, in phase depths, shape ``(n,)``.

    Returns:
        The profile.
    """
    values = as_float(heights)
    return Segments(np.linspace(0.0, 1.0, len(values) + 1), values, np.roll(values, -1))


def triangle(peak: float) -> Segments:
    """Rise straight from 0 to 1, and fall straight back.

    Args:
        peak: Place of the peak, between 0 and 1.

    Returns:
        The profile.
    """
    return Segments(np.array((0.0, peak, 1.0)), np.array((0.0, 1.0)), np.array((1.0, 0.0)))
