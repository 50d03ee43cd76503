# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Float pictures: read and write OpenEXR through OpenImageIO."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
from numpy.typing import NDArray

from ...core.errors import RenderError
from ...files import replacing


def read(path: Path, prefix: str = "") -> NDArray[np.float32]:
    """Read the three colour channels of one layer, in whichever part of the file it is.

    Args:
        path: An OpenEXR file.
        prefix: What stands before ``R``, ``G`` and ``B`` in the names of the channels, such as
            ``ViewLayer.Combined.``.

    Returns:
        Scene-linear values, shape ``(height, width, 3)``, top row first.

    Raises:
        RenderError: The file cannot be read or lacks the layer.
    """
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise RenderError(f"{path}: cannot be read: {oiio.geterror()}")
    wanted = [f"{prefix}{channel}" for channel in "RGB"]
    try:
        part = 0
        while source.seek_subimage(part, 0):
            spec = source.spec()
            names = list(spec.channelnames)
            if set(wanted) <= set(names):
                pixels = source.read_image(part, 0, 0, spec.nchannels, oiio.FLOAT)
                if pixels is None:
                    raise RenderError(f"{path}: is damaged: {source.geterror()}")
                shaped = np.asarray(pixels, np.float32).reshape(spec.height, spec.width, -1)
                return shaped[..., [names.index(name) for name in wanted]]
            part += 1
    finally:
        source.close()
    raise RenderError(f"{path}: has no channels {', '.join(wanted)}")


def write(path: Path, pixels: NDArray[np.float32]) -> None:
    """Write a scene-linear picture as 32-bit float, losslessly compressed.

    Args:
        path: File to write; it appears whole or not at all.
        pixels: Shape ``(height, width, 3)``, top row first.

    Raises:
        RenderError: The file cannot be written.
    """
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, oiio.FLOAT)
    spec.attribute("compression", "zip")
    spec.attribute("oiio:ColorSpace", "lin_rec709")
    with replacing(path) as part:
        output = oiio.ImageOutput.create(str(part))
        if output is None or not output.open(str(part), spec):
            raise RenderError(f"{path}: cannot be written: {oiio.geterror()}")
        done = output.write_image(np.ascontiguousarray(pixels, dtype=np.float32))
        if not (output.close() and done):
            raise RenderError(f"{path}: cannot be written: {output.geterror()}")
