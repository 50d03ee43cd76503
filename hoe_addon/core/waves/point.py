# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spherical wave of a point."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, unit
from .wave import check_index, check_vector


@dataclass(frozen=True)
class PointSource:
    """A spherical recording wave, diverging from or converging toward a point.

    A diverging wave comes from its point: a real source, on the side that the wave comes from. A
    converging wave runs toward its point, which it reaches only beyond the hologram: a virtual
    source. Only the beam tells the two apart; the point may lie on either side of the surface,
    and with it the wave arrives from the one side or the other.

    Attributes:
        position: The point, metres.
        converging: True when the wave travels toward the point.
        index: Refractive index of the medium that the wave arrives in, at least 1.
    """

    position: tuple[float, float, float]
    converging: bool = False
    index: float = 1.0
    draws = 0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "position", check_vector("position", self.position))
        check_index(self.index)

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the distance from the point, negative while converging; see `Wave`."""
        del draws
        distance = np.linalg.norm(as_float(points) - as_float(self.position), axis=-1)
        return (-self.index if self.converging else self.index) * distance

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the direction; NaN at the point itself; see `Wave`."""
        del draws
        away = unit(as_float(points) - as_float(self.position))
        return (-self.index if self.converging else self.index) * away
