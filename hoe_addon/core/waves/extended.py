# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave of an extended source, drawn point by point."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, unit
from .source_shapes import SourceShape
from .wave import check_index


@dataclass(frozen=True)
class ExtendedSource:
    """A source with a length or an area: every ray meets the spherical wave of one point of it.

    The point is drawn uniformly by length or area, anew for each ray. What the hologram images is
    then blurred by the source's shape, as with light whose points do not interfere.

    Attributes:
        shape: Where its points lie.
        converging: True when the waves travel toward their points.
        index: Refractive index of the medium that the wave arrives in, at least 1.
    """

    shape: SourceShape
    converging: bool = False
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check the fields."""
        check_index(self.index)

    @property
    def draws(self) -> int:
        """Uniform numbers per point, those of the shape."""
        return self.shape.draws

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the distance from the drawn point; see `Wave`."""
        distance = np.linalg.norm(self._away(points, draws), axis=-1)
        return (-self.index if self.converging else self.index) * distance

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the direction from the drawn point; see `Wave`."""
        away = unit(self._away(points, draws))
        return (-self.index if self.converging else self.index) * away

    def _away(self, points: ArrayLike, draws: ArrayLike | None) -> FloatArray:
        numbers = np.full(self.draws, 0.5) if draws is None else as_float(draws)
        return as_float(points) - self.shape.place(numbers)
