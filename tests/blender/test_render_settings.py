# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles set up for holograms, whatever a user had set before."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.pictures.render_settings import (
    carry_time_on_rows,
    set_picture,
    set_up,
    write_float_exr,
)

PROMISED = {
    "scene.render.engine": "CYCLES",
    "scene.cycles.shading_system": True,
    "scene.cycles.samples": 24,
    "scene.cycles.seed": 7,
    "scene.cycles.use_animated_seed": False,
    "scene.cycles.use_adaptive_sampling": False,
    "scene.cycles.use_denoising": False,
    "scene.cycles.sample_clamp_direct": 0.0,
    "scene.cycles.sample_clamp_indirect": 0.0,
    "scene.cycles.blur_glossy": 0.0,
    "scene.cycles.light_sampling_threshold": 0.0,
    "scene.cycles.use_light_tree": True,
    "scene.cycles.transparent_max_bounces": 200,
    "scene.cycles.min_transparent_bounces": 200,
    "scene.cycles.rolling_shutter_type": "NONE",
    "scene.cycles.film_exposure": 1.0,
    "scene.cycles.time_limit": 0.0,
    "scene.render.use_motion_blur": True,
    "scene.render.motion_blur_position": "CENTER",
    "scene.render.use_border": False,
    "scene.render.use_compositing": False,
    "scene.render.use_sequencer": False,
    "scene.render.use_multiview": False,
    "scene.render.resolution_percentage": 100,
    "scene.render.pixel_aspect_x": 1.0,
    "scene.render.pixel_aspect_y": 1.0,
}

SPOILED = {
    "scene.render.engine": "BLENDER_WORKBENCH",
    "scene.cycles.shading_system": False,
    "scene.cycles.samples": 1,
    "scene.cycles.seed": 99,
    "scene.cycles.use_animated_seed": True,
    "scene.cycles.use_adaptive_sampling": True,
    "scene.cycles.use_denoising": True,
    "scene.cycles.sample_clamp_direct": 1.0,
    "scene.cycles.sample_clamp_indirect": 1.0,
    "scene.cycles.blur_glossy": 2.0,
    "scene.cycles.light_sampling_threshold": 0.5,
    "scene.cycles.use_light_tree": False,
    "scene.cycles.transparent_max_bounces": 1,
    "scene.cycles.min_transparent_bounces": 0,
    "scene.cycles.rolling_shutter_type": "TOP",
    "scene.cycles.film_exposure": 3.0,
    "scene.cycles.time_limit": 5.0,
    "scene.render.use_motion_blur": False,
    "scene.render.motion_blur_position": "START",
    "scene.render.use_border": True,
    "scene.render.use_compositing": True,
    "scene.render.use_sequencer": True,
    "scene.render.use_multiview": True,
    "scene.render.resolution_percentage": 25,
    "scene.render.pixel_aspect_x": 2.0,
    "scene.render.pixel_aspect_y": 1.5,
}


def place(scene: bpy.types.Scene, path: str) -> tuple[Any, str]:
    _, group, name = path.split(".")
    return getattr(scene, group), name


def found(scene: bpy.types.Scene) -> dict[str, Any]:
    return {path: getattr(*place(scene, path)) for path in PROMISED}


def spoil(scene: bpy.types.Scene) -> None:
    """Change every setting that is promised, and the shutter's curve."""
    for path, value in SPOILED.items():
        setattr(*place(scene, path), value)
    scene.render.motion_blur_shutter = 1.0
    curve = scene.render.motion_blur_shutter_curve
    curve.curves[0].points.new(0.4, 0.1)
    curve.update()


def shutter_values(scene: bpy.types.Scene) -> list[float]:
    mapping = scene.render.motion_blur_shutter_curve
    return [mapping.evaluate(mapping.curves[0], at) for at in np.linspace(0.0, 1.0, 257)]


def prepare(scene: bpy.types.Scene, **changes: Any) -> None:
    set_up(scene, **({"samples": 24, "seed": 7, "spectral": True, "max_bounces": 200} | changes))


def test_every_setting_is_spoiled_before_it_is_mended(clean_scene: bpy.types.Scene) -> None:
    assert SPOILED.keys() == PROMISED.keys()
    spoil(clean_scene)
    before = found(clean_scene)
    assert all(before[path] != PROMISED[path] for path in PROMISED)
    assert min(shutter_values(clean_scene)) < 0.5


def test_settings_are_as_promised_whatever_they_were(clean_scene: bpy.types.Scene) -> None:
    spoil(clean_scene)
    prepare(clean_scene)
    assert found(clean_scene) == PROMISED


def test_shutter_is_short_and_open_all_the_time(clean_scene: bpy.types.Scene) -> None:
    """A flat curve makes ray time uniform; in the short time nothing moves."""
    spoil(clean_scene)
    prepare(clean_scene)
    assert clean_scene.render.motion_blur_shutter == pytest.approx(1e-3)
    np.testing.assert_array_equal(shutter_values(clean_scene), 1.0)


def test_set_up_twice_changes_nothing(clean_scene: bpy.types.Scene) -> None:
    prepare(clean_scene)
    first = found(clean_scene)
    prepare(clean_scene)
    assert found(clean_scene) == first


def test_preview_has_no_motion_blur(clean_scene: bpy.types.Scene) -> None:
    spoil(clean_scene)
    clean_scene.render.use_motion_blur = True
    prepare(clean_scene, spectral=False)
    assert not clean_scene.render.use_motion_blur


@pytest.mark.parametrize(("asked", "set_to"), [(1, 1), (1024, 1024), (5000, 1024)])
def test_bounces_are_those_that_cycles_can_do(
    clean_scene: bpy.types.Scene, asked: int, set_to: int
) -> None:
    prepare(clean_scene, max_bounces=asked)
    assert clean_scene.cycles.transparent_max_bounces == set_to
    assert clean_scene.cycles.min_transparent_bounces == set_to


def test_picture_size_and_samples(clean_scene: bpy.types.Scene) -> None:
    set_picture(clean_scene, (31, 17), 5)
    assert (clean_scene.render.resolution_x, clean_scene.render.resolution_y) == (31, 17)
    assert clean_scene.cycles.samples == 5


def test_rows_can_carry_the_time(clean_scene: bpy.types.Scene) -> None:
    prepare(clean_scene)
    carry_time_on_rows(clean_scene)
    assert clean_scene.cycles.rolling_shutter_type == "TOP"
    assert clean_scene.cycles.rolling_shutter_duration == 0.0


@pytest.mark.parametrize("layers", [False, True])
def test_output_is_32_bit(clean_scene: bpy.types.Scene, tmp_path: Path, layers: bool) -> None:
    write_float_exr(clean_scene, tmp_path / "out.exr", layers=layers)
    picture = clean_scene.render.image_settings
    assert picture.color_depth == "32"
    assert picture.file_format == ("OPEN_EXR_MULTILAYER" if layers else "OPEN_EXR")
    assert picture.exr_codec == "ZIP"  # without loss
    assert clean_scene.render.filepath == str(tmp_path / "out.exr")
