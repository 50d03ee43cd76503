# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The astigmatic wave of two line foci."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, dot, unit
from ..errors import SpecError
from .wave import check_direction, check_index, check_vector

_PARALLEL = 1e-9


@dataclass(frozen=True)
class AstigmaticSource:
    """A toric wave: all its rays cross a straight line and a circular arc around that line.

    No wave has two straight focal lines: where both caustic sheets of a wave shrink to curves,
    these are two conics, each through the foci of the other, and the wave fronts are Dupin
    cyclides. The toric wave is the member of that family with one straight line (the axis) and
    one circle about it. In the lowest order around the chief ray, the line through both foci, it
    is the textbook beam with two line foci at right angles.

    Each ray lies in a plane through the axis. The wave front is at equal distances from the
    circle, so the eikonal is that distance. A focus may lie before or behind the hologram.

    Attributes:
        first: Where the chief ray crosses the straight focal line, metres.
        second: Where it crosses the focal arc, metres.
        line_direction: Direction of the straight line; its part at a right angle to the chief
            ray counts. The arc is at a right angle to both there.
        converging: False when the wave runs away from the arc, true when it runs toward it. On
            which side of the hologram the straight line lies follows from the two places.
        index: Refractive index of the medium that the wave arrives in, at least 1.

    References:
        Maxwell (1868), "On the cyclide", Quart. J. Pure Appl. Math. 9, 111-126.
    """

    first: tuple[float, float, float]
    second: tuple[float, float, float]
    line_direction: tuple[float, float, float]
    converging: bool = False
    index: float = 1.0
    draws = 0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "first", check_vector("first", self.first))
        object.__setattr__(self, "second", check_vector("second", self.second))
        line = check_direction("line_direction", self.line_direction)
        object.__setattr__(self, "line_direction", line)
        check_index(self.index)
        if self.first == self.second:
            raise SpecError(f"second: must not be the same place as first, got {list(self.second)}")
        chief = unit(as_float(self.second) - as_float(self.first))
        if float(np.linalg.norm(np.cross(chief, unit(line)))) < _PARALLEL:
            raise SpecError(
                f"line_direction: must not run along the chief ray, got {list(self.line_direction)}"
            )

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the distance from the arc's circle; see `Wave`."""
        del draws
        distance = np.linalg.norm(self._from_arc(points), axis=-1)
        return (-self.index if self.converging else self.index) * distance

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``n s``; NaN on the straight line and on the circle; see `Wave`."""
        del draws
        away = unit(self._from_arc(points))
        return (-self.index if self.converging else self.index) * away

    def _from_arc(self, points: ArrayLike) -> FloatArray:
        """Return the vectors from the arc to the points, along the rays.

        With far foci the radius and the distance from the axis are nearly equal large numbers;
        their difference is taken from the distances to the two foci instead.
        """
        first, second = as_float(self.first), as_float(self.second)
        radius = float(np.linalg.norm(second - first))
        chief, line, across = self._axes()
        from_first, from_second = as_float(points) - first, as_float(points) - second
        outward, beyond = dot(from_first, chief), dot(from_second, chief)
        nearer = np.where((np.abs(outward) < np.abs(beyond))[..., None], from_first, from_second)
        side, height = dot(nearer, across), dot(nearer, line)
        # Negative beyond the axis, as seen from the second focus.
        distance = np.copysign(np.hypot(outward, side), outward)
        with np.errstate(invalid="ignore", divide="ignore"):
            close = (beyond * (radius + outward) + side**2) / (distance + radius)
            excess = np.where(outward > 0.0, close, distance - radius)[..., None]
            radial = (outward[..., None] * chief + side[..., None] * across) / distance[..., None]
        return height[..., None] * line + excess * radial

    def _axes(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return unit vectors along the chief ray, the straight line, and across both."""
        chief = unit(as_float(self.second) - as_float(self.first))
        line = unit(self.line_direction)
        line = unit(line - dot(line, chief) * chief)
        return chief, line, np.cross(line, chief)
