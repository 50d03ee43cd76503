# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in files that may come from strangers: their size is looked at before any pixel."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
from numpy.typing import NDArray

from ..core.errors import SpecError

MOST_NUMBERS = 4 * 36_000_000
"""Numbers in a picture of any kind: four channels of what is called 8K."""

_LONGEST_SIDE = 16384
_ROWS = 64
"""Rows that are unpacked together; all at once would need the memory of the whole picture."""

_EXR_MAGIC = b"v/1\x01"
_SHOWN = 120


def read_exr_pixels(
    path: Path, check: "Callable[[oiio.ImageSpec], None]", header: str = ""
) -> tuple[NDArray[np.float32], object]:
    """Read all pixels of an EXR.

    Args:
        path: The file.
        check: Raises SpecError for a size or a number of channels that is not wanted.
        header: Name of an attribute to read, if any.

    Returns:
        Pixels, shape ``(height, width, channels)``, the top row first; and the attribute, or None
        where it is missing or no text.

    Raises:
        SpecError: The file is no EXR, or damaged.
    """
    try:
        with path.open("rb") as file:
            start = file.read(len(_EXR_MAGIC))
    except OSError as error:
        raise _unreadable(error.strerror or str(error)) from error
    if start != _EXR_MAGIC:
        # Else OpenImageIO would try what other format it could be.
        raise _unreadable("it does not begin as such a file does")
    picture = oiio.ImageInput.open(str(path))
    if picture is None:
        raise _unreadable(last_message())
    try:
        spec = picture.spec()
        check(spec)
        text = _attribute(spec, header) if header else None
        pixels = picture.read_image(0, 0, 0, spec.nchannels, oiio.FLOAT)
        if pixels is None:
            raise _unreadable(last_message(picture))
    finally:
        picture.close()
    shape = (spec.height, spec.width, spec.nchannels)
    return np.asarray(pixels, dtype=np.float32).reshape(shape), text


def check_readable(path: Path) -> None:
    """Make sure that a file is a picture that can be read whole.

    Args:
        path: The file, of any format that is known here.

    Raises:
        SpecError: It is none, too large, or damaged.
    """
    picture = oiio.ImageInput.open(str(path))
    if picture is None:
        # OpenImageIO keeps its message until it is asked for.
        last_message()
        raise SpecError("must be a picture that can be read")
    try:
        spec = picture.spec()
        numbers = spec.width * spec.height * spec.depth * spec.nchannels
        if max(spec.width, spec.height) > _LONGEST_SIDE or numbers > MOST_NUMBERS:
            size = f"{spec.width} x {spec.height} of {spec.nchannels} channels"
            most = f"{MOST_NUMBERS // 4_000_000} megapixels of 4 channels"
            raise SpecError(f"must be a picture of at most {most}, not {size}")
        if not _reads_whole(picture, spec):
            last_message(picture)
            raise SpecError("must be a picture that can be read")
    finally:
        picture.close()


def _reads_whole(picture: "oiio.ImageInput", spec: "oiio.ImageSpec") -> bool:
    if spec.tile_width > 0:
        return picture.read_image(0, 0, 0, spec.nchannels, spec.format) is not None
    rows = range(spec.y, spec.y + spec.height, _ROWS)
    end = spec.y + spec.height
    return all(
        picture.read_scanlines(row, min(row + _ROWS, end), 0, 0, spec.nchannels, spec.format)
        is not None
        for row in rows
    )


def last_message(picture: "oiio.ImageInput | None" = None) -> str:
    """Take the last complaint of OpenImageIO, which it keeps until it is asked for.

    Args:
        picture: The picture that failed; None where it could not be opened.

    Returns:
        One short line; it may quote bytes of the file, which need not be text.
    """
    try:
        message = cast("Any", picture or oiio).geterror()
    except UnicodeDecodeError:
        return "damaged"
    return " ".join(message.split())[:_SHOWN]


def _attribute(spec: "oiio.ImageSpec", name: str) -> object:
    try:
        return spec.getattribute(name)
    except UnicodeDecodeError:
        return None


def _unreadable(reason: str) -> SpecError:
    return SpecError(f"is no readable .exr file ({reason})")
