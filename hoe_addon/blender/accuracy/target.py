# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How sharp a light guide shows its display: the contrast of bars of 5 cycles per degree.

The display shows a cosine grating, drawn in equal angles, and nothing else gives light. The camera
looks at eight of its cycles in the middle of the field, at eight pixels a cycle and with a box
filter. What the filter, and the straight lines between the pixels of the display's picture, take
from the contrast is divided out.
"""

import contextlib
import math
from collections.abc import Iterator

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.arrays import FloatArray
from ...core.picture_error import Estimate, modulation
from ...core.picture_pieces import relative_luminance
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.field import field_tangents
from ..build.device import DeviceScene
from ..kept import changed
from ..pictures.denoiser import denoise
from ..pictures.render import render_layers
from ..pictures.render_settings import size_settings
from ..pictures.view import DISPLAY_LAYER
from ..shaders.materials import picture

CYCLES_PER_DEGREE = 5.0

_CYCLES, _PIXELS_A_CYCLE, _ROWS = 8, 8, 16
_COLUMNS = _CYCLES * _PIXELS_A_CYCLE
_DRAWN_A_CYCLE = 24
"""Pixels of the display's picture to a cycle."""

_ROW_GROUPS = 4


def why_no_target(spec: DeviceSpec) -> str:
    """Say why the sharpness of a device is not measured.

    Args:
        spec: The device.

    Returns:
        The reason; empty where it is measured.
    """
    if not isinstance(spec, LightGuideSpec):
        return "only a light guide has a display whose picture lies in a known field"
    half = math.degrees(math.atan(field_tangents(spec)[0]))
    if 2.0 * half < _CYCLES / CYCLES_PER_DEGREE:
        return f"the field of {2.0 * half:.2g} degrees is narrower than eight cycles"
    return ""


def sharpness(device: DeviceScene, samples: int, seed: int, *, clean: bool = False) -> Estimate:
    """Measure the contrast that a grating of 5 cycles per degree has left.

    Args:
        device: A light guide in its scene; left as it was.
        samples: Samples per pixel.
        seed: Seed of the random numbers.
        clean: Whether the picture is denoised first.

    Returns:
        The modulation transfer, 1 for a grating that is seen as it is shown; the standard error
        is from groups of rows.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    with _target(device, samples, seed):
        pixels = render_layers(device.scene, (DISPLAY_LAYER,))[DISPLAY_LAYER]
    rows = relative_luminance(denoise(pixels) if clean else pixels)
    left = float(np.sinc(1.0 / _PIXELS_A_CYCLE) * np.sinc(1.0 / _DRAWN_A_CYCLE) ** 2)
    groups = rows.reshape(_ROW_GROUPS, -1, _COLUMNS).mean(axis=1)
    each = [modulation(group, _CYCLES) / left for group in groups]
    error = float(np.std(each, ddof=1)) / math.sqrt(_ROW_GROUPS)
    return Estimate(modulation(rows.mean(axis=0), _CYCLES) / left, error)


def grating(half_tangent: float) -> NDArray[np.float32]:
    """Draw a cosine grating in equal angles over a display.

    Args:
        half_tangent: Half the display's width over the focal length of its lens.

    Returns:
        Drive values 0 to 1, shape ``(4, width, 3)``.
    """
    field = 2.0 * math.degrees(math.atan(half_tangent))
    width = math.ceil(field * CYCLES_PER_DEGREE * _DRAWN_A_CYCLE)
    tangent: FloatArray = ((np.arange(width) + 0.5) / width * 2.0 - 1.0) * half_tangent
    angle = np.degrees(np.arctan(tangent))
    wave = 0.5 + 0.5 * np.cos(2.0 * np.pi * CYCLES_PER_DEGREE * angle)
    return np.broadcast_to(wave[None, :, None], (4, width, 3)).astype(np.float32)


@contextlib.contextmanager
def _target(device: DeviceScene, samples: int, seed: int) -> Iterator[None]:
    """Show the grating, switch the room off, and look at the middle of the field."""
    assert device.panel is not None, "a light guide has a display"
    scene, camera = device.scene, device.camera
    shown = picture("grating", grating(field_tangents(device.guide_spec)[0]))
    texture = next(
        node
        for node in device.panel.active_material.node_tree.nodes
        if node.bl_idname == "ShaderNodeTexImage"
    )
    half = math.tan(math.radians(_CYCLES / CYCLES_PER_DEGREE / 2.0))
    groups = (
        (texture, {"image": shown, "extension": "EXTEND"}),
        (device.room, {"hide_render": True}),
        (camera, {"sensor_width": 2.0 * camera.lens * half}),
        (scene.render, size_settings(_COLUMNS, _ROWS)),
        (
            scene.cycles,
            {"pixel_filter_type": "BOX", "filter_width": 1.0, "samples": samples, "seed": seed},
        ),
    )
    try:
        with changed(*groups):
            yield
    finally:
        bpy.data.images.remove(shown)
