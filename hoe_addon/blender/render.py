# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a scene to numbers, quietly, with progress and a way to stop."""

import contextlib
import os
import re
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.errors import RenderError
from . import exr
from .render_settings import write_float_exr

type Progress = Callable[[float], None]
"""Called with the finished share of the work, 0 to 1. It may raise CancelledError to stop."""

COMBINED = "Combined"


def render_layers(
    scene: bpy.types.Scene, layers: tuple[str, ...], progress: Progress | None = None
) -> dict[str, NDArray[np.float32]]:
    """Render a scene and return some of its passes.

    Args:
        scene: The scene, ready to render; its first view layer is taken.
        layers: Names of passes, such as ``Combined`` or ``Combined_display``.
        progress: Told after every part.

    Returns:
        Scene-linear values by pass, shape ``(height, width, 3)``, top row first.

    Raises:
        RenderError: Blender gave no picture, or one that has NaN or infinity in it.
    """
    with tempfile.TemporaryDirectory(prefix="hoe_render_") as folder:
        path = Path(folder) / "layers.exr"
        with _kept_output(scene), _told(scene, progress):
            write_float_exr(scene, path, layers=True)
            with quiet_stdout():
                bpy.ops.render.render(write_still=True, scene=scene.name)
        if not path.exists():
            raise RenderError("Blender wrote no picture; see its log for the reason")
        view_layer = scene.view_layers[0].name
        found = {layer: exr.read(path, f"{view_layer}.{layer}.") for layer in layers}
    for layer, pixels in found.items():
        bad = int(np.count_nonzero(~np.isfinite(pixels)))
        if bad:
            raise RenderError(f"pass {layer} has {bad} values that are not finite")
    return found


@contextlib.contextmanager
def quiet_stdout() -> Iterator[None]:
    """Keep Blender's own lines ("Saved ...") off the process's standard output."""
    kept = os.dup(1)
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(silence)


@contextlib.contextmanager
def _kept_output(scene: bpy.types.Scene) -> Iterator[None]:
    """Give a user's output settings back after the render."""
    picture = scene.render.image_settings
    names = ("media_type", "file_format", "color_mode", "color_depth", "exr_codec")
    kept = {name: getattr(picture, name) for name in names}
    path, extension = scene.render.filepath, scene.render.use_file_extension
    try:
        yield
    finally:
        for name, value in kept.items():
            setattr(picture, name, value)
        scene.render.filepath, scene.render.use_file_extension = path, extension


@contextlib.contextmanager
def _told(scene: bpy.types.Scene, progress: Progress | None) -> Iterator[None]:
    """Pass on the sample counts that Cycles reports while it renders."""
    if progress is None:
        yield
        return

    def listen(*arguments: object) -> None:
        text = next((a for a in arguments if isinstance(a, str)), "")
        match = re.search(r"Sample (\d+)/(\d+)", text)
        if match:
            progress(int(match[1]) / int(match[2]))

    bpy.app.handlers.render_stats.append(listen)
    try:
        yield
    finally:
        bpy.app.handlers.render_stats.remove(listen)
