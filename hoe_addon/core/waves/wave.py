# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every recording wave can tell."""

import math
from collections.abc import Sequence
from typing import Protocol

from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..errors import SpecError


class Wave(Protocol):
    """A recording wave in the frame of the hologram."""

    @property
    def index(self) -> float:
        """Refractive index of the medium that the wave arrives in, at least 1."""
        ...

    @property
    def draws(self) -> int:
        """Uniform numbers that an evaluation takes per point; 0 unless the source is extended."""
        ...

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return the optical path length up to a constant.

        Args:
            points: Points in metres, shape ``(..., 3)``.
            draws: Uniform numbers in [0, 1), shape ``(..., self.draws)``; None for one half each.

        Returns:
            Metres, shape ``(...)``. NaN where the wave does not arrive.
        """
        ...

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``n s``: the index times the unit direction of propagation.

        Args:
            points: Points in metres, shape ``(..., 3)``.
            draws: Uniform numbers in [0, 1), shape ``(..., self.draws)``; None for one half each.

        Returns:
            Without dimension, shape ``(..., 3)``. NaN where the wave does not arrive or has no
            direction, such as at the point of a spherical wave.
        """
        ...


def check_vector(field: str, values: Sequence[float]) -> tuple[float, float, float]:
    """Return three finite floats, or raise SpecError that names the field."""
    numbers = tuple(float(value) for value in values)
    if len(numbers) != 3 or not all(math.isfinite(number) for number in numbers):
        raise SpecError(f"{field}: must be three finite numbers, got {list(numbers)}")
    return (numbers[0], numbers[1], numbers[2])


def check_direction(field: str, values: Sequence[float]) -> tuple[float, float, float]:
    """Return three finite floats that are not all zero, or raise SpecError."""
    direction = check_vector(field, values)
    if not any(direction):
        raise SpecError(f"{field}: must not have zero length, got {list(direction)}")
    return direction


def check_index(index: float, field: str = "index") -> None:
    """Raise SpecError unless the refractive index is finite and at least 1."""
    if not (math.isfinite(index) and index >= 1.0):
        raise SpecError(f"{field}: must be at least 1, got {index}")
