# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How noisy a picture is, told by two independent halves of its samples, with confidence.

The picture is the mean of the halves A and B. Where nothing else is done to them, a quarter of
(A - B)^2 is on average the variance of that mean. Where each half was denoised, to A' and B', the
other half judges it, for its noise is independent: (A' - B)^2 is on average the squared error of
A' and the variance of B. No reference is needed, and no shape of the noise is assumed: the bound
comes from the scatter over blocks of pixels, so that rare bright pixels widen it.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import BoolArray, FloatArray

CONFIDENCE = 0.95
"""Probability with which the picture's error is below the upper bound."""

LIT = 0.01
"""Pixels darker than this part of the mean luminance do not belong to the lit picture."""

NOISE_BLOCK = 8
"""Side of a block in pixels: neighbouring pixels have almost independent noise."""

DENOISED_BLOCK = 32
"""The denoiser spreads an error over tens of pixels, which then stand and fall together."""

_LEAST_BLOCKS = 64
_LEAST_SIDE = 2
_DRAWS = 1000
_SEED = 1
"""Same halves, same bound."""


@dataclass(frozen=True)
class SamplingError:
    """Relative root mean square error of a picture's luminance.

    Attributes:
        error: The estimate, over the mean luminance.
        upper: Not exceeded with the given confidence.
        confidence: Probability, 0 to 1.
    """

    error: float
    upper: float
    confidence: float = CONFIDENCE


@dataclass(frozen=True, eq=False)
class Halves:
    """Luminance of two independent halves of a picture's samples, in any unit.

    Attributes:
        first: Shape ``(height, width)``.
        second: Same shape.
    """

    first: FloatArray
    second: FloatArray

    @property
    def mean(self) -> FloatArray:
        """The picture of all samples."""
        return 0.5 * (self.first + self.second)


def noise_error(halves: Halves, field: BoolArray) -> SamplingError:
    """Error of the mean of two halves.

    Args:
        halves: The halves.
        field: Pixels that count, shape ``(height, width)``.

    Returns:
        The error; infinite where the field is black or empty.
    """
    squares = 0.25 * (halves.first - halves.second) ** 2
    return _error(squares, halves, field, NOISE_BLOCK)


def denoised_error(halves: Halves, clean: Halves, field: BoolArray) -> SamplingError:
    """Error of the mean of two halves that were denoised apart: what is left of noise, and blur.

    From the squared errors of A' and B', each judged by the other half, and
    ``((x + y) / 2)^2 = (x^2 + y^2) / 2 - (x - y)^2 / 4`` for their errors x and y.

    Args:
        halves: The noisy halves.
        clean: The same, each denoised without knowledge of the other.
        field: Pixels that count, shape ``(height, width)``.

    Returns:
        The error; 0 where chance makes the estimate of its square negative.

    References:
        Rousselle, Knaus and Zwicker (2012), "Adaptive Rendering with Non-Local Means Filtering",
        ACM Transactions on Graphics 31(6), 195, for denoised halves that judge one another.
    """
    crossed = (clean.first - halves.second) ** 2 + (clean.second - halves.first) ** 2
    noise = (halves.first - halves.second) ** 2
    squares = 0.5 * (crossed - noise) - 0.25 * (clean.first - clean.second) ** 2
    return _error(squares, halves, field, DENOISED_BLOCK)


def lit_field(luminance: FloatArray) -> BoolArray:
    """Pixels of a picture that are not black.

    Args:
        luminance: Shape ``(height, width)``.

    Returns:
        True where there is light, same shape.
    """
    return luminance > LIT * max(float(luminance.mean()), 0.0)


def relative_variance(halves: Halves, picture: FloatArray, field: BoolArray) -> float:
    """Mean variance of a part of a picture, over the squared mean luminance of the whole.

    Args:
        halves: Halves of the part, such as the light of the room.
        picture: Luminance of the whole picture, same shape.
        field: Pixels that count.

    Returns:
        The relative variance of the mean of the halves; parts with independent noise add up.
        Infinite where the field is black or empty.
    """
    mean = float(picture[field].mean()) if field.any() else 0.0
    if mean <= 0.0:
        return math.inf
    return float((0.25 * (halves.first - halves.second)[field] ** 2).mean()) / mean**2


def _error(squares: FloatArray, halves: Halves, field: BoolArray, side: int) -> SamplingError:
    """Root of the mean of per-pixel estimates of a squared error, relative, and its bound."""
    mean = float(halves.mean[field].mean()) if field.any() else 0.0
    if mean <= 0.0:
        return SamplingError(math.inf, math.inf)
    sums, counts = _blocks(squares, field, side)
    square = float(sums.sum() / counts.sum())
    draws = np.random.default_rng(_SEED).poisson(1.0, (_DRAWS, len(sums)))
    drawn = (draws @ sums) / np.maximum(draws @ counts, 1)
    # The squared error of the one picture at hand scatters around its expectation as much as the
    # estimate does, and independently: A + B and A - B are uncorrelated.
    spread = np.sqrt(2.0) * (float(np.quantile(drawn, CONFIDENCE)) - square)
    upper = max(square + max(spread, 0.0), 0.0)
    return SamplingError(math.sqrt(max(square, 0.0)) / mean, math.sqrt(upper) / mean)


def _blocks(
    squares: FloatArray, field: BoolArray, side: int
) -> tuple[FloatArray, NDArray[np.int64]]:
    """Sums and numbers of pixels over square blocks that hold a pixel of the field."""
    while side > _LEAST_SIDE and int(field.sum()) < _LEAST_BLOCKS * side * side:
        side //= 2
    rows, columns = np.nonzero(field)
    place = (rows // side) * (field.shape[1] // side + 1) + columns // side
    counts = np.bincount(place)
    sums = np.bincount(place, weights=squares[rows, columns])
    return sums[counts > 0], counts[counts > 0]
