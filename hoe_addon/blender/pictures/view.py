# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One look through a device: render it, measure it, keep it."""

import json
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ... import resources
from ...core.arrays import BoolArray
from ...core.mean_error import mean_error
from ...core.photometry import luminance, measure
from ...files import replacing, write_text
from ...model.device import LightGuideSpec
from ...model.document import to_document
from ...model.effects import EffectPlan
from ...model.field import field_mask
from ..build.device import DeviceScene
from ..kept import changed
from ..quiet import captured_output
from . import exr
from .denoiser import denoise
from .division import Division, divided
from .passes import DISPLAY_LAYER
from .render import COMBINED, Progress

_PNG = {"media_type": "IMAGE", "file_format": "PNG", "color_mode": "RGB", "color_depth": "8"}


@dataclass(frozen=True, eq=False)
class View:
    """What the eye sees, scene-linear.

    Attributes:
        picture: All light, shape ``(height, width, 3)``, top row first.
        display: The share that comes from the display, same shape.
        seconds: Time that the render took.
        clean: The picture without noise, where it is there already, same shape.
        samples: Samples per pixel by the name of the pass.
    """

    picture: NDArray[np.float32]
    display: NDArray[np.float32]
    seconds: float
    clean: NDArray[np.float32] | None = None
    samples: Mapping[str, int] = field(default_factory=dict)


def render_view(
    device: DeviceScene, progress: Progress | None = None, division: Division | None = None
) -> View:
    """Render what the eye sees.

    Args:
        device: The device in its scene.
        progress: Told after every part.
        division: How the picture is divided into passes; by default what a pilot finds, or one
            pass where the picture is small.

    Returns:
        The picture, and the display's share of it.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    started = time.perf_counter()
    cycles = device.scene.cycles
    division = division or divided(device, cycles.samples)
    layers, counts = division.render(cycles.seed, cycles.samples, progress)
    return View(
        layers[COMBINED], layers[DISPLAY_LAYER], time.perf_counter() - started, samples=counts
    )


def view_metrics(device: DeviceScene, view: View) -> dict[str, Any]:
    """What a report says of a view; every number carries its unit in its name."""
    unit = device.spec.render.luminance_per_unit_cd_m2
    everywhere = np.ones(view.picture.shape[:2], dtype=np.bool_)
    metrics: dict[str, Any] = {
        "device": device.spec.name,
        "settings": to_document(device.spec.render),
        "eye": to_document(device.spec.eye),
        "seconds": round(view.seconds, 3),
        "samples": device.scene.cycles.samples,
        "passes": dict(view.samples),
        "picture": _measured(view.picture, unit, everywhere),
        "effects": _effects(device.plan),
        "blender": bpy.app.version_string,
        "hoe_addon": resources.version(),
    }
    if isinstance(device.spec, LightGuideSpec):
        height, width, _ = view.picture.shape
        inside = field_mask(device.spec, width, height)
        metrics["display_field"] = {
            "display_light": _measured(view.display, unit, inside),
            "all_light": _measured(view.picture, unit, inside),
        }
    else:
        metrics["emitters"] = _measured(view.display, unit, everywhere)
    return metrics


def save_view(
    device: DeviceScene,
    view: View,
    folder: Path,
    *,
    clean: bool,
    more: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Write view.exr, view.png, view.blend and metrics.json; each is whole or not there.

    Args:
        device: The device in its scene.
        view: Its view.
        folder: Folder that exists.
        clean: Whether view.png is denoised; view.exr and the numbers never are.
        more: What else metrics.json holds.

    Returns:
        What metrics.json holds.

    Raises:
        HoeError: A file cannot be written.
    """
    metrics = {**view_metrics(device, view), "png_denoised": clean, **(more or {})}
    exr.write(folder / "view.exr", view.picture)
    shown = clean_picture(view) if clean else view.picture
    save_png(device.scene, shown, folder / "view.png")
    save_blend(folder / "view.blend")
    write_text(folder / "metrics.json", (json.dumps(metrics, indent=2), "\n"))
    return metrics


def clean_picture(view: View) -> NDArray[np.float32]:
    """The view without noise; display and room are denoised apart, for their noise differs."""
    if view.clean is not None:
        return view.clean
    return denoise(view.display) + denoise(view.picture - view.display)


def save_png(scene: bpy.types.Scene, pixels: NDArray[np.float32], path: Path) -> None:
    """Write a picture as the scene shows it: with its exposure and view transform.

    Args:
        scene: Scene whose view settings are taken.
        pixels: Scene-linear, shape ``(height, width, 3)``, top row first.
        path: The file.

    Raises:
        HoeError: The file cannot be written.
    """
    height, width, _ = pixels.shape
    image = bpy.data.images.new("Shown", width, height, float_buffer=True)
    rgba = np.ones((height, width, 4), dtype=np.float32)
    rgba[..., :3] = pixels[::-1]
    image.pixels.foreach_set(rgba.ravel())
    settings = scene.render.image_settings
    try:
        with changed((settings, _PNG)), replacing(path) as part:
            image.save_render(str(part), scene=scene)
    finally:
        bpy.data.images.remove(image)


def save_blend(path: Path) -> None:
    """Write all that is open as a .blend, which renders the same without this add-on."""
    # The part exists already, and Blender would keep it beside the file as an older version.
    one_version = changed((bpy.context.preferences.filepaths, {"save_version": 0}))
    with one_version, replacing(path) as part, captured_output():
        bpy.ops.wm.save_as_mainfile(
            filepath=str(part), copy=True, compress=True, check_existing=False
        )


def _effects(plan: EffectPlan) -> dict[str, Any]:
    """What was left out, and the error that it may cost in all."""
    return {
        "left_out": [
            {
                "effect": str(each.effect),
                "hologram": each.hologram,
                "why": each.why,
                "predicted_relative_error": each.error_without,
                "overridden": each.overridden,
            }
            for each in plan.left_out
            if each.present
        ],
        "promised_relative_error": plan.promise,
    }


def _measured(
    pixels: NDArray[np.float32], unit_cd_m2: float, inside: BoolArray
) -> dict[str, float | None]:
    """Numbers on a part of a picture for JSON, which knows no NaN: black has no colour."""
    error = mean_error(luminance(pixels, unit_cd_m2), inside)
    found = measure(pixels[inside], unit_cd_m2)
    values = {**asdict(found), "mean_standard_error_at_most_cd_m2": error}
    return {name: None if np.isnan(value) else value for name, value in values.items()}
