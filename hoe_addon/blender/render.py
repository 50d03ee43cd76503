# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a scene to numbers, quietly, with progress and a way to stop."""

import contextlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.errors import RenderError
from ..files import scratch_folder
from . import exr
from .quiet import captured_output
from .render_settings import write_float_exr

type Progress = Callable[[float], None]
"""Called with the finished share of the work, 0 to 1. It may raise CancelledError to stop."""

COMBINED = "Combined"

_PATHS_PER_PART = 3_000_000
"""Camera paths in one part: seconds of work, so that progress moves and a stop is soon heard.

The parts depend on picture and samples only, never on time: same seed, same picture.
"""


def render_layers(
    scene: bpy.types.Scene, layers: Sequence[str], progress: Progress | None = None
) -> dict[str, NDArray[np.float32]]:
    """Render a scene in parts and return some of its passes.

    Each part takes the next samples of one and the same stratified sequence, and the parts'
    mean is the picture that one long render would give.

    Args:
        scene: The scene, ready to render; its first view layer is taken.
        layers: Names of passes, such as ``Combined`` or ``Combined_display``.
        progress: Told after every part.

    Returns:
        Scene-linear values by pass, shape ``(height, width, 3)``, top row first.

    Raises:
        RenderError: Blender gave no picture, or one that has NaN or infinity in it.
        CancelledError: The progress function asked to stop.
    """
    total = scene.cycles.samples
    pixels = scene.render.resolution_x * scene.render.resolution_y
    step = max(1, min(total, _PATHS_PER_PART // pixels))
    sums: dict[str, NDArray[np.float64]] = {}
    with _kept_settings(scene), scratch_folder() as folder:
        path = folder / "layers.exr"
        write_float_exr(scene, path, layers=True)
        if step < total:
            # With persistent data Cycles keeps the first part's offset: all would be the same.
            scene.render.use_persistent_data = False
        for first in range(0, total, step):
            count = min(step, total - first)
            for layer, part in _render_part(scene, path, layers, first, count).items():
                sums[layer] = sums.get(layer, 0.0) + part.astype(np.float64) * (count / total)
            if progress is not None:
                progress((first + count) / total)
    return {layer: pixels.astype(np.float32) for layer, pixels in sums.items()}


def _render_part(
    scene: bpy.types.Scene, path: Path, layers: Sequence[str], first: int, count: int
) -> dict[str, NDArray[np.float32]]:
    scene.cycles.use_sample_subset = True
    scene.cycles.sample_offset = first
    scene.cycles.sample_subset_length = count
    path.unlink(missing_ok=True)
    with captured_output() as said:
        bpy.ops.render.render(write_still=True, scene=scene.name)
    if not path.exists():
        raise RenderError(f"Blender wrote no picture: {' '.join(said[-3:])}")
    found = {layer: exr.read(path, f"{scene.view_layers[0].name}.{layer}.") for layer in layers}
    for layer, pixels in found.items():
        bad = int(np.count_nonzero(~np.isfinite(pixels)))
        if bad:
            raise RenderError(f"pass {layer} has {bad} values that are not finite")
    return found


@contextlib.contextmanager
def _kept_settings(scene: bpy.types.Scene) -> Iterator[None]:
    """Give a user's output and sampling settings back after the render."""
    groups = (
        (
            scene.render.image_settings,
            ("media_type", "file_format", "color_mode", "color_depth", "exr_codec"),
        ),
        (scene.render, ("filepath", "use_file_extension", "use_persistent_data")),
        (scene.cycles, ("use_sample_subset", "sample_offset", "sample_subset_length")),
    )
    kept = [(owner, name, getattr(owner, name)) for owner, names in groups for name in names]
    try:
        yield
    finally:
        for owner, name, value in kept:
            setattr(owner, name, value)
