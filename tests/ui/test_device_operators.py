# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators of devices: holograms on a plate, the view through the eye, documents."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.build.guide import FIRST_PATCH
from hoe_addon.blender.document import remake
from hoe_addon.blender.document.chosen_effects import choose
from hoe_addon.blender.document.held import document_of
from hoe_addon.core.errors import HoeError
from hoe_addon.model.default_patch import default_patch
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.document import load_device, to_document
from hoe_addon.model.effects import plan_effects

CLOSE = 1e-6
"""Relative; properties are float32."""


@pytest.fixture
def show(registered: Any) -> Callable[[str], Any]:
    """Make a preset, without its room, the scene of the window."""

    def make(name: str) -> Any:
        spec = load_device(name)
        scene = add_scene(replace(spec, room=replace(spec.room, kind="none")))
        bpy.context.window.scene = scene
        return scene

    return make


@pytest.fixture
def guide(show: Callable[[str], Any]) -> Any:
    """A light guide with two holograms."""
    return show("two_hologram_ar")


def names(scene: Any) -> list[str]:
    return [patch.name for patch in scene.hologram.patches]


def plate_slots(scene: Any) -> list[str]:
    slots = scene.hologram.guide.plate.material_slots
    return [slot.material.name for slot in slots][FIRST_PATCH:]


def test_added_hologram_is_the_grating_of_the_in_coupler(guide: Any) -> None:
    assert bpy.ops.hologram.add_patch(purpose="out") == {"FINISHED"}
    assert names(guide) == ["in_coupler", "out_coupler", "out_coupler_2"]
    assert guide.hologram.active_patch == 2
    spec = document_of(guide)
    assert isinstance(spec, LightGuideSpec)
    old, new = (to_document(spec.patch(name))["recording"] for name in names(guide)[1:])
    for role in ("object", "reference"):
        assert new[role]["direction"] == pytest.approx(old[role]["direction"], rel=CLOSE)
        assert new[role]["index"] == old[role]["index"]
    assert len(plate_slots(guide)) == 3


def test_added_hologram_lies_on_its_face_of_the_plate(guide: Any) -> None:
    bpy.ops.hologram.add_patch(purpose="out")
    patch, plate = guide.hologram.patches[2], guide.hologram.guide.plate
    own = [face for face in plate.data.polygons if face.material_index == FIRST_PATCH + 2]
    assert sum(face.area for face in own) == pytest.approx(
        patch.size_mm[0] * patch.size_mm[1], rel=CLOSE
    )
    assert plate.material_slots[FIRST_PATCH + 2].material == patch.material


@pytest.mark.parametrize("preset", ["two_hologram_ar", "three_hologram_ar"])
@pytest.mark.parametrize("purpose", ["in", "out"])
def test_default_hologram_fits(preset: str, purpose: Any) -> None:
    spec = load_device(preset)
    assert isinstance(spec, LightGuideSpec)
    made = default_patch(spec, purpose)
    larger = replace(spec, holograms=(*spec.holograms, made))
    assert larger.patch(made.name) == made


def test_in_coupler_can_be_added_twice(guide: Any) -> None:
    for _ in range(2):
        assert bpy.ops.hologram.add_patch(purpose="in") == {"FINISHED"}
    assert names(guide)[2:] == ["in_coupler_2", "in_coupler_3"]
    document_of(guide)


@pytest.mark.slow
def test_full_plate_takes_no_more(guide: Any) -> None:
    with pytest.raises(RuntimeError, match="must leave a free place"):
        for _ in range(40):
            bpy.ops.hologram.add_patch(purpose="out")
    assert names(guide)[:2] == ["in_coupler", "out_coupler"]
    assert len(names(guide)) == len(plate_slots(guide)) > 3
    document_of(guide)


def test_hologram_is_removed(guide: Any) -> None:
    bpy.ops.hologram.add_patch(purpose="out")
    guide.hologram.active_patch = 1
    assert bpy.ops.hologram.remove_patch() == {"FINISHED"}
    assert names(guide) == ["in_coupler", "out_coupler_2"]
    assert len(plate_slots(guide)) == 2
    assert "in_coupler" in plate_slots(guide)[0]
    document_of(guide)


def test_hologram_under_the_display_stays(guide: Any) -> None:
    guide.hologram.active_patch = 0
    with pytest.raises(RuntimeError, match="choose another In-Coupler first"):
        bpy.ops.hologram.remove_patch()
    assert names(guide) == ["in_coupler", "out_coupler"]


def entries(scene: Any) -> list[tuple[Any, ...]]:
    return [(patch.to_document(), patch.material) for patch in scene.hologram.patches]


