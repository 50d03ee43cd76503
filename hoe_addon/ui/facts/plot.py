# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot of efficiencies, as pixels: above against wavelength, below against angle.

It has a dark ground of its own in every theme, as Blender's scopes have.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import FloatArray
from ...shading.canvas import Canvas, text
from .curves import ANGLES_DEG, WAVELENGTHS_NM, Curves, Way

SIZE = 480
"""Pixels along each side; twice the width of a narrow sidebar, so that it is sharp at 2x."""

type Pixels = NDArray[np.float32]
type Colour = tuple[float, float, float]

_GROUND: Colour = (0.11, 0.11, 0.11)
_FIELD: Colour = (0.15, 0.15, 0.15)
_GRID: Colour = (0.26, 0.26, 0.26)
_WORDS: Colour = (0.80, 0.80, 0.80)
_MARK: Colour = (0.50, 0.50, 0.50)
_COLOURS: dict[int, Colour] = {
    0: (0.85, 0.85, 0.85),
    1: (0.30, 0.78, 0.45),
    -1: (0.98, 0.62, 0.22),
    2: (0.33, 0.65, 0.98),
    -2: (0.93, 0.42, 0.66),
    3: (0.70, 0.55, 0.98),
    -3: (0.92, 0.86, 0.30),
}
_OTHER: Colour = (0.45, 0.80, 0.85)

_LETTER = 14.0
_REACH = 1.9
"""Half the width of a curve with its soft edge."""
_DASH, _GAP = 14, 8
_KEY_HEIGHT = 42
_KEY_STEP = 76.0


@dataclass(frozen=True)
class _Axes:
    """A field of the plot, in pixels from the lower left corner.

    Attributes:
        left, right, low, high: Its edges.
        first, last: Abscissae at its left and right edge.
        ticks: Abscissae that are named.
        unit: Behind the last name.
    """

    left: float
    right: float
    low: float
    high: float
    first: float
    last: float
    ticks: tuple[float, ...]
    unit: str

    def x(self, value: float) -> float:
        """Place of an abscissa."""
        return self.left + (value - self.first) / (self.last - self.first) * (
            self.right - self.left
        )


_BY_WAVELENGTH = _Axes(52, 468, 268, 438, 380.0, 780.0, (400.0, 500.0, 600.0, 700.0), "nm")
_BY_ANGLE = _Axes(52, 468, 36, 206, -90.0, 90.0, (-60.0, -30.0, 0.0, 30.0, 60.0), "\N{DEGREE SIGN}")


def plot_pixels(curves: Curves) -> Pixels:
    """Draw the plot.

    Args:
        curves: What is shown.

    Returns:
        Colours as a screen shows them, lowest row first, shape ``(SIZE, SIZE, 4)``.
    """
    pixels = _frame().copy()
    pixels[SIZE - _KEY_HEIGHT :, :, :3] = _key(curves.ways)
    for axes, at, shares, mark in (
        (_BY_WAVELENGTH, WAVELENGTHS_NM, curves.by_wavelength, curves.recorded_nm),
        (_BY_ANGLE, ANGLES_DEG, curves.by_angle, curves.light.theta_deg),
    ):
        _mark(pixels, axes, mark)
        for place in reversed(range(len(curves.ways))):
            _curve(pixels, axes, at, shares[:, place], curves.ways[place])
    return pixels


def colour_of(order: int) -> Colour:
    """Colour of an order, as a screen shows it."""
    return _COLOURS.get(order, _OTHER)


