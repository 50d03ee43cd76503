# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Coloured lines, as the graphics card takes them: pieces with a colour at each end."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.arrays import FloatArray, as_float

type Singles = NDArray[np.float32]

_MOST_DASHES = 60
"""Of one piece; a longer one gets longer dashes."""

_DASH_SHARE = 0.55
"""Of a dash and the gap after it."""


@dataclass(frozen=True, eq=False)
class Lines:
    """Straight pieces of lines.

    Attributes:
        ends: Shape ``(n, 2, 3)``, float32.
        colours: Red, green, blue as a screen shows them, and opacity, shape ``(n, 2, 4)``.
    """

    ends: Singles
    colours: Singles

    @classmethod
    def of(cls, ends: ArrayLike, rgb: ArrayLike, opacity: ArrayLike = 1.0) -> "Lines":
        """Make lines.

        Args:
            ends: Shape ``(n, 2, 3)``; pieces that are not finite are left out.
            rgb: Colour of all, or of each, shape ``(3,)`` or ``(n, 3)``.
            opacity: Of all, of both ends, or of each end, broadcastable to ``(n, 2)``.
        """
        places = as_float(ends).reshape(-1, 2, 3)
        colours = np.empty((len(places), 2, 4), dtype=np.float32)
        colours[..., :3] = as_float(rgb).reshape(-1, 1, 3)
        colours[..., 3] = opacity
        finite = np.isfinite(places).all(axis=(1, 2))
        return cls(places[finite].astype(np.float32), colours[finite])

    @classmethod
    def joined(cls, parts: "list[Lines]") -> "Lines":
        """Give several lines as one."""
        if not parts:
            return cls.of(np.zeros((0, 2, 3)), (0.0, 0.0, 0.0))
        ends = np.concatenate([part.ends for part in parts])
        return cls(ends, np.concatenate([part.colours for part in parts]))

    def moved(self, matrix: ArrayLike) -> "Lines":
        """Give the same lines elsewhere.

        Args:
            matrix: From their frame to another, shape ``(4, 4)``.
        """
        turn = as_float(matrix)
        ends = self.ends.astype(np.float64) @ turn[:3, :3].T + turn[:3, 3]
        return Lines(ends.astype(np.float32), self.colours)

    def faint(self, share: float) -> "Lines":
        """Give the same lines with less opacity."""
        colours = self.colours.copy()
        colours[..., 3] *= share
        return Lines(self.ends, colours)

    def dashed(self, length: float) -> "Lines":
        """Cut lines into dashes.

        Args:
            length: Of a dash with the gap behind it.
        """
        ends, colours = self.ends.astype(np.float64), self.colours.astype(np.float64)
        far = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        count = np.clip(np.round(far / length), 1, _MOST_DASHES).astype(np.int64)
        piece = np.repeat(np.arange(len(ends)), count)
        number = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
        share = (number[:, None] + (0.0, _DASH_SHARE)) / count[piece][:, None]
        return Lines(_between(ends[piece], share), _between(colours[piece], share))


def _between(ends: FloatArray, share: FloatArray) -> Singles:
    """Values between two ends, at two places of each."""
    spread = ends[:, 1] - ends[:, 0]
    return (ends[:, :1] + share[..., None] * spread[:, None]).astype(np.float32)


def path(points: ArrayLike, *, closed: bool = False) -> FloatArray:
    """Join points one after the other.

    Args:
        points: Shape ``(n, 3)``.
        closed: Whether the last is joined to the first.

    Returns:
        Pieces, shape ``(n - 1, 2, 3)``, or ``(n, 2, 3)`` of a closed line.
    """
    places = as_float(points)
    pieces = np.stack((places, np.roll(places, -1, axis=0)), axis=1)
    return pieces if closed else pieces[:-1]


def between(starts: ArrayLike, ends: ArrayLike) -> FloatArray:
    """Join points with others, one by one.

    Args:
        starts: Broadcastable to ``(n, 3)``.
        ends: Broadcastable to ``(n, 3)``.

    Returns:
        Pieces, shape ``(n, 2, 3)``.
    """
    first, second = np.broadcast_arrays(as_float(starts), as_float(ends))
    return np.stack((first, second), axis=-2).reshape(-1, 2, 3)


def across(direction: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Find two directions at right angles to others and to each other.

    Args:
        direction: Unit vectors, shape ``(..., 3)``.

    Returns:
        Unit vectors, each of the same shape.
    """
    along = as_float(direction)
    helper = np.where(np.abs(along[..., :1]) > 0.9, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    first = np.cross(along, helper)
    first /= np.linalg.norm(first, axis=-1, keepdims=True)
    return first, np.cross(along, first)


def circle(middle: ArrayLike, normal: ArrayLike, radius: float, sides: int = 48) -> FloatArray:
    """Draw a circle.

    Args:
        middle: Its middle, shape ``(3,)``.
        normal: Unit vector, shape ``(3,)``.
        radius: Its radius.
        sides: Number of pieces.

    Returns:
        Pieces, shape ``(sides, 2, 3)``.
    """
    first, second = across(normal)
    angle = np.arange(sides)[:, None] * (2.0 * np.pi / sides)
    rim = as_float(middle) + radius * (np.cos(angle) * first + np.sin(angle) * second)
    return path(rim, closed=True)


def star(middle: ArrayLike, size: float) -> FloatArray:
    """Mark a point by seven strokes through it.

    Args:
        middle: The point, shape ``(3,)``.
        size: Length of a stroke.

    Returns:
        Pieces, shape ``(7, 2, 3)``.
    """
    diagonal = 3.0**-0.5
    strokes = np.array(
        [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
        + [(diagonal, a * diagonal, b * diagonal) for a in (-1, 1) for b in (-1, 1)]
    )
    return between(as_float(middle) - size / 2 * strokes, as_float(middle) + size / 2 * strokes)


def arrow_heads(tips: ArrayLike, direction: ArrayLike, size: float) -> FloatArray:
    """Draw heads of arrows.

    Args:
        tips: Where they point to, shape ``(n, 3)``.
        direction: Unit vectors along the arrows, broadcastable to ``(n, 3)``.
        size: Length of a stroke.

    Returns:
        Pieces, shape ``(2 n, 2, 3)``.
    """
    places, along = np.broadcast_arrays(as_float(tips), as_float(direction))
    side, _ = across(along)
    return np.concatenate(
        [between(places, places + size * (0.35 * sign * side - along)) for sign in (-1.0, 1.0)]
    )
