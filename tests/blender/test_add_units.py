# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene in metres becomes one in millimetres, and its picture stays."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.ids import Role
from hoe_addon.blender.units import in_millimetres, scale_to_millimetres
from hoe_addon.core.errors import HoeError

SIDE = 32
SAME = 1e-4
"""Rounding of float32 at other lengths, 3e-6 measured; a shadow of wrong softness gives 1e-2."""


@pytest.fixture
def startup(registered: Any) -> Any:
    """Blender's own start-up scene: a cube, a lamp, a camera, in metres."""
    bpy.ops.wm.read_factory_settings()
    return bpy.context.scene


def picture(scene: Any, folder: Path) -> Any:
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(folder / "view.exr")
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(str(folder / "view.exr"))
    pixels = np.array(image.pixels[:]).reshape(SIDE, SIDE, 4)[..., :3]
    bpy.data.images.remove(image)
    return pixels


def furnish(scene: Any) -> None:
    """Lamps of all kinds, two of them on a parent, and a lens that blurs."""
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -1))
    bpy.data.objects["Light"].data.shadow_soft_size = 1.0
    for place, kind in enumerate(("AREA", "SPOT", "SUN")):
        data = bpy.data.lights.new(kind, kind)
        data.energy = 1.0 if kind == "SUN" else 200.0
        item = bpy.data.objects.new(kind, data)
        item.location = (place - 1.0, -2.0, 4.0)
        scene.collection.objects.link(item)
        item.parent = bpy.data.objects["Cube"] if kind != "SUN" else None
    camera = scene.camera.data
    camera.dof.use_dof, camera.dof.focus_distance = True, 8.0
    camera.dof.aperture_fstop = 0.1


@pytest.mark.render
def test_picture_stays(startup: Any, tmp_path: Path) -> None:
    furnish(startup)
    before = picture(startup, tmp_path)
    assert not in_millimetres(startup)
    assert scale_to_millimetres(startup) == ()
    assert in_millimetres(startup)
    after = picture(startup, tmp_path)
    assert np.abs(after - before).mean() < SAME * before.mean() + 1e-9
    assert before.mean() > 0.05


def test_lengths_and_keyframes(startup: Any) -> None:
    cube, lamp = bpy.data.objects["Cube"], bpy.data.objects["Light"]
    cube.keyframe_insert("location", frame=1)
    cube.location.x = 2.0
    cube.keyframe_insert("location", frame=11)
    energy = lamp.data.energy
    tree = startup.world.node_tree
    fog = tree.nodes.new("ShaderNodeVolumeScatter").inputs["Density"]
    fog.default_value = 0.02
    scale_to_millimetres(startup)
    startup.frame_set(6)
    assert cube.location.x == pytest.approx(1000.0)
    assert tuple(cube.scale) == pytest.approx((1000.0,) * 3)
    assert lamp.data.energy == pytest.approx(energy * 1e6)
    assert startup.camera.data.clip_end == pytest.approx(100e3)
    assert fog.default_value == pytest.approx(0.02e-3)


def test_what_is_ours_stays(startup: Any) -> None:
    item = bpy.data.objects.new("display", None)
    item.hologram.role = Role.DISPLAY
    item.location = (1.0, 2.0, 3.0)
    startup.collection.objects.link(item)
    scale_to_millimetres(startup)
    assert tuple(item.location) == (1.0, 2.0, 3.0)
    assert tuple(item.scale) == (1.0, 1.0, 1.0)


def test_twice_is_once(startup: Any) -> None:
    scale_to_millimetres(startup)
    place = tuple(bpy.data.objects["Camera"].location)
    scale_to_millimetres(startup)
    assert tuple(bpy.data.objects["Camera"].location) == place


def test_object_of_two_scenes_is_refused(startup: Any) -> None:
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(bpy.data.objects["Cube"])
    with pytest.raises(HoeError, match="object Cube: stands in scene Other too"):
        scale_to_millimetres(startup)
    assert tuple(bpy.data.objects["Camera"].scale) == (1.0, 1.0, 1.0)


def test_own_object_on_a_foreign_parent_is_refused(startup: Any) -> None:
    item = bpy.data.objects.new("eye", None)
    item.hologram.role, item.parent = Role.EYE, bpy.data.objects["Cube"]
    startup.collection.objects.link(item)
    with pytest.raises(HoeError, match="object eye: hangs on Cube"):
        scale_to_millimetres(startup)


def test_what_cannot_be_scaled_is_told(startup: Any) -> None:
    cube = bpy.data.objects["Cube"]
    cube.constraints.new("LIMIT_LOCATION")
    tree = cube.active_material.node_tree
    bump, value = tree.nodes.new("ShaderNodeBump"), tree.nodes.new("ShaderNodeValue")
    tree.links.new(value.outputs[0], bump.inputs["Distance"])
    notes = scale_to_millimetres(startup)
    assert "Cube: constraint Limit Location has lengths" in notes
    assert "Material: Distance of Bump comes from another node" in notes
