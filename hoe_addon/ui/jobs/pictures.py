# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that jobs have made, as images of the open file."""

import os
from collections.abc import Iterator
from pathlib import Path

import bpy

PICTURE, SHEET = "Hologram Render", "Hologram Eyebox"
"""Names of the images."""

_NOWHERE = "NONE"

_MARK = "hologram_picture"
"""Custom property of an image that holds the last picture of a kind; the user may rename it."""


def load_picture(path: Path, name: str) -> bpy.types.Image:
    """Load a picture, in place of the one of that name that was loaded before.

    Args:
        path: The file.
        name: Name of the image.

    Returns:
        The image; it is shown with the exposure and the view transform of the scene where it is
        scene-linear.
    """
    ours = (each for each in bpy.data.images if each.get(_MARK) == name and not each.library)
    image = next(ours, None)
    if image is None:
        image = bpy.data.images.load(str(path))
        image.name, image[_MARK] = name, name
    image.source, image.filepath = "FILE", _written(path)
    image.reload()
    linear = path.suffix == ".exr"
    image.colorspace_settings.name = "Linear Rec.709" if linear else "sRGB"
    image.use_view_as_render = linear
    return image


def show_picture(context: bpy.types.Context, image: bpy.types.Image) -> None:
    """Show an image in an image editor; in a new window where none is open.

    Args:
        context: Context with a window.
        image: The image.
    """
    space = next(_editors(context), None)
    if space is None and context.preferences.view.render_display_type != _NOWHERE:
        space = _new_window(context)
    if space is not None:
        space.image = image


def _editors(context: bpy.types.Context) -> Iterator[bpy.types.SpaceImageEditor]:
    """Image editors that are open, those first that show nothing of the user's."""
    found = [
        area.spaces.active
        for window in context.window_manager.windows
        for area in window.screen.areas
        if area.ui_type == "IMAGE_EDITOR" and area.spaces.active.mode == "VIEW"
    ]
    return iter(sorted(found, key=lambda space: not _is_free(space.image)))


def _is_free(image: bpy.types.Image | None) -> bool:
    return image is None or image.type == "RENDER_RESULT" or _MARK in image


def _new_window(context: bpy.types.Context) -> bpy.types.SpaceImageEditor | None:
    before = set(context.window_manager.windows)
    bpy.ops.wm.window_new()
    made = [window for window in context.window_manager.windows if window not in before]
    if not made:
        return None
    area = made[0].screen.areas[0]
    area.ui_type = "IMAGE_EDITOR"
    return area.spaces.active


def _written(path: Path) -> str:
    """The path as a .blend is to hold it: relative where the file and the user want it so."""
    wanted = bpy.context.preferences.filepaths.use_relative_paths and bpy.data.filepath
    if wanted and os.path.splitdrive(bpy.data.filepath)[0] == path.drive:
        return bpy.path.relpath(str(path))
    return str(path)
