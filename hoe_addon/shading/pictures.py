# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures that need no file: test chart, white field, grid of dots, and those of symbols."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..core.errors import SpecError
from ..model.device_parts import BUILT_IN_IMAGES
from ..model.field_error import FieldError
from ..model.image_file import check_readable
from . import stroke_font, symbols
from .canvas import Canvas, Colour, text

FIELD_DEG = (19.0, 10.7)
"""Field that the chart is labelled for, unless another is given."""

_DOT_COLUMNS, _DOT_ROWS = 9, 5
_DOT_REACH = 0.45
_DOT_RADIUS = 0.004
_LEAST_DOT_PIXELS = 2.0

_WHITE: Colour = (1.0, 1.0, 1.0)
_ACCENT: Colour = (0.10, 0.75, 0.85)
_QUIET: Colour = (0.45, 0.45, 0.45)
_PATCHES: tuple[Colour, ...] = (
    (1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (0.0, 0.0, 1.0),
    (0.0, 1.0, 1.0),
    (1.0, 0.0, 1.0),
    (1.0, 1.0, 0.0),
    _WHITE,
    (0.5, 0.5, 0.5),
    (0.2, 0.2, 0.2),
    (0.05, 0.05, 0.05),
)
_LETTERS = ("HOLO", "DRKCN", "SVZHODN", "KCRSZVNHD", "ONDRSKHCVZO")
_LETTER_HEIGHTS = (1.0, 0.62, 0.42, 0.28, 0.18)
_CYCLES_PER_DEG = (2, 4, 6)
_LONGEST_HEADING = 20  # letters; more would touch the frame


def built_in(
    name: str,
    width: int,
    height: int,
    field_deg: tuple[float, float] | None = FIELD_DEG,
    title: str = "HOLOGRAM",
) -> NDArray[np.float32]:
    """Draw a built-in picture. Same arguments, same pixels.

    Args:
        name: ``chart``, ``white``, ``dots``, ``bars``, ``reticle`` or ``speed``.
        width: Pixels across.
        height: Pixels from top to bottom.
        field_deg: Horizontal and vertical field that the chart fills, full angles in degrees; None
            for one that is not looked at from infinity, which then has no scale of angles.
        title: What the chart is headed with; letters that the font lacks are left out.

    Returns:
        Drives of the display's primaries, linear, 0 to 1, shape ``(height, width, 3)``, top row
        first. Black is transparent in AR.

    Raises:
        SpecError: There is no such picture.
    """
    if name not in BUILT_IN_IMAGES:
        raise FieldError("image", f"must be one of {', '.join(BUILT_IN_IMAGES)}", name)
    if name == "white":
        return np.ones((height, width, 3), dtype=np.float32)
    if name in symbols.PICTURES:
        pixels = symbols.PICTURES[name](width, height)
    elif name == "dots":
        pixels = _dots(width, height)
    else:
        pixels = _chart(width, height, field_deg, title)
    return pixels.astype(np.float32)


def check_picture(path: Path, field: str = "display.image") -> None:
    """Make sure that an image file is a picture that can be read whole.

    Args:
        path: The file.
        field: Field that names it.

    Raises:
        FieldError: It is not one.
    """
    try:
        check_readable(path)
    except SpecError as error:
        raise FieldError(field, str(error), path.name) from error


def dot_centres() -> NDArray[np.float64]:
    """Centres of the 9 x 5 dots, row by row from the top, each from left to right.

    Returns:
        Fractions of width and height from the picture's centre, +x right, +y up, shape ``(45, 2)``.
    """
    x = np.linspace(-_DOT_REACH, _DOT_REACH, _DOT_COLUMNS)
    y = np.linspace(_DOT_REACH, -_DOT_REACH, _DOT_ROWS)
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def _dots(width: int, height: int) -> NDArray[np.float64]:
    canvas = Canvas(width, height, (float(width), float(height)))
    radius = max(_DOT_RADIUS * width, _LEAST_DOT_PIXELS)
    for x, y in dot_centres().tolist():
        canvas.disk((x * width, y * height), radius)
    canvas.paint(_WHITE)
    return canvas.pixels


def _chart(
    width: int, height: int, labelled_deg: tuple[float, float] | None, heading: str
) -> NDArray[np.float64]:
    """Ticks are true to the angle and bars nearly so; all else scales with the field."""
    field_deg = FIELD_DEG if labelled_deg is None else labelled_deg
    size = (2.0 * _place(field_deg[0] / 2.0), 2.0 * _place(field_deg[1] / 2.0))
    canvas = Canvas(width, height, size)
    scale = min(size[0] / FIELD_DEG[0], size[1] / FIELD_DEG[1])
    _frame(canvas, size, scale)
    if labelled_deg is not None:
        _ticks(canvas, labelled_deg, scale)
        title = f"{labelled_deg[0]:.3G} x {labelled_deg[1]:.3G} DEG"
        text(canvas, title, (0.0, 2.8 * scale), 0.4 * scale, _ACCENT)
    _cross(canvas, scale)
    heading = stroke_font.printable(heading)[:_LONGEST_HEADING]
    text(canvas, heading, (0.0, 3.75 * scale), 0.8 * scale, _WHITE)
    _bars(canvas, scale)
    _letters(canvas, scale)
    _patches(canvas, scale)
    return canvas.pixels


def _place(angle_deg: float) -> float:
    """Where an angle lies on the display, in units that are degrees near the centre.

    The display stands in a focal plane, so a place is the tangent of an angle.
    """
    return float(np.degrees(np.tan(np.radians(angle_deg))))


def _frame(canvas: Canvas, size: tuple[float, float], scale: float) -> None:
    x, y, line = size[0] / 2.0, size[1] / 2.0, 0.05 * scale
    canvas.rectangle((-x, -y), (x, line - y))
    canvas.rectangle((-x, y - line), (x, y))
    canvas.rectangle((-x, line - y), (line - x, y - line))
    canvas.rectangle((x - line, line - y), (x, y - line))
    canvas.paint(_WHITE)


def _ticks(canvas: Canvas, field_deg: tuple[float, float], scale: float) -> None:
    """A tick at each degree along the frame, and a number at each fifth."""
    for axis in (0, 1):
        edge = _place(field_deg[1 - axis] / 2.0)
        last = int(np.ceil(field_deg[axis] / 2.0)) - 1
        for degree in range(-last, last + 1):
            at = _place(degree)
            length = (0.32 if degree % 5 == 0 else 0.16) * scale
            for side in (-1.0, 1.0):
                ends = sorted((side * (edge - length), side * edge))
                low, high = (at - 0.02 * scale, ends[0]), (at + 0.02 * scale, ends[1])
                canvas.rectangle(low[:: 1 - 2 * axis], high[:: 1 - 2 * axis])
        canvas.paint(_ACCENT)
        for degree in range(-last, last + 1):
            if degree % 5 == 0:
                spot = (_place(degree), -edge + 0.6 * scale)
                text(canvas, f"{degree}", spot[:: 1 - 2 * axis], 0.2 * scale, _ACCENT)


def _cross(canvas: Canvas, scale: float) -> None:
    """A cross that leaves its very centre free, and a ring of one degree radius around it."""
    gap, arm, line = 0.12 * scale, 0.8 * scale, 0.02 * scale
    for sign in (-1.0, 1.0):
        near, far = sorted((sign * gap, sign * arm))
        canvas.rectangle((near, -line), (far, line))
        canvas.rectangle((-line, near), (line, far))
    canvas.paint(_WHITE)
    canvas.ring((0.0, 0.0), _place(1.0), line)
    canvas.paint(_ACCENT)


def _bars(canvas: Canvas, scale: float) -> None:
    """Groups of upright and level bars; 7 degrees off the centre they are 1.5 % finer in angle."""
    side = 1.5 * scale
    text(canvas, "C/DEG", (-7.8 * scale, 2.1 * scale), 0.2 * scale, _QUIET)
    for row, cycles in enumerate(_CYCLES_PER_DEG):
        y = (1.3 - 1.75 * row) * scale
        count = max(round(side * cycles), 1)
        extent = (count - 0.5) / cycles
        text(canvas, f"{cycles}", (-7.8 * scale, y), 0.4 * scale, _ACCENT)
        for column in (0, 1):
            x = (-6.3 + 1.75 * column) * scale
            for bar in range(count):
                start = bar / cycles - extent / 2.0
                low, high = (start, -extent / 2.0), (start + 0.5 / cycles, extent / 2.0)
                low, high = low[:: 1 - 2 * column], high[:: 1 - 2 * column]
                canvas.rectangle((x + low[0], y + low[1]), (x + high[0], y + high[1]))
        canvas.paint(_WHITE)


def _letters(canvas: Canvas, scale: float) -> None:
    top = 1.9
    for letters, height in zip(_LETTERS, _LETTER_HEIGHTS, strict=True):
        place = (5.6 * scale, (top - height / 2.0) * scale)
        text(canvas, letters, place, height * scale, _WHITE)
        top -= height + 0.38


def _patches(canvas: Canvas, scale: float) -> None:
    pitch, half = 1.25 * scale, 0.5 * scale
    for number, colour in enumerate(_PATCHES):
        x = (number - 0.5 * (len(_PATCHES) - 1)) * pitch
        canvas.rectangle((x - half, -4.15 * scale), (x + half, -3.35 * scale))
        canvas.paint(colour)
