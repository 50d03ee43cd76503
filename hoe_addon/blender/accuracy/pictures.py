# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a measurement as PNG data, as the device's own pictures are shown."""

import bpy
import numpy as np
from numpy.typing import NDArray

from ...files import scratch_folder
from ..pictures.view import save_png


def png_of(pixels: NDArray[np.floating]) -> bytes:
    """Make a PNG of a scene-linear picture, with exposure and view transform of the open scene.

    Args:
        pixels: Linear Rec. 709 values, shape ``(height, width, 3)``, top row first.

    Returns:
        The content of the file.
    """
    with scratch_folder() as folder:
        path = folder / "picture.png"
        save_png(bpy.context.scene, np.asarray(pixels, dtype=np.float32), path)
        return path.read_bytes()
