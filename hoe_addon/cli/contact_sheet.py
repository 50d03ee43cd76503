# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A labelled sheet of the views of an eyebox survey."""

from pathlib import Path
from typing import Any

import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)

from ..core.errors import RenderError
from ..files import replacing
from .with_error import with_error

_MARGIN = 8
_LEAST_WIDTH = 320  # pixels of a view; captions would run into each other on a smaller one
_CAPTION = 34
_TITLE = 54
_PAPER = (0.10, 0.10, 0.11)
_INK = (0.92, 0.92, 0.92)
_FAINT = (0.66, 0.66, 0.68)


def write_contact_sheet(path: Path, views: Path, report: dict[str, Any]) -> None:
    """Put the views side by side, as the pupils lie, each with its place and luminance.

    Args:
        path: The PNG file.
        views: Folder of the views, ``NAME.png``.
        report: What eyebox.json holds.

    Raises:
        RenderError: A view cannot be read, or the sheet not be written.
    """
    columns, rows = report["grid"]
    first = _read(views / f"{report['positions'][0]['name']}.png")
    width, height = first.spec().width, first.spec().height
    cell_width, cell_height = width + _MARGIN, height + _CAPTION + _MARGIN
    sheet = oiio.ImageBuf(
        oiio.ImageSpec(
            columns * cell_width + _MARGIN, rows * cell_height + _MARGIN + _TITLE, 3, oiio.UINT8
        )
    )
    oiio.ImageBufAlgo.fill(sheet, _PAPER)
    field_x, field_y = report["field_deg"]
    _text(sheet, _MARGIN, 24, 17, _INK, f"{report['device']}: {columns} x {rows} pupils")
    subtitle = (
        f"pupil {report['pupil_diameter_mm']:g} mm, field {field_x:.1f} x {field_y:.1f} deg; "
        "L: white display over its field"
    )
    _text(sheet, _MARGIN, 44, 13, _FAINT, subtitle)
    for position in report["positions"]:
        x = _MARGIN + position["column"] * cell_width
        y = _TITLE + position["row"] * cell_height
        oiio.ImageBufAlgo.paste(sheet, x, y, 0, 0, _read(views / f"{position['name']}.png"))
        pupil_x, pupil_y, _ = position["pupil_mm"]
        _text(sheet, x, y + height + 15, 13, _INK, f"x {pupil_x:+g} mm, y {pupil_y:+g} mm")
        _text(sheet, x, y + height + 30, 12, _FAINT, _label(position))
    with replacing(path) as part:
        if not sheet.write(str(part)):
            raise RenderError(f"{path}: cannot be written: {sheet.geterror()}")


def _label(position: dict[str, Any]) -> str:
    """Luminance and uniformity at one pupil."""
    mean = with_error(position["mean_cd_m2"], position["standard_error_cd_m2"], 1)
    uniformity = with_error(position["uniformity"], position["uniformity_standard_error"], 2)
    return f"L {mean} cd/m2, min/max {uniformity}"


def _read(path: Path) -> oiio.ImageBuf:
    """Read a view; one that is too small for its caption is enlarged by whole pixels."""
    picture = oiio.ImageBuf(str(path))
    if not picture.read(0, 0, True, oiio.UINT8):
        raise RenderError(f"{path}: cannot be read: {picture.geterror()}")
    spec = picture.spec()
    times = -(-_LEAST_WIDTH // spec.width)
    if times == 1:
        return picture
    roi = oiio.ROI(0, spec.width * times, 0, spec.height * times, 0, 1, 0, spec.nchannels)
    return oiio.ImageBufAlgo.resample(picture, False, roi)


def _text(
    sheet: oiio.ImageBuf, x: int, y: int, size: int, colour: tuple[float, float, float], text: str
) -> None:
    if not oiio.ImageBufAlgo.render_text(sheet, x, y, text, size, "", colour):
        raise RenderError(f"a label cannot be drawn: {sheet.geterror()}")
