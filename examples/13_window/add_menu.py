# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Hologram in Blender's first scene."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import bpy
from window import Picture, area, region, take


def later() -> None:
    """Open the menu where the pointer is."""
    window = bpy.context.window_manager.windows[0]
    if not bpy.app.background:
        with bpy.context.temp_override(window=window, area=area(), region=region("WINDOW")):
            bpy.ops.wm.call_menu(name="HOE_MT_add")


take(Picture("beginning", opened=("device",), later=later))
