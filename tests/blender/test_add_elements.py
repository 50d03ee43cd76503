# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Single elements: what they make of the scene, and that they fail whole."""

import math
from typing import Any

import bpy
import pytest

from hoe_addon.blender.add import bodies, elements, emitters, eye, hologram
from hoe_addon.blender.api import document_of
from hoe_addon.blender.units import in_millimetres
from hoe_addon.core.errors import HoeError
from hoe_addon.model.surface import PlaneSurface


@pytest.fixture
def scene(registered: Any) -> Any:
    """An empty scene in millimetres."""
    registered.unit_settings.scale_length = 1e-3
    return registered


def test_empty_scene_gets_millimetres(scene: Any) -> None:
    scene.unit_settings.scale_length = 1.0
    _, changed = hologram.add_hologram(scene)
    assert in_millimetres(scene)
    assert changed[-1] == "Units"


def test_preview_until_there_is_an_eye(scene: Any) -> None:
    hologram.add_hologram(scene)
    held = scene.hologram
    assert (held.kind, held.render.mode) == ("scene", "preview")
    assert not scene.render.use_motion_blur
    item, _ = eye.give_eye(scene)
    assert held.render.mode == "spectral"
    assert scene.render.use_motion_blur
    assert scene.camera == item
    assert [child.hologram.role for child in item.children] == ["filter"]
    with pytest.raises(HoeError, match="has an eye already, Eye; move it, or delete it first"):
        eye.give_eye(scene)


def test_eye_comes_first(scene: Any) -> None:
    item, _ = eye.give_eye(scene)
    kinds = {node.bl_idname for node in scene.hologram.wavelength.nodes}
    assert "ShaderNodeScript" in kinds, "wavelengths are drawn"
    emitters.add_display(scene, matrix=elements.upright((0.0, 100.0, 0.0)))
    spec = document_of(scene)
    assert [element.name for element in spec.elements] == ["Display"]
    assert spec.elements[0].position_mm == pytest.approx((0.0, 0.0, -100.0), abs=1e-5)
    assert [child.hologram.role for child in item.children] == ["filter"]
    groups = [group.name for group in bpy.data.node_groups]
    assert groups == [scene.hologram.wavelength.name]


def test_a_new_eye_after_the_old_one_is_deleted(scene: Any) -> None:
    emitters.add_display(scene)
    for _ in range(2):
        item, _ = eye.give_eye(scene)
        assert document_of(scene).eye.pupil_diameter_mm == 4.0
        for child in [*item.children, item]:
            bpy.data.objects.remove(child)


def test_camera_of_the_user_stays(scene: Any) -> None:
    mine = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    scene.collection.objects.link(mine)
    scene.camera = mine
    eye.give_eye(scene)
    assert scene.camera == mine


def test_settings_of_the_user_stay(scene: Any) -> None:
    scene.cycles.samples, scene.cycles.seed = 77, 5
    scene.render.resolution_percentage = 50
    scene.view_settings.exposure = 1.5
    scene.view_settings.view_transform = "AgX"
    _, changed = hologram.add_hologram(scene)
    assert (scene.cycles.samples, scene.cycles.seed) == (77, 5)
    assert scene.render.resolution_percentage == 50
    assert (scene.view_settings.exposure, scene.view_settings.view_transform) == (1.5, "AgX")
    assert scene.render.engine == "CYCLES"
    assert "Open Shading Language" in changed
    _, changed = emitters.add_display(scene)
    assert changed == ()


def blocks() -> list[str]:
    """Every datablock of the file."""
    kinds = [prop for prop in bpy.data.bl_rna.properties if prop.type == "COLLECTION"]
    return [repr(block) for kind in kinds for block in getattr(bpy.data, kind.identifier)]


def test_a_failure_leaves_nothing(scene: Any) -> None:
    before, engine = blocks(), scene.render.engine
    spec = emitters.plain_display("missing.png")
    with pytest.raises(HoeError, match="missing"):
        emitters.add_display(scene, spec)
    assert blocks() == before
    assert scene.hologram.kind == "none"
    assert scene.render.engine == engine
    emitters.add_display(scene)


def cube(size: float = 20.0) -> Any:
    bpy.ops.mesh.primitive_cube_add(size=size)
    return bpy.context.object


def test_holograms_stay_where_the_rest_becomes_glass(scene: Any) -> None:
    item = cube()
    hologram.hologram_on_faces(scene, item, [0])
    bodies.make_glass(scene, [item], "PMMA")
    assert [slot.material.hologram.enabled for slot in item.material_slots] == [False, True]
    bodies.make_glass(scene, [item], "N-BK7")
    assert elements.facts_of(item) == {"medium": "N-BK7"}


@pytest.mark.parametrize("shape", ["prism", "ball"])
def test_glass_is_a_closed_body(scene: Any, shape: str) -> None:
    item, _ = bodies.add_glass(scene, shape, 30.0)
    bodies.make_glass(scene, [item], "PMMA")
    assert elements.facts_of(item) == {"medium": "PMMA"}


@pytest.mark.parametrize("spoil", ["open", "inside out"])
def test_glass_must_be_a_closed_body(scene: Any, spoil: str) -> None:
    item = cube()
    if spoil == "open":
        bpy.ops.mesh.primitive_plane_add()
        item = bpy.context.object
    else:
        item.data.flip_normals()
    with pytest.raises(HoeError, match="must be a closed body with its normals outside"):
        bodies.make_glass(scene, [item])
    assert scene.hologram.kind == "none"


def test_what_is_something_else_is_no_glass(scene: Any) -> None:
    item, _ = bodies.add_slab(scene)
    with pytest.raises(HoeError, match="object Slab: is a light-guide slab already"):
        bodies.make_glass(scene, [item])


@pytest.mark.parametrize("focal", [0.0, math.nan, math.inf])
def test_no_lens(scene: Any, focal: float) -> None:
    with pytest.raises(HoeError, match="focal length: must be a length other than 0 mm"):
        bodies.add_ideal_lens(scene, focal)


def test_elements_hang_on_the_device(scene: Any) -> None:
    item, _ = hologram.add_hologram(scene, matrix=elements.upright((1.0, 2.0, 3.0)))
    bpy.context.view_layer.update()
    assert tuple(item.matrix_world.translation) == pytest.approx((1.0, 2.0, 3.0))
    scene.hologram.root.location = (0.0, 0.0, 10.0)
    bpy.context.view_layer.update()
    assert tuple(item.matrix_world.translation) == pytest.approx((1.0, 2.0, 13.0))


def test_new_elements_come_last(scene: Any) -> None:
    wanted = ["Zero", "Alpha", "Middle"]
    for name in wanted:
        emitters.add_display(scene)[0].name = name
    assert [element.name for element in document_of(scene).elements] == wanted


def test_elements_come_into_their_collection(scene: Any) -> None:
    mine = bpy.data.collections.new("Mine")
    scene.collection.children.link(mine)
    item, _ = eye.give_eye(scene, collection=mine)
    for part in (item, *item.children):
        assert part.users_collection == (mine,)


def test_plain_hologram_takes_its_numbers() -> None:
    spec = hologram.plain_hologram(
        PlaneSurface(size_mm=(5.0, 6.0)), wavelength_nm=633.0, distance_mm=50.0
    )
    assert spec.surface.size_mm == (5.0, 6.0)
    assert spec.efficiency.design_wavelength_nm == spec.recording.wavelength_nm == 633.0
    wave = spec.recording.object
    assert (wave.position_mm, wave.beam) == ((0.0, 0.0, -50.0), "converging")
    assert spec.orders == (0, 1)
