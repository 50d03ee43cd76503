# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a scene to numbers, quietly, with progress and a way to stop."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import RenderError
from ...files import scratch_folder
from ..kept import kept
from ..quiet import captured_output
from . import exr
from .render_settings import picture_size, write_float_exr

type Progress = Callable[[float], None]
"""Called with the finished share of the work, 0 to 1. It may raise CancelledError to stop."""

COMBINED = "Combined"

_PATHS_PER_PART = 3_000_000
"""Camera paths in one part: seconds of work, so that progress moves and a stop is soon heard.

The parts depend on picture and samples only, never on time: same seed, same picture.
"""


_BORDER = ("border_min_x", "border_max_x", "border_min_y", "border_max_y")


@dataclass(frozen=True)
class Region:
    """A rectangle of pixels, counted from the top left; the far ends are not part of it."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def pixels(self) -> int:
        """Its number of pixels."""
        return (self.right - self.left) * (self.bottom - self.top)

    @property
    def slices(self) -> tuple[slice, slice]:
        """It as an index of a picture."""
        return slice(self.top, self.bottom), slice(self.left, self.right)


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
    cycles = scene.cycles
    found = render_samples(scene, layers, cycles.seed, 0, cycles.samples, progress=progress)
    return {layer: pixels.astype(np.float32) for layer, pixels in found.items()}


def render_samples(
    scene: bpy.types.Scene,
    layers: Sequence[str],
    seed: int,
    first: int,
    count: int,
    *,
    region: Region | None = None,
    progress: Progress | None = None,
) -> dict[str, NDArray[np.float64]]:
    """Render some samples of the stratified sequence of a seed.

    Args:
        scene: The scene, ready to render; its first view layer is taken.
        layers: Names of passes.
        seed: Seed of all random numbers.
        first: Number of the first sample.
        count: Number of samples, at least 1.
        region: Part of the picture to render; None is all.
        progress: Told after every part.

    Returns:
        Mean of the samples, scene-linear, by pass, shape ``(height, width, 3)``, top row first;
        0 outside the region.

    Raises:
        RenderError: Blender gave no picture, or one that has NaN or infinity in it.
        CancelledError: The progress function asked to stop.
    """
    width, height = picture_size(scene)
    step = max(
        1, min(count, _PATHS_PER_PART // (width * height if region is None else region.pixels))
    )
    sums = {layer: np.zeros((height, width, 3)) for layer in layers}
    with kept(*_settings(scene)), scratch_folder() as folder:
        path = folder / "layers.exr"
        write_float_exr(scene, path, layers=True)
        scene.cycles.seed = seed
        # Cycles takes no more than that, whatever the subset says.
        scene.cycles.samples = max(scene.cycles.samples, first + count)
        _set_region(scene, region)
        if step < count or first > 0 or region is not None:
            # With persistent data Cycles keeps the first part's offset: all would be the same.
            scene.render.use_persistent_data = False
        for begin in range(0, count, step):
            some = min(step, count - begin)
            for layer, part in _render_part(scene, path, layers, first + begin, some).items():
                sums[layer] += part.astype(np.float64) * (some / count)
            if progress is not None:
                progress((begin + some) / count)
    return sums


def _set_region(scene: bpy.types.Scene, region: Region | None) -> None:
    """Let only a region be rendered; the picture keeps its size, with black around."""
    render = scene.render
    render.use_border = region is not None
    if region is not None:
        width, height = picture_size(scene)
        render.use_crop_to_border = False
        # Blender multiplies in single precision and cuts the rest off: half a pixel is safe.
        bottom, top = height - region.bottom, height - region.top
        render.border_min_x = (region.left + 0.5) / width
        render.border_max_x = min((region.right + 0.5) / width, 1.0)
        render.border_min_y = (bottom + 0.5) / height
        render.border_max_y = min((top + 0.5) / height, 1.0)


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


def _settings(scene: bpy.types.Scene) -> tuple[tuple[Any, Sequence[str]], ...]:
    """A user's output and sampling settings, which a render changes."""
    return (
        (
            scene.render.image_settings,
            ("media_type", "file_format", "color_mode", "color_depth", "exr_codec"),
        ),
        (scene.render, ("filepath", "use_file_extension", "use_persistent_data")),
        (scene.render, ("use_border", "use_crop_to_border", *_BORDER)),
        (
            scene.cycles,
            ("seed", "samples", "use_sample_subset", "sample_offset", "sample_subset_length"),
        ),
    )
