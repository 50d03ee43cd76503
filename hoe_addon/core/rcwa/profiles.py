# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reliefs cut into layers: polygons of any shape, overhanging walls included.

A polygon lies in the plane of x, in periods, and z, in metres, and is repeated along x. It may be
wider than a period, and several may lie in one relief: a later one is painted over the earlier.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray
from ..errors import SpecError
from .crossing import check_simple
from .stack import Lamellar, Layer, Pattern, Uniform

_SAME = 1e-12
"""Walls (periods) and heights (of the whole) closer than this are one."""


@dataclass(frozen=True, eq=False)
class Polygon:
    """A closed outline filled with one material.

    Attributes:
        points: Corners, x in periods and z in metres, shape ``(V, 2)``; the last is joined to the
            first.
        material: Place of the material in the list.
    """

    points: FloatArray
    material: int

    def __post_init__(self) -> None:
        """Check the shape of the array."""
        if self.points.ndim != 2 or self.points.shape[1] != 2 or len(self.points) < 3:
            raise SpecError(f"points: must be 3 or more pairs x, z, got {self.points.shape}")
        if not np.all(np.isfinite(self.points)):
            raise SpecError("points: must be finite")

    @property
    def heights(self) -> FloatArray:
        """Heights z of the corners, shape ``(V,)``."""
        return self.points[:, 1]

    def intervals(self, height: float) -> FloatArray:
        """Stretches of x inside the outline.

        Args:
            height: z, metres; not that of a corner.

        Returns:
            Begin and end of each stretch, in periods, not wrapped, shape ``(J, 2)``.
        """
        begin, end = self.points, np.roll(self.points, -1, axis=0)
        cut = (begin[:, 1] < height) != (end[:, 1] < height)
        low, high = begin[cut], end[cut]
        share = (height - low[:, 1]) / (high[:, 1] - low[:, 1])
        places = np.sort(low[:, 0] + share * (high[:, 0] - low[:, 0]))
        return places.reshape(-1, 2)


def polygon_layers(
    polygons: Sequence[Polygon], around: int, slices: int, *, checked: bool = False
) -> tuple[Layer, ...]:
    """Cut polygons into layers.

    Between two heights at which something begins, ends or turns, walls that all stand upright give
    one layer; others are cut at equal distances, each layer taken at its middle height.

    Args:
        polygons: The outlines; a later one is painted over the earlier.
        around: Material where no polygon is.
        slices: About how many layers a relief of slanted walls is cut into, at least 1.
        checked: Whether it is known that no outline crosses itself.

    Returns:
        Layers from the lowest corner to the highest.

    Raises:
        SpecError: If an outline crosses itself or its own repetition; both edges are named.
    """
    if slices < 1:
        raise SpecError(f"slices: must be at least 1, got {slices}")
    if not polygons:
        return ()
    if not checked:
        for polygon in polygons:
            check_simple(polygon.points)
    levels = _levels(polygons, slices)
    layers: list[Layer] = []
    for low, high in pairwise(levels):
        share = (high - low) / (levels[-1] - levels[0])
        count = 1 if _upright(polygons, low, high) else max(1, round(slices * share))
        thickness = float(high - low) / count
        for index in range(count):
            middle = float(low) + (index + 0.5) * thickness
            pattern, shift = _pattern(polygons, around, middle)
            if layers and _alike(layers[-1].pattern, pattern):
                pattern = layers[-1].pattern
            layers.append(Layer(pattern, thickness, shift))
    return tuple(layers)


def _levels(polygons: Sequence[Polygon], slices: int) -> FloatArray:
    """Heights at which layers must begin, ascending.

    All corners where they are few; of an outline of many short edges the flat ones only.
    """
    corners = np.concatenate([polygon.heights for polygon in polygons])
    lowest, highest = float(corners.min()), float(corners.max())
    if highest == lowest:
        raise SpecError("points: the relief must have a height above 0")
    if len(np.unique(corners)) > slices + 1:
        flat = [p.heights[p.heights == np.roll(p.heights, -1)] for p in polygons]
        corners = np.concatenate([*flat, [lowest, highest]])
    levels = np.unique(corners)
    kept = np.diff(levels, prepend=-np.inf) > _SAME * (highest - lowest)
    return levels[kept]


def _upright(polygons: Sequence[Polygon], low: float, high: float) -> bool:
    for polygon in polygons:
        begin, end = polygon.points, np.roll(polygon.points, -1, axis=0)
        bottom = np.minimum(begin[:, 1], end[:, 1])
        top = np.maximum(begin[:, 1], end[:, 1])
        inside = (bottom < 0.5 * (low + high)) & (top > 0.5 * (low + high))
        if np.any(inside & (np.abs(begin[:, 0] - end[:, 0]) > _SAME)):
            return False
    return True


def _pattern(polygons: Sequence[Polygon], around: int, height: float) -> tuple[Pattern, float]:
    """Return the pattern at a height about its own middle, and where that middle is."""
    stretches = [(p.intervals(height), p.material) for p in polygons]
    walls = np.concatenate([np.zeros(0), *(s.ravel() for s, _ in stretches)])
    walls = np.unique(walls - np.floor(walls))
    walls = walls[np.diff(walls, prepend=-1.0) > _SAME]
    if len(walls) > 1 and walls[0] + 1.0 - walls[-1] <= _SAME:
        walls = walls[:-1]
    if len(walls) == 0:
        walls = np.zeros(1)
    middles = walls + 0.5 * np.diff(walls, append=walls[0] + 1.0)
    materials = [around] * len(walls)
    for spans, material in stretches:
        for begin, end in spans:
            covered = np.floor(end - middles) > np.floor(begin - middles)
            materials = [material if c else m for c, m in zip(covered, materials, strict=True)]
    kept = [k for k in range(len(walls)) if materials[k] != materials[k - 1]]
    if not kept:
        return Uniform(materials[0]), 0.0
    return _centred(walls[kept], tuple(materials[k] for k in kept))


def _centred(walls: FloatArray, materials: tuple[int, ...]) -> tuple[Pattern, float]:
    """Move a pattern to its middle, so that copies look alike and even patterns are even."""
    count = len(walls)
    widths = np.diff(walls, append=walls[0] + 1.0)

    def rank(first: int) -> tuple[bool, int, float]:
        turn = [(first + k) % count for k in range(count)]
        back = [(first - k) % count for k in range(count)]
        even = all(
            materials[a] == materials[b] and abs(widths[a] - widths[b]) <= _SAME
            for a, b in zip(turn, back, strict=True)
        )
        return (not even, materials[first], round(-float(widths[first]), 9))

    first = min(range(count), key=rank)
    turn = [(first + k) % count for k in range(count)]
    ordered = widths[turn]
    begins = -0.5 * ordered[0] + np.concatenate(([0.0], np.cumsum(ordered[:-1])))
    pattern = Lamellar(begins, tuple(materials[k] for k in turn))
    return pattern, float(walls[first] + 0.5 * widths[first])


def _alike(first: Pattern, second: Pattern) -> bool:
    if isinstance(first, Uniform) and isinstance(second, Uniform):
        return first.material == second.material
    if isinstance(first, Lamellar) and isinstance(second, Lamellar):
        return first.materials == second.materials and bool(
            np.all(np.abs(first.walls - second.walls) <= _SAME)
        )
    return False
