# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects follow the properties of a scene's document, and nothing else is touched."""

import time
from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.document.held import document_of, whole
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.document.live import remember, settle, settle_changed
from hoe_addon.blender.props import changes
from hoe_addon.blender.props.sync import read_spec, refresh_changed
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import load_device

RECOMPILED_S = 0.2
"""A slider whose change compiles a shader may take so long."""

type Build = Callable[[str], bpy.types.Scene]


@pytest.fixture
def build(registered: Any) -> Build:
    def made(name: str) -> bpy.types.Scene:
        spec = load_device(name, ["render.size=[64, 48]"])
        device = build_device(bpy.context.scene, whole(spec), resources.PRESETS_DIR)
        hold(DeviceScene(**{**vars(device), "spec": spec}))
        remember(device.scene)
        return device.scene

    return made


def extent(item: bpy.types.Object) -> np.ndarray:
    corners = np.array([vertex.co for vertex in item.data.vertices])
    return np.stack((corners.min(axis=0), corners.max(axis=0)))


def white_of(item: bpy.types.Object) -> float:
    node = nodes.script_node(item.active_material)
    return nodes.input_socket(node, "white_luminance").default_value


@pytest.mark.parametrize("name", resources.preset_paths())
def test_what_was_just_built_needs_nothing(build: Build, name: str) -> None:
    assert settle(build(name)) == ()


def test_plate_follows_its_properties(build: Build) -> None:
    scene = build("two_hologram_ar")
    held = scene.hologram
    plate, bare = held.guide.plate, held.guide.plate.material_slots[0].material
    patch = held.patches[0]
    before = len(bpy.data.meshes), len(bpy.data.materials)
    slots = {polygon.material_index for polygon in plate.data.polygons}
    held.guide.thickness_mm *= 2.0
    held.guide.relief_mm += 3.0
    patch.size_mm[0] -= 1.0
    assert settle(scene) == ("guide", "engine")
    spec = document_of(scene).guide
    assert extent(plate)[:, 2].tolist() == pytest.approx(
        [spec.face_z_mm("world"), spec.face_z_mm("eye")], rel=1e-6
    )
    assert held.guide.plate == plate
    assert {polygon.material_index for polygon in plate.data.polygons} == slots == {0, 1, 2, 3}
    assert plate.material_slots[0].material == bare
    assert read_spec(patch.material).surface.size_mm == pytest.approx(tuple(patch.size_mm))
    assert patch.material.hologram.frame.origin[2] == pytest.approx(
        spec.face_z_mm(patch.face), rel=1e-6
    )
    assert (len(bpy.data.meshes), len(bpy.data.materials)) == before, "nothing stays behind"
    assert settle(scene) == ()


def test_lens_and_display_follow(build: Build) -> None:
    scene = build("two_hologram_ar")
    engine = scene.hologram.engine
    engine.focal_length_mm += 2.0
    engine.display.size_mm[0] *= 0.5
    assert settle(scene) == ("engine",)
    assert engine.panel.location.z == pytest.approx(engine.focal_length_mm)
    assert np.diff(extent(engine.panel)[:, 0]) == pytest.approx(engine.display.size_mm[0])
    assert {child.hologram.role for child in engine.mount.children} == {"part"}


@pytest.mark.parametrize("name", ["two_hologram_ar", "holographic_sight"])
def test_brightness_is_one_number(build: Build, name: str) -> None:
    scene = build(name)
    if scene.hologram.kind == "light_guide":
        item, display = scene.hologram.engine.panel, scene.hologram.engine.display
    else:
        item = next(o for o in scene.objects if o.hologram.role == "display")
        display = item.hologram.display
    material, before = item.active_material, white_of(item)
    display.luminance_cd_m2 *= 2.0
    assert settle(scene) == ("light",)
    assert item.active_material == material
    assert white_of(item) == pytest.approx(2.0 * before)


def test_duplicated_light_has_brightness_of_its_own(build: Build) -> None:
    scene = build("holographic_sight")
    item = next(o for o in scene.objects if o.hologram.role == "display")
    twin = item.copy()
    scene.collection.objects.link(twin)
    twin.hologram.display.luminance_cd_m2 *= 3.0
    before = white_of(item)
    settle(scene)
    assert (white_of(item), white_of(twin)) == pytest.approx((before, 3.0 * before))