@lru_cache(maxsize=1)
def _frame() -> Pixels:
    """What is the same in every plot; not to be written to."""
    canvas = Canvas(SIZE, SIZE, (SIZE, SIZE))
    canvas.pixels[:] = _GROUND
    for axes in (_BY_WAVELENGTH, _BY_ANGLE):
        canvas.rectangle(_at(axes.left, axes.low), _at(axes.right, axes.high))
        canvas.paint(_FIELD)
        for tick in axes.ticks:
            x = axes.x(tick)
            canvas.rectangle(_at(x - 0.5, axes.low), _at(x + 0.5, axes.high))
        for share in (0.0, 0.5, 1.0):
            y = _y(axes, share)
            canvas.rectangle(_at(axes.left, y - 0.5), _at(axes.right, y + 0.5))
        canvas.paint(_GRID)
        for tick in axes.ticks:
            words = f"{tick:g}{axes.unit if tick == axes.ticks[-1] else ''}"
            text(canvas, words, _at(axes.x(tick), axes.low - 17.0), _LETTER, _WORDS)
        for share, words in ((0.0, "0"), (0.5, "50"), (1.0, "100%")):
            x = axes.left - 6.0 - 0.4 * _width(words)
            text(canvas, words, _at(x, _y(axes, share)), 0.8 * _LETTER, _WORDS)
    pixels = np.ones((SIZE, SIZE, 4), dtype=np.float32)
    pixels[..., :3] = canvas.pixels[::-1]
    return pixels


@lru_cache(maxsize=32)
def _key(ways: tuple[Way, ...]) -> FloatArray:
    """Names of the curves, lowest row first; not to be written to."""
    canvas = Canvas(SIZE, _KEY_HEIGHT, (SIZE, _KEY_HEIGHT))
    canvas.pixels[:] = _GROUND
    for place, (order, reflected) in enumerate(ways):
        x = 14.0 + place * _KEY_STEP - 0.5 * SIZE
        for start, end in ((0.0, 9.0), (14.0, 22.0)) if reflected else ((0.0, 22.0),):
            canvas.stroke((x + start, 0.0), (x + end, 0.0), 2.0)
        canvas.paint(colour_of(order))
        words = (f"{order:+d}" if order else "0") + ("R" if reflected else "")
        text(canvas, words, (x + 29.0 + 0.5 * _width(words), 0.0), _LETTER, _WORDS)
    return canvas.pixels[::-1]


def _mark(pixels: Pixels, axes: _Axes, value: float) -> None:
    """A line at the light that the other field is drawn for."""
    if axes.first <= value <= axes.last:
        column = min(int(axes.x(value)), int(axes.right) - 1)
        rows = np.arange(int(axes.low), int(axes.high))
        pixels[rows[rows % 9 < 5], column, :3] = _MARK


def _curve(pixels: Pixels, axes: _Axes, at: FloatArray, shares: FloatArray, way: Way) -> None:
    """Lay a curve over the picture: each column has the stretch to its neighbours."""
    columns = np.arange(int(axes.left), int(axes.right))
    step = (axes.last - axes.first) / (axes.right - axes.left)
    wanted = axes.first + (columns + 0.5 - axes.left) * step
    height = _y(axes, 0.0) + np.interp(wanted, at, shares) * (_y(axes, 1.0) - _y(axes, 0.0))
    framed = np.concatenate((height[:1], height, height[-1:]))
    ends = np.stack((framed[:-2], height, framed[2:]))
    shown = np.isfinite(ends).all(axis=0)
    if way[1]:
        shown &= columns % (_DASH + _GAP) < _DASH
    columns, low, high = columns[shown], ends.min(axis=0)[shown], ends.max(axis=0)[shown]
    # Only pixels near the curve are looked at.
    first = np.floor(low - _REACH).astype(np.int64)
    counts = np.ceil(high + _REACH).astype(np.int64) - first
    of_column = np.repeat(np.arange(len(columns)), counts)
    rows = np.arange(len(of_column)) - np.repeat(np.cumsum(counts) - counts, counts)
    rows += first[of_column]
    outside = np.maximum(low[of_column] - rows - 0.5, rows + 0.5 - high[of_column])
    cover = np.clip(_REACH - np.maximum(outside, 0.0), 0.0, 1.0)[:, None]
    place = (rows, columns[of_column], slice(0, 3))
    pixels[place] += cover * (np.asarray(colour_of(way[0])) - pixels[place])


def _y(axes: _Axes, share: float) -> float:
    """Place of a share; the edges have room for the width of a curve."""
    return axes.low + 6.0 + share * (axes.high - axes.low - 12.0)


def _width(words: str) -> float:
    return _LETTER * len(words)


def _at(x: float, y: float) -> tuple[float, float]:
    """Place on a canvas, whose origin is in its middle."""
    return (x - 0.5 * SIZE, y - 0.5 * SIZE)
