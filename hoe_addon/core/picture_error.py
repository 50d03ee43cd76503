# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a rendered picture is from a reference: noise, bias, colour and sharpness.

The reference has noise of its own, which is known from independent renders of it and is taken off
what is found. Pixels are independent of each other: Cycles draws the place of each sample inside
the filter of its own pixel, so no sample serves two pixels.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import BoolArray, FloatArray, IntArray, as_float
from .colour import LINEAR_REC709_TO_XYZ, uv_prime
from .errors import SpecError
from .picture_pieces import Pieces, relative_luminance
from .sampling_error import Halves, noise_error

COLUMNS, ROWS = 8, 6
"""Regions that the field is cut into, across and down."""

DARK = 0.05
"""Regions darker than this part of the field's mean are left out: nobody sees their errors."""

ENOUGH = 3.0
"""How many times smaller the reference's own error has to be than what it judges."""

_LATTICE = 4
"""Every 4th pixel across and down makes one of 16 groups, whose scatter gives error bars."""

_LEAST_PIXELS = 4
_BRIGHT = 0.99


@dataclass(frozen=True)
class Estimate:
    """A number and how well it is known.

    Attributes:
        value: The number.
        standard_error: Standard deviation of its error.
    """

    value: float
    standard_error: float


@dataclass(frozen=True, eq=False)
class Reference:
    """The picture that others are judged by.

    Attributes:
        picture: All of its samples, shape ``(height, width, 3)``.
        variance: Variance of its luminance in each pixel, shape ``(height, width)``.
        field: Pixels that count, shape ``(height, width)``.
        halves: The picture by one and by the other half of its samples.
    """

    picture: FloatArray
    variance: FloatArray
    field: BoolArray
    halves: tuple[FloatArray, FloatArray]

    @property
    def mean(self) -> float:
        """Mean luminance over the field."""
        return float(np.mean(relative_luminance(self.picture)[self.field]))

    def own_error(self) -> float:
        """Relative RMS error of its luminance, by the difference of its halves."""
        first, second = (relative_luminance(half) for half in self.halves)
        return noise_error(Halves(first, second), self.field).error

    def own_region_error(self) -> float:
        """Half the largest relative difference of its halves in a lit region."""
        none = np.zeros_like(self.variance)
        first, second = self.halves
        other = Reference(second, none, self.field, self.halves)
        return worst_region(first, none, other).value / 2.0

    def own_colour_error(self) -> float:
        """Half the mean difference of its halves in u'v' over the regions."""
        first, second = self.halves
        return colour_difference(first, second, self).value / 2.0


def reference_of(pieces: Pieces, field: BoolArray) -> Reference:
    """Make a reference of independent renders that come in pairs of equal samples.

    Args:
        pieces: The renders, an even number of them.
        field: Pixels that count, shape ``(height, width)``; all of them where none is set.

    Returns:
        The reference.

    Raises:
        SpecError: A piece has no partner, or all is black.
    """
    first, second = (list(pieces.samples[start::2]) for start in (0, 1))
    if first != second:
        raise SpecError(f"samples: must come in equal pairs, got {list(pieces.samples)}")
    halves = pieces.half(0).mean(), pieces.half(1).mean()
    variance = (relative_luminance(halves[0]) - relative_luminance(halves[1])) ** 2 / 4.0
    inside = field if field.any() else np.ones_like(field)
    reference = Reference(pieces.mean(), variance, inside, halves)
    if not reference.mean > 0.0:
        raise SpecError("reference: must not be black over the field")
    return reference


def emitter_field(light: NDArray[np.floating]) -> BoolArray:
    """Find where the light of displays and lamps is seen.

    Args:
        light: That light alone, linear Rec. 709 values, shape ``(height, width, 3)``.

    Returns:
        Pixels with 5 % of the luminance that one pixel in a hundred reaches, at least; none of
        them where it is dark, shape ``(height, width)``.
    """
    values = relative_luminance(light)
    bright = float(np.quantile(values, _BRIGHT))
    return (values >= DARK * bright) & (values > 0.0)


def luminance_error(picture: NDArray[np.floating], reference: Reference) -> Estimate:
    """Relative root mean square error of luminance over the field, noise and bias together.

    Args:
        picture: Linear Rec. 709 values, shape ``(height, width, 3)``.
        reference: What it is judged by.

    Returns:
        sqrt(mean (X - R)^2 - mean var R) / mean R, 0 where the difference is negative; the
        standard error is that of the mean square, from the scatter of 16 interleaved groups of
        pixels, carried over to the root.
    """
    difference = relative_luminance(picture) - relative_luminance(reference.picture)
    squares = difference**2 - reference.variance
    inside = reference.field
    square = float(np.mean(squares[inside]))
    groups = _lattice(inside.shape)
    each = [float(np.mean(squares[inside & (groups == k)])) for k in np.unique(groups[inside])]
    known = float(np.std(each, ddof=1)) / len(each) ** 0.5 if len(each) > 1 else abs(square)
    value = max(square, 0.0) ** 0.5
    # Of the square x^2 +- s the root is x +- s / 2x; near 0 it is anything up to sqrt(s).
    error = min(known / (2.0 * value), known**0.5) if value > 0.0 else known**0.5
    return Estimate(value / reference.mean, error / reference.mean)