def test_pupil_and_field(build: Build) -> None:
    scene = build("holographic_sight")
    eye = scene.hologram.eye
    screen = next(child for child in eye.camera.children if child.hologram.role == "filter")
    wide = extent(screen)[1, 0]
    eye.pupil_diameter_mm *= 2.0
    eye.field_deg *= 1.5
    assert settle(scene) == ("eye",)
    assert extent(screen)[1, 0] > wide
    lens = eye.camera.data.lens
    radius = lens * 1e-3 / (2.0 * eye.camera.data.dof.aperture_fstop)
    assert radius == pytest.approx(eye.pupil_diameter_mm / 2.0, rel=1e-5)


def test_one_wavelength_and_back(build: Build) -> None:
    scene = build("holographic_sight")
    held, groups = scene.hologram, len(bpy.data.node_groups)
    held.render.mode = "preview"
    held.render.preview_wavelength_nm = 600.0
    assert set(settle(scene)) == {"settings", "spectrum", "preview", "eye"}
    assert not scene.render.use_motion_blur
    assert not [c for c in held.eye.camera.children if c.hologram.role == "filter"]
    value = next(n for n in held.wavelength.nodes if n.bl_idname == "ShaderNodeValue")
    assert value.outputs[0].default_value == 600.0
    held.render.mode = "spectral"
    assert set(settle(scene)) == {"settings", "spectrum", "eye"}
    assert scene.render.use_motion_blur
    assert len([c for c in held.eye.camera.children if c.hologram.role == "filter"]) == 1
    assert len(bpy.data.node_groups) == groups, "the old sampling is gone"
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.bl_idname == "ShaderNodeGroup":
                assert node.node_tree == held.wavelength


def test_other_primaries_are_sampled_anew(build: Build) -> None:
    scene = build("two_hologram_ar")
    display = scene.hologram.engine.display
    before = {text.name for text in bpy.data.texts}
    lines = [{"centre_nm": nm, "fwhm_nm": 2.0} for nm in (638, 520, 450)]
    display.primaries = str(lines).replace("'", '"')
    assert settle(scene) == ("spectrum",)
    assert {text.name for text in bpy.data.texts} - before


def test_room_is_exchanged(build: Build) -> None:
    scene = build("two_hologram_ar")
    room = scene.hologram.room
    own = set(scene.objects) - set(room.collection.all_objects)
    room.kind = "road"
    assert settle(scene) == ("room",)
    assert room.world == scene.world is not None
    room.kind = "none"
    settle(scene)
    assert scene.world is None
    assert set(scene.objects) == own


def test_plate_of_a_hologram_follows_its_size(build: Build) -> None:
    scene = build("holographic_sight")
    item = next(o for o in scene.objects if o.hologram.role == "hologram")
    material = item.active_material
    material.hologram.surface.size_mm[0] *= 2.0
    assert settle(scene) == ("shape",)
    assert np.diff(extent(item)[:, 0]) == pytest.approx(material.hologram.surface.size_mm[0])
    assert item.active_material == material


def test_parts_of_a_lens_follow(build: Build) -> None:
    scene = build("diffractive_achromat")
    item = next(o for o in scene.objects if o.hologram.role == "lens")
    place = item.matrix_local.copy()
    item.hologram.details = item.hologram.details.replace('"thickness_mm": ', '"thickness_mm": 1')
    assert "shape" in settle(scene)
    spec = document_of(scene).element(item.name)
    faces = {round(child.location.z, 4) for child in item.children}
    assert faces == {round(spec.vertex_z_mm(face), 4) for face in ("front", "back")}
    assert item.matrix_local == place


def test_problem_is_told_and_goes(build: Build) -> None:
    scene = build("two_hologram_ar")
    held = scene.hologram
    width = held.guide.size_mm[0]
    held.guide.size_mm[0] = 1.0
    with pytest.raises(SpecError):
        settle(scene)
    assert held.problem
    assert extent(held.guide.plate)[1, 0] > 1.0, "the last good plate stays"
    held.guide.size_mm[0] = width
    assert settle(scene) == ()
    assert held.problem == ""


def test_changes_in_a_window_settle_by_themselves(build: Build) -> None:
    scene = build("holographic_sight")
    lamp = next(o for o in scene.objects if o.hologram.role == "display")
    before = white_of(lamp)
    lamp.hologram.display.luminance_cd_m2 *= 2.0
    assert changes.is_waiting()
    settle_changed(frozenset((lamp.session_uid,)))
    assert white_of(lamp) == pytest.approx(2.0 * before)


def test_slider_that_recompiles_is_quick(build: Build) -> None:
    scene = build("two_hologram_ar")
    material = scene.hologram.patches[0].material
    refresh_changed()
    material.hologram.efficiency.model = "kogelnik"
    started = time.process_time()
    refresh_changed()
    settle(scene)
    assert time.process_time() - started < RECOMPILED_S
