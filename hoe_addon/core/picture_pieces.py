# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Independent renders of one picture, and the noise that their scatter shows."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, as_float
from .colour import LUMINANCE_WEIGHTS
from .errors import SpecError


@dataclass(frozen=True, eq=False)
class Pieces:
    """Independent renders of one picture, each with random numbers of its own.

    Attributes:
        pixels: Linear Rec. 709 values, each of shape ``(height, width, 3)``.
        samples: Samples per pixel of each.

    Raises:
        SpecError: There is none, or not one number of samples for each.
    """

    pixels: Sequence[NDArray[np.floating]]
    samples: Sequence[float]

    def __post_init__(self) -> None:
        """Check the numbers."""
        if not self.pixels or len(self.pixels) != len(self.samples):
            raise SpecError(
                f"samples: must be one for each of {len(self.pixels)} pictures, at least one, "
                f"got {len(self.samples)}"
            )

    @property
    def total(self) -> float:
        """Samples per pixel of all together."""
        return sum(self.samples)

    def mean(self) -> FloatArray:
        """Give the picture of all samples, shape ``(height, width, 3)``."""
        weighted = (
            count * as_float(piece) for piece, count in zip(self.pixels, self.samples, strict=True)
        )
        return np.asarray(sum(weighted, np.zeros(self.pixels[0].shape))) / self.total

    def sample_variance(self) -> FloatArray:
        """Estimate the variance of one sample's luminance from the scatter of the pieces.

        A piece of n samples has 1 / n of it, so (n_k (L_k - L)^2) summed over K pieces is K - 1
        times as much; samples that are spread evenly have less than this at large n, never more.

        Returns:
            Variance in each pixel, shape ``(height, width)``; infinite for a single piece.
        """
        if len(self.pixels) < 2:
            return np.full(self.pixels[0].shape[:2], np.inf)
        mean = relative_luminance(self.mean())
        scatter = np.zeros(mean.shape)
        for piece, count in zip(self.pixels, self.samples, strict=True):
            scatter += count * (relative_luminance(piece) - mean) ** 2
        return scatter / (len(self.pixels) - 1)

    def half(self, first: int) -> "Pieces":
        """Give every second piece.

        Args:
            first: Number of the first one, 0 or 1.

        Returns:
            That half.
        """
        return Pieces(self.pixels[first::2], self.samples[first::2])


def relative_luminance(pixels: NDArray[np.floating]) -> FloatArray:
    """Luminance of linear Rec. 709 colours, 1 for white, shape without the last axis."""
    return as_float(pixels) @ LUMINANCE_WEIGHTS
