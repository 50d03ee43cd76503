# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every shape of a surface can tell."""

import math
from typing import Protocol

from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..errors import SpecError


class Shape(Protocol):
    """A surface in its own frame: vertex at the origin, normal +z there, lengths in metres.

    A radius above 0 has its centre of curvature at +z. The part of the surface that counts is
    the sheet of the vertex: the half of a sphere around it, one of the two bowls of a
    hyperboloid. Everything works in any unit of length, the same for all arguments.
    """

    def intersect(self, origin: ArrayLike, direction: ArrayLike) -> FloatArray:
        """Return how far along each ray the surface is first met.

        Args:
            origin: Start points, shape ``(..., 3)``.
            direction: Directions of travel, unit vectors, broadcastable to ``(..., 3)``.

        Returns:
            Distances, 0 or more, shape ``(...)``; NaN for a ray that meets nothing, that is
            parallel to a plane, or whose start is beyond. A start on the surface counts as met
            where rounding leaves it there, as it does on a plane.
        """
        ...

    def normal(self, points: ArrayLike) -> FloatArray:
        """Return the unit normal on the side of +z.

        Args:
            points: Points on the surface, shape ``(..., 3)``.

        Returns:
            Unit vectors, shape ``(..., 3)``; NaN where the surface is not defined.
        """
        ...

    def sag(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the height z of the surface.

        Args:
            x: First coordinate, shape ``(...)``.
            y: Second coordinate, broadcastable to ``(...)``.

        Returns:
            Heights, shape ``(...)``; NaN outside the domain of the surface.
        """
        ...


def check_radius(radius: float) -> None:
    """Raise SpecError unless the radius is a number other than 0; it may be infinite."""
    if math.isnan(radius) or radius == 0.0:
        raise SpecError(f"radius: must be a number other than 0, got {radius}")


def check_conic(conic: float) -> None:
    """Raise SpecError unless the conic constant is finite."""
    if not math.isfinite(conic):
        raise SpecError(f"conic: must be a finite number, got {conic}")
