# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps that a .blend does not hold itself are made anew where their file is gone."""

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from ...core.errors import HoeError
from ..maps import map_image
from .sync import refresh

_EVENTS = ("load_post", "render_pre")


def register() -> None:
    """Look when a file is opened, and before each render."""
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).append(_restore)


def unregister() -> None:
    """Look no more."""
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).remove(_restore)


@persistent
def _restore(*_arguments: object) -> None:
    for material in bpy.data.materials:
        image = map_image(material) if material.hologram.enabled else None
        if image is None or image.packed_file is not None:
            continue
        if not Path(bpy.path.abspath(image.filepath)).is_file():
            try:
                refresh(material)
            except HoeError:
                # It stands in the property, where a panel shows it; nothing is recorded there.
                continue
