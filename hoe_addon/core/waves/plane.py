# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane wave."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, dot, unit
from .wave import check_direction, check_index


@dataclass(frozen=True)
class PlaneWave:
    """A plane recording wave: a source at infinity, real and virtual alike.

    Attributes:
        direction: Direction of propagation, any length but zero.
        index: Refractive index of the medium that the wave arrives in, at least 1.
    """

    direction: tuple[float, float, float]
    index: float = 1.0
    draws = 0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "direction", check_direction("direction", self.direction))
        check_index(self.index)

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``n s . P``; see `Wave`."""
        del draws
        return self.index * dot(as_float(points), unit(self.direction))

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return the same ``n s`` everywhere; see `Wave`."""
        del draws
        return np.broadcast_to(self.index * unit(self.direction), as_float(points).shape)
