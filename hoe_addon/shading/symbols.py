# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of symbols: bars and letters in black and white, an aiming mark, a speedometer."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from .canvas import Canvas, Colour, text

_WHITE: Colour = (1.0, 1.0, 1.0)
_RED: Colour = (1.0, 0.0, 0.0)
_GREEN: Colour = (0.0, 1.0, 0.0)
_BAR_WIDTHS = (6.0, 4.0, 3.0, 2.0)
_LINES = ("SHARP", "EDGES HAVE", "NO COLOUR")


def _canvas(width: int, height: int) -> tuple[Canvas, float]:
    """A canvas 100 wide, and its height in the same units."""
    tall = 100.0 * height / width
    return Canvas(width, height, (100.0, tall)), tall


def _bars(width: int, height: int) -> NDArray[np.float64]:
    """White on black: upright bars that get finer to the right, and text below."""
    canvas, tall = _canvas(width, height)
    x = -46.0
    for bar in _BAR_WIDTHS:
        for _ in range(3):
            canvas.rectangle((x, 0.08 * tall), (x + bar, 0.44 * tall))
            x += 1.8 * bar
        x += bar
    canvas.paint(_WHITE)
    for number, line in enumerate(_LINES):
        size = (0.13, 0.09, 0.06)[number] * tall
        text(canvas, line, (0.0, (-0.06 - 0.15 * number) * tall), size, _WHITE)
    return canvas.pixels


def _reticle(width: int, height: int) -> NDArray[np.float64]:
    """A red ring with a dot in the middle and four ticks; it fills the picture.

    On a picture that is higher than wide it is an oval: a sight's hologram may compress it again.
    """
    canvas = Canvas(width, height, (100.0, 100.0))
    radius = 38.0
    canvas.ring((0.0, 0.0), radius, 0.035 * radius)
    canvas.disk((0.0, 0.0), 0.05 * radius)
    for sign in (-1.0, 1.0):
        near, far = sorted((sign * 1.0 * radius, sign * 1.25 * radius))
        canvas.rectangle((near, -0.035 * radius), (far, 0.035 * radius))
        canvas.rectangle((-0.035 * radius, near), (0.035 * radius, far))
    canvas.paint(_RED)
    return canvas.pixels


def _speed(width: int, height: int) -> NDArray[np.float64]:
    """A green speed, and an arrow to the right."""
    canvas, tall = _canvas(width, height)
    text(canvas, "80", (-22.0, 0.06 * tall), 0.50 * tall, _GREEN)
    text(canvas, "KM/H", (-22.0, -0.36 * tall), 0.13 * tall, _GREEN)
    thick = 0.05 * tall
    canvas.stroke((18.0, -0.34 * tall), (18.0, 0.18 * tall), thick)
    canvas.stroke((18.0, 0.18 * tall), (40.0, 0.18 * tall), thick)
    for end in (0.36, 0.0):
        canvas.stroke((32.0, end * tall), (40.0, 0.18 * tall), thick)
    canvas.paint(_GREEN)
    return canvas.pixels


PICTURES: Mapping[str, Callable[[int, int], NDArray[np.float64]]] = MappingProxyType(
    {"bars": _bars, "reticle": _reticle, "speed": _speed}
)
"""How each is drawn, from width and height in pixels."""
