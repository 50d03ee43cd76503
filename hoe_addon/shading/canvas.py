# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Anti-aliased drawing in numpy: shapes gather in a mask, which is then painted in one colour."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from . import stroke_font

type Colour = tuple[float, float, float]
type Place = tuple[float, ...]

type _Floats = NDArray[np.float64]

_EDGE_PIXELS = 1.0
"""Half width of a round shape's soft edge; at one pixel the grid no longer moves centroids."""


class Canvas:
    """A black picture with an origin in its middle, +x right and +y up.

    Attributes:
        pixels: Linear colours, shape ``(height, width, 3)``, top row first.
    """

    def __init__(self, width: int, height: int, size: tuple[float, float]) -> None:
        """Make it black.

        Args:
            width: Pixels across.
            height: Pixels from top to bottom.
            size: Width and height in the units of all places.
        """
        self.pixels = np.zeros((height, width, 3))
        self._mask = np.zeros((height, width))
        self._step = (size[0] / width, size[1] / height)
        self._x: _Floats = (np.arange(width, dtype=float) - (width - 1) / 2.0) * self._step[0]
        self._y: _Floats = ((height - 1) / 2.0 - np.arange(height, dtype=float)) * self._step[1]
        self._touched: list[tuple[int, int, int, int]] = []

    def paint(self, colour: Colour) -> None:
        """Lay a colour over all that was drawn since the last time."""
        if not self._touched:
            return
        top, bottom, left, right = np.asarray(self._touched).T
        part = np.s_[top.min() : bottom.max(), left.min() : right.max()]
        cover = np.minimum(self._mask[part], 1.0)[..., None]
        self.pixels[part] += cover * (np.asarray(colour) - self.pixels[part])
        self._mask[part] = 0.0
        self._touched.clear()

    def rectangle(self, low: Place, high: Place) -> None:
        """Draw a rectangle between two corners; each pixel gets its exact share."""
        part = self._touch(low, high, 0.5 * max(self._step))
        upward = _share(self._y[part[0]], self._step[1], low[1], high[1])
        across = _share(self._x[part[1]], self._step[0], low[0], high[0])
        self._mask[part] += upward[:, None] * across

    def disk(self, centre: Place, radius: float) -> None:
        """Draw a disk with a soft edge."""
        self._round(centre, centre, radius, lambda distance: distance - radius)

    def ring(self, centre: Place, radius: float, half_width: float) -> None:
        """Draw a circle of this radius as a line."""
        reach = radius + half_width
        self._round(centre, centre, reach, lambda distance: abs(distance - radius) - half_width)

    def stroke(self, start: Place, end: Place, radius: float) -> None:
        """Draw a line with round ends."""
        self._round(start, end, radius, lambda distance: distance - radius)

    def _round(
        self, start: Place, end: Place, reach: float, outside: Callable[[_Floats], _Floats]
    ) -> None:
        """Draw what lies at some distances from a line; only pixels near it are touched.

        Overlapping shapes of one colour do not add up, so that strokes join evenly.
        """
        edge = _EDGE_PIXELS * float(np.sqrt(self._step[0] * self._step[1]))
        margin = reach + edge
        part = self._touch(start, end, margin)
        x, y = self._x[part[1]] - start[0], (self._y[part[0]] - start[1])[:, None]
        dx, dy = end[0] - start[0], end[1] - start[1]
        along = (x * dx + y * dy) / max(dx * dx + dy * dy, 1e-30)
        along = np.clip(along, 0.0, 1.0)
        distance = np.hypot(x - along * dx, y - along * dy)
        inside = np.clip(0.5 - 0.5 * outside(distance) / edge, 0.0, 1.0)
        cover = inside * inside * (3.0 - 2.0 * inside)
        self._mask[part] = np.maximum(self._mask[part], cover)

    def _touch(self, first: Place, second: Place, margin: float) -> tuple[slice, slice]:
        """Rows and columns within a margin around the box of two places, noted for painting."""
        left, right = _span(self._x, first[0], second[0], margin)
        # Rows run downward, so their places are negated to increase.
        top, bottom = _span(-self._y, -first[1], -second[1], margin)
        if top < bottom and left < right:
            self._touched.append((top, bottom, left, right))
        return np.s_[top:bottom, left:right]


def text(canvas: Canvas, words: str, centre: Place, height: float, colour: Colour) -> None:
    """Write a line in the stroke font around a point, in one colour.

    Args:
        canvas: What is written on; all that was drawn before is painted too.
        words: Letters that the font has.
        centre: Middle of the line.
        height: Height of a capital letter.
        colour: Linear colour.
    """
    step = height / stroke_font.GRID_HEIGHT
    x = centre[0] - step * stroke_font.width(words) / 2.0
    y = centre[1] - height / 2.0
    for (x0, y0), (x1, y1) in stroke_font.strokes(words):
        canvas.stroke((x + step * x0, y + step * y0), (x + step * x1, y + step * y1), 0.48 * step)
    canvas.paint(colour)


def _share(centres: _Floats, step: float, low: float, high: float) -> _Floats:
    """Share of each pixel that lies between two places, along one axis."""
    covered = np.minimum(centres + step / 2.0, high) - np.maximum(centres - step / 2.0, low)
    return np.clip(covered / step, 0.0, 1.0)


def _span(places: _Floats, first: float, second: float, margin: float) -> tuple[int, int]:
    """First pixel within a margin around two places, and the one after the last."""
    low, high = min(first, second) - margin, max(first, second) + margin
    return int(np.searchsorted(places, low)), int(np.searchsorted(places, high, side="right"))
