# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the 3-D views of a window show of a scene in millimetres."""

from collections.abc import Iterator

import bpy

_CLIP_MM = (1.0, 1e6)
"""From a millimetre to a kilometre."""


def look_through_camera(window: bpy.types.Window) -> None:
    """Let the 3-D views of a window show what the camera sees, in solid shading.

    Args:
        window: The window.
    """
    for space in _views(window):
        space.shading.type = "SOLID"
        space.shading.color_type = "MATERIAL"
        space.clip_start, space.clip_end = _CLIP_MM
        space.lock_camera = False
        space.region_3d.view_perspective = "CAMERA"


def _views(window: bpy.types.Window) -> Iterator[bpy.types.SpaceView3D]:
    for area in window.screen.areas:
        space = area.spaces.active
        if isinstance(space, bpy.types.SpaceView3D):
            yield space
