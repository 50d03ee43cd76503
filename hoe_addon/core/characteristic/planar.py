# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What all functions V(x, y) have in common."""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float
from ..errors import SpecError


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanarPattern(ABC):
    """A function of x and y alone; a `Pattern`.

    On a curved surface V is that of the point's x and y: the tangential part of its gradient is
    the gradient along the surface.

    Attributes:
        wavelength: Wavelength that V is stated for, metres, above 0.
    """

    wavelength: float
    draws = 0

    def __post_init__(self) -> None:
        """Check the wavelength."""
        check_positive("wavelength", self.wavelength)

    @abstractmethod
    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V.

        Args:
            x: Metres, shape ``(...)``.
            y: Metres, shape ``(...)``.

        Returns:
            Metres, shape ``(...)``; NaN where nothing is recorded.
        """

    @abstractmethod
    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of V along x and y.

        Args:
            x: Metres, shape ``(...)``.
            y: Metres, shape ``(...)``.

        Returns:
            Without dimension, each of shape ``(...)``; NaN where nothing is recorded.
        """

    def function(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return V, metres; see `Pattern`."""
        del draws
        places = as_float(points)
        return self.value(places[..., 0], places[..., 1])

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return grad V, without dimension; see `Pattern`."""
        del draws
        places = as_float(points)
        along_x, along_y = self.slopes(places[..., 0], places[..., 1])
        found = np.stack((along_x, along_y, np.zeros_like(along_x)), axis=-1)
        # Half a gradient is none: NaN in one component marks the whole point.
        return np.where(np.isfinite(found).all(axis=-1, keepdims=True), found, np.nan)


def check_positive(field: str, value: float) -> None:
    """Raise SpecError unless a number is finite and above 0."""
    if not (math.isfinite(value) and value > 0.0):
        raise SpecError(f"{field}: must be above 0, got {value}")


def check_finite(field: str, values: Iterable[float]) -> None:
    """Raise SpecError unless all numbers are finite."""
    for place, value in enumerate(values):
        if not math.isfinite(value):
            raise SpecError(f"{field}[{place}]: must be finite, got {value}")