def test_removal_that_is_refused_changes_nothing(show: Callable[[str], Any]) -> None:
    scene = show("three_hologram_ar")
    choose(scene, "haze", "expander", on=True)
    scene.hologram.patches[2].center_mm[0] = 1e4
    before, slots = entries(scene), plate_slots(scene)
    scene.hologram.active_patch = 1
    with pytest.raises(RuntimeError, match="must keep the patch on the guide"):
        bpy.ops.hologram.remove_patch()
    assert entries(scene) == before
    assert plate_slots(scene) == slots
    assert scene.hologram.active_patch == 1
    assert [entry.name for entry in scene.hologram.render.effects] == ["expander:+haze"]
    assert "must keep the patch on the guide" in scene.hologram.problem


def test_adding_that_fails_changes_nothing(guide: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    before, slots, materials = entries(guide), plate_slots(guide), set(bpy.data.materials)
    faces = len(guide.hologram.guide.plate.data.polygons)
    refresh = remake.refresh

    def refresh_the_old_ones(material: Any) -> None:
        if material not in materials:
            raise HoeError("no shader")
        refresh(material)

    monkeypatch.setattr(remake, "refresh", refresh_the_old_ones)
    with pytest.raises(RuntimeError, match="no shader"):
        bpy.ops.hologram.add_patch(purpose="out")
    assert entries(guide) == before
    assert plate_slots(guide) == slots
    assert set(bpy.data.materials) == materials
    assert len(guide.hologram.guide.plate.data.polygons) == faces
    assert guide.hologram.problem == ""


def test_choices_for_a_hologram_go_with_it(show: Callable[[str], Any]) -> None:
    scene = show("three_hologram_ar")
    for hologram in ("", "expander", "out_coupler"):
        choose(scene, "haze", hologram, on=True)
    scene.hologram.active_patch = 2
    bpy.ops.hologram.remove_patch()
    assert [entry.name for entry in scene.hologram.render.effects] == ["+haze", "expander:+haze"]
    plan_effects(document_of(scene))


def test_undo_and_redo_of_holograms(guide: Any) -> None:
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.hologram.add_patch(purpose="out")
    bpy.ops.ed.undo_push(message="add")
    bpy.ops.ed.undo()
    scene = bpy.context.window.scene
    assert names(scene) == ["in_coupler", "out_coupler"]
    assert len(plate_slots(scene)) == 2
    bpy.ops.ed.redo()
    scene = bpy.context.window.scene
    assert len(names(scene)) == len(plate_slots(scene)) == 3
    document_of(scene)


def test_chosen_hologram_is_the_active_material(guide: Any) -> None:
    """So the panels of the material show it."""
    plate = guide.hologram.guide.plate
    for place in (1, 0):
        guide.hologram.active_patch = place
        assert bpy.context.view_layer.objects.active == plate
        assert plate.active_material == guide.hologram.patches[place].material


def test_holograms_of_a_plate_need_a_plate(show: Callable[[str], Any]) -> None:
    show("point_lens")
    for operator in (bpy.ops.hologram.add_patch, bpy.ops.hologram.remove_patch):
        with pytest.raises(RuntimeError, match="has no light guide"):
            operator()


def test_look_through_the_eye(guide: Any) -> None:
    eye = guide.camera
    guide.camera = None
    assert bpy.ops.hologram.look_through_eye() == {"FINISHED"}
    assert guide.camera == eye


def test_look_without_an_eye(registered: Any) -> None:
    with pytest.raises(RuntimeError, match="has no eye"):
        bpy.ops.hologram.look_through_eye()


def test_deleted_eye_is_told(guide: Any) -> None:
    guide.camera.users_collection[0].objects.unlink(guide.camera)
    with pytest.raises(RuntimeError, match="Add > Hologram > Eye"):
        bpy.ops.hologram.look_through_eye()


def test_device_goes_out_and_comes_back(guide: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    guide.hologram.title = "Mine"
    assert bpy.ops.hologram.export_device(filepath=str(path)) == {"FINISHED"}
    assert json.loads(path.read_text(encoding="utf-8"))["title"] == "Mine"
    assert load_device(path) == document_of(guide)
    assert bpy.ops.hologram.import_device(filepath=str(path)) == {"FINISHED"}
    scene = bpy.context.window.scene
    assert scene != guide
    assert document_of(scene) == document_of(guide)


def test_import_tells_file_field_and_value(registered: Any, tmp_path: Path) -> None:
    document = to_document(load_device("point_lens"))
    document["eye"]["field_deg"] = 200
    path = tmp_path / "broken.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    scenes = len(bpy.data.scenes)
    with pytest.raises(RuntimeError, match=r"broken\.json: eye\.field_deg: must be .*200"):
        bpy.ops.hologram.import_device(filepath=str(path))
    assert len(bpy.data.scenes) == scenes


def test_export_needs_a_device_and_a_folder(
    registered: Any, show: Callable[[str], Any], tmp_path: Path
) -> None:
    with pytest.raises(RuntimeError, match="holds no device"):
        bpy.ops.hologram.export_device(filepath=str(tmp_path / "none.json"))
    show("point_lens")
    with pytest.raises(RuntimeError, match="cannot be written"):
        bpy.ops.hologram.export_device(filepath=str(tmp_path / "no" / "folder.json"))