def worst_region(
    picture: NDArray[np.floating], variance: FloatArray, reference: Reference
) -> Estimate:
    """Worst-region bias: largest relative error of the mean luminance of a region.

    Args:
        picture: Linear Rec. 709 values, shape ``(height, width, 3)``.
        variance: Variance of its luminance in each pixel, shape ``(height, width)``.
        reference: What it is judged by.

    Returns:
        max |mean X - mean R| / mean R over the lit regions, and the standard error of that
        region's; NaN where no region is lit. Of 48 regions without any bias the worst is some 2.5
        standard errors off.
    """
    worst = Estimate(math.nan, math.nan)
    difference = relative_luminance(picture) - relative_luminance(reference.picture)
    noise = variance + reference.variance
    for region in lit_regions(reference):
        mean = float(np.mean(relative_luminance(reference.picture)[region]))
        bias = abs(float(np.mean(difference[region]))) / mean
        if not bias < worst.value:
            error = float(np.sqrt(np.mean(noise[region]) / np.count_nonzero(region))) / mean
            worst = Estimate(bias, error)
    return worst


def colour_difference(
    picture: NDArray[np.floating], other: NDArray[np.floating], reference: Reference
) -> Estimate:
    """Mean distance in the CIE 1976 diagram between the mean colours of the lit regions.

    Args:
        picture: Linear Rec. 709 values, shape ``(height, width, 3)``.
        other: What it is compared with, same shape.
        reference: What says where the regions are.

    Returns:
        Mean of |u'v' - u'v'| over the regions, noise included, and its standard error from their
        scatter; a region without a colour in one of the two is left out. NaN where none is left.
    """
    distances: list[float] = []
    for region in lit_regions(reference):
        own, its = (
            uv_prime(LINEAR_REC709_TO_XYZ @ as_float(each)[region].mean(axis=0))
            for each in (picture, other)
        )
        distances.append(float(np.hypot(*(own - its))))
    known = np.array(distances)[np.isfinite(distances)]
    if not known.size:
        return Estimate(math.nan, math.nan)
    scatter = float(np.std(known, ddof=1)) if known.size > 1 else 0.0
    return Estimate(float(known.mean()), scatter / known.size**0.5)


def lit_regions(reference: Reference) -> list[BoolArray]:
    """Cut the field into regions, and leave the dark ones out.

    Args:
        reference: Picture and field.

    Returns:
        Masks of the regions of an even grid over the field's bounding box that hold a quarter of
        their pixels at least, each of shape ``(height, width)``.
    """
    field = reference.field
    rows, columns = (np.flatnonzero(field.any(axis=axis)) for axis in (1, 0))
    down = _cells(rows[0], rows[-1], ROWS, field.shape[0])
    across = _cells(columns[0], columns[-1], COLUMNS, field.shape[1])
    labels = down[:, None] * COLUMNS + across[None, :]
    least = max(_LEAST_PIXELS, np.ptp(rows) * np.ptp(columns) // (4 * ROWS * COLUMNS))
    lit = DARK * reference.mean
    values = relative_luminance(reference.picture)
    regions = (field & (labels == label) for label in range(ROWS * COLUMNS))
    return [
        region
        for region in regions
        if np.count_nonzero(region) >= least and float(np.mean(values[region])) >= lit
    ]


def modulation(profile: FloatArray, cycles: int) -> float:
    """Contrast of a wave in a profile that holds a whole number of its cycles.

    Args:
        profile: Luminance at equal steps, shape ``(n,)``, with n above twice the cycles.
        cycles: Number of cycles.

    Returns:
        Amplitude over mean: 1 for (1 + cos) / 2; 0 for black.
    """
    mean = float(np.mean(profile))
    turn = 2.0 * np.pi * cycles * (np.arange(profile.size) + 0.5) / profile.size
    wave = complex(np.mean(profile * np.exp(-1j * turn)))
    return 2.0 * abs(wave) / mean if mean > 0.0 else 0.0


def pareto_front(seconds: Sequence[float], errors: Sequence[float]) -> list[int]:
    """Find the points that no other beats in both time and error.

    Args:
        seconds: Time of each point.
        errors: Error of each point.

    Returns:
        Their numbers, the quickest first.
    """
    front: list[int] = []
    for place in sorted(range(len(seconds)), key=lambda k: (seconds[k], errors[k])):
        if not front or errors[place] < errors[front[-1]]:
            front.append(place)
    return front


def _lattice(shape: tuple[int, ...]) -> IntArray:
    rows, columns = (np.arange(length) % _LATTICE for length in shape)
    return np.asarray(rows[:, None] * _LATTICE + columns[None, :], dtype=np.int64)


def _cells(first: int, last: int, count: int, length: int) -> IntArray:
    """Number of the cell of each place; -large outside the first and the last."""
    place = (np.arange(length) - first) * count // max(last - first + 1, 1)
    outside = (place < 0) | (place >= count)
    return np.where(outside, -ROWS * COLUMNS * COLUMNS, place).astype(np.int64)
