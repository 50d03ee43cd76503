# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that panels show as icons, one for each datablock."""

import bpy.utils.previews
import numpy as np
from numpy.typing import NDArray


class _Previews:
    """All pictures, while the add-on is registered."""

    def __init__(self) -> None:
        self.held: bpy.utils.previews.ImagePreviewCollection | None = None


_previews = _Previews()


def show(owner: int, pixels: NDArray[np.float32]) -> int:
    """Make a picture, or change it.

    Args:
        owner: Session id of the datablock that it is about.
        pixels: Colours as a screen shows them, lowest row first, shape ``(height, width, 4)``.

    Returns:
        Number of the icon; Blender has none in background mode.
    """
    held = _previews.held
    assert held is not None, "is asked for only while registered"
    name = str(owner)
    preview = held[name] if name in held else held.new(name)
    height, width, _ = pixels.shape
    preview.image_size = (width, height)
    preview.image_pixels_float.foreach_set(pixels.ravel())
    return preview.icon_id


def register() -> None:
    """Begin without pictures."""
    _previews.held = bpy.utils.previews.new()


def unregister() -> None:
    """Throw all pictures away."""
    bpy.utils.previews.remove(_previews.held)
    _previews.held = None
