# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps that a .blend does not hold itself are made anew where their file is gone."""

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from ...core.errors import HoeError
from ..shaders.maps import map_image
from .sync import refresh


def register() -> None:
    """Look when a file is opened, and before each render."""
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).append(handler)


def unregister() -> None:
    """Look no more."""
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).remove(handler)


@persistent
def _on_load(*_arguments: object) -> None:
    # Opening a file in a window must not take long.
    _restore(make=bpy.app.background)


@persistent
def _before_render(*_arguments: object) -> None:
    _restore(make=True)


_HANDLERS = {"load_post": _on_load, "render_pre": _before_render}


def _restore(*, make: bool) -> None:
    for material in bpy.data.materials:
        mine = material.hologram.enabled and material.library is None
        image = map_image(material) if mine else None
        if image is None or image.packed_file is not None:
            continue
        if not Path(bpy.path.abspath(image.filepath)).is_file():
            try:
                refresh(material, make=make)
            except HoeError:
                # It stands in the property, where a panel shows it; nothing is recorded there.
                continue
