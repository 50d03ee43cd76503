# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The property that gives every material a hologram."""

import bpy
from bpy.props import PointerProperty

from .hologram import HOE_PG_hologram


def register() -> None:
    """Add ``Material.hologram``."""
    bpy.types.Material.hologram = PointerProperty(
        name="Hologram",
        description="Hologram on this material",
        type=HOE_PG_hologram,
        override={"LIBRARY_OVERRIDABLE"},
    )


def unregister() -> None:
    """Take it away; what files hold in it stays in them."""
    del bpy.types.Material.hologram
