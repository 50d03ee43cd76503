# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two-hologram device in Cycles: where its picture is, how bright, and that it is clean."""

import json
from pathlib import Path

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.view import DISPLAY_LAYER
from hoe_addon.cli import main
from hoe_addon.model.document import find_device, load_device
from hoe_addon.model.field import field_mask
from hoe_addon.shading.pictures import dot_centres

pytestmark = pytest.mark.render

PRESET = "two_hologram_ar"

FEATURE_DEG = 0.02
"""The error that the device may have; a pixel of this test's picture is 0.031 degrees wide."""


def _device(scene: bpy.types.Scene, *changes: str) -> DeviceScene:
    spec = load_device(PRESET, changes)
    return build_device(scene, spec, find_device(PRESET).parent)


@pytest.mark.parametrize(
    "wavelength_nm",
    [pytest.param(460, marks=pytest.mark.slow), 532, pytest.param(630, marks=pytest.mark.slow)],
)
def test_features_appear_at_the_angle_that_the_display_gives_them(
    clean_scene: bpy.types.Scene, wavelength_nm: float
) -> None:
    """Dots of the display, found in the picture at one wavelength."""
    width, height, field_deg = 640, 360, 20.0
    device = _device(
        clean_scene,
        "room.kind=none",
        "display.image=dots",
        "render.mode=preview",
        f"render.preview_wavelength_nm={wavelength_nm}",
        f"render.size=[{width},{height}]",
        "render.samples=24",
        f"eye.field_deg={field_deg}",
    )
    picture = render_layers(device.scene, (DISPLAY_LAYER,))[DISPLAY_LAYER].sum(axis=2)
    pixel = 2.0 * np.tan(np.radians(field_deg) / 2.0) / width
    spec = device.spec
    expected = dot_centres() * np.asarray(spec.display.size_mm) / spec.lens.focal_length_mm
    errors = []
    for tangent_x, tangent_y in expected:
        column, row = tangent_x / pixel + width / 2.0, height / 2.0 - tangent_y / pixel
        reach = 8
        left, top = round(column) - reach, round(row) - reach
        if min(left, top) < 0 or left + 2 * reach > width or top + 2 * reach > height:
            continue
        window = picture[top : top + 2 * reach, left : left + 2 * reach]
        if window.sum() < 0.1 * picture.sum() / len(expected):
            continue  # no pupil of this direction reaches the eye at this wavelength
        steps = np.arange(2 * reach) + 0.5
        found_x = (window.sum(axis=0) @ steps) / window.sum() + left
        found_y = (window.sum(axis=1) @ steps) / window.sum() + top
        errors.append((found_x - column, found_y - row))
    # At 532 nm the plate guides the whole field, so that every dot is there.
    assert len(errors) >= (len(expected) if wavelength_nm == 532 else 15)
    angles = np.degrees(np.hypot(*np.transpose(errors)) * pixel)
    assert angles.max() < FEATURE_DEG


def test_same_seed_same_picture_and_no_bad_numbers(clean_scene: bpy.types.Scene) -> None:
    """Two renders with one seed agree bit for bit; another seed does not."""
    device = _device(clean_scene, "render.size=[48,36]", "render.samples=8")
    layers = (COMBINED, DISPLAY_LAYER)
    first, second = (render_layers(device.scene, layers) for _ in range(2))
    device.scene.cycles.seed = 1
    other = render_layers(device.scene, layers)
    for name in layers:
        assert np.all(np.isfinite(first[name]))
        assert np.array_equal(first[name], second[name])
        assert not np.array_equal(first[name], other[name])


def test_the_picture_is_an_augmented_view(clean_scene: bpy.types.Scene) -> None:
    """Room light and display light are both there, and the display's stays in its field."""
    device = _device(clean_scene, "render.size=[96,72]", "render.samples=32")
    layers = render_layers(device.scene, (COMBINED, DISPLAY_LAYER))
    inside = field_mask(device.spec, 96, 72)
    display, room = layers[DISPLAY_LAYER], layers[COMBINED] - layers[DISPLAY_LAYER]
    assert room.mean() > 0.02
    assert display[inside].mean() > 0.01
    # A pixel filter of 1.5 pixels carries light two pixels over the border.
    wide = np.zeros_like(inside)
    rows, columns = np.nonzero(inside)
    wide[rows.min() - 2 : rows.max() + 3, columns.min() - 2 : columns.max() + 3] = True
    assert np.abs(display[~wide]).sum() < 1e-3 * display[inside].sum()


def test_view_blend_renders_the_same_without_the_add_on(tmp_path: Path) -> None:
    """The .blend carries shaders and pictures: opened alone it gives the EXR's picture."""
    options = ["--size", "48x36", "--samples", "8", "--no-denoise", "--out", str(tmp_path)]
    assert main(["render", PRESET, *options]) == 0
    from hoe_addon.blender.pictures import exr

    shown = exr.read(tmp_path / "view.exr")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "view.blend"))
    assert not hasattr(bpy.types.Material, "hologram")
    again = render_layers(bpy.context.scene, (COMBINED,))[COMBINED]
    np.testing.assert_array_equal(again, shown)
    metrics = json.loads((tmp_path / "metrics.json").read_text())
    assert metrics["samples"] == 8
    assert metrics["picture"]["mean_cd_m2"] > 0.0
