# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Hologram: every operator, undone and done again; the menus that offer them."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import bpy
import pytest

from hoe_addon.blender.document.held import document_of
from hoe_addon.model.document import preset_titles
from hoe_addon.ui.ids import Menu, Op
from hoe_addon.ui.operators.add_preset import preset_items
from tests.ui.layouts import Layout
from tests.ui.steps import assert_undone_and_redone, call, done, state

ELEMENTS = {
    Op.ADD_HOLOGRAM: "hologram",
    Op.ADD_SLAB: "slab",
    Op.ADD_DISPLAY: "display",
    Op.ADD_LAMP: "lamp",
    Op.ADD_IDEAL_LENS: "ideal_lens",
    Op.ADD_GLASS: "glass",
    Op.ADD_EYE: "eye",
}
"""Role of what each operator adds at the 3-D cursor."""


@pytest.fixture
def scene(registered: Any) -> Any:
    """An empty scene in millimetres."""
    registered.unit_settings.scale_length = 1e-3
    bpy.ops.ed.undo_push(message="start")
    return registered


@pytest.mark.parametrize("name", ELEMENTS)
def test_element_comes_at_the_cursor(scene: Any, name: str) -> None:
    scene.cursor.location = (1.0, 2.0, 3.0)
    bpy.ops.ed.undo_push(message="cursor")
    before = state()
    done(name)
    item = bpy.context.object
    assert item.select_get()
    assert item.hologram.role == ELEMENTS[name]
    assert tuple(item.matrix_world.translation) == pytest.approx((1.0, 2.0, 3.0))
    front = item.matrix_world.to_3x3() @ item.matrix_world.translation.__class__((0, 0, 1))
    assert tuple(front) == pytest.approx((0.0, -1.0, 0.0), abs=1e-6)
    assert_undone_and_redone(before)


def test_all_elements_make_one_document(scene: Any) -> None:
    for name in ELEMENTS:
        done(name)
    done(Op.ADD_DISPLAY)
    spec = document_of(bpy.context.scene)
    assert sorted(element.name for element in spec.elements) == [
        "Display",
        "Display.001",
        "Hologram",
        "Lamp",
    ]
    assert spec.render.mode == "spectral"
    assert bpy.context.scene.hologram.problem == ""
    assert bpy.context.scene.camera == bpy.context.scene.hologram.eye.camera


def test_redo_panel_properties_count(scene: Any) -> None:
    call(Op.ADD_HOLOGRAM, size_mm=(30.0, 20.0), wavelength_nm=633.0, distance_mm=80.0)
    call(Op.ADD_LAMP, light="LASER", centre_nm=633.0, shape="line", size_mm=(1.0, 50.0))
    call(Op.ADD_DISPLAY, picture="bars", luminance_cd_m2=250.0)
    call(Op.ADD_EYE, pupil_diameter_mm=2.0, field_deg=20.0, at_infinity=False, focus_mm=500.0)
    spec = document_of(scene)
    hologram, lamp = spec.hologram("Hologram").hologram, spec.element("Lamp")
    assert hologram.surface.size_mm == (30.0, 20.0)
    assert hologram.recording.wavelength_nm == 633.0
    assert hologram.recording.object.position_mm == (0.0, 0.0, -80.0)
    assert (lamp.shape, lamp.spectrum.centre_nm) == ("line", 633.0)
    assert spec.element("Display").display.image == "bars"
    assert (spec.eye.pupil_diameter_mm, spec.eye.focus_mm, spec.eye.field_deg) == (2, 500, 20)


@pytest.fixture
def view(scene: Any) -> Iterator[Any]:
    """A 3-D view as the context, as a click in a window has it."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        yield area.spaces.active


def test_alignment_to_the_view(view: Any) -> None:
    preferences = bpy.context.preferences.edit
    preferences.object_align = "VIEW"
    try:
        call(Op.ADD_SLAB)
    finally:
        preferences.object_align = "WORLD"
    found, wanted = bpy.context.object.matrix_world, view.region_3d.view_matrix.inverted()
    turn = found.to_quaternion().rotation_difference(wanted.to_quaternion())
    assert turn.angle < 1e-5


def test_alignment_to_the_view_where_there_is_none(scene: Any) -> None:
    preferences = bpy.context.preferences.edit
    preferences.object_align = "VIEW"
    try:
        done(Op.ADD_SLAB)
    finally:
        preferences.object_align = "WORLD"
    assert bpy.context.object.matrix_world[2][1] == pytest.approx(1.0)


def test_alignment_to_the_cursor(scene: Any) -> None:
    scene.cursor.rotation_euler = (0.2, 0.3, 0.4)
    call(Op.ADD_IDEAL_LENS, align="CURSOR", rotation=(0.0, 0.0, 0.0))
    found = bpy.context.object.matrix_world.to_euler()
    assert tuple(found) == pytest.approx((0.2, 0.3, 0.4), abs=1e-5)


@pytest.mark.parametrize("name", ["point_lens", "two_hologram_ar"])
def test_preset_as_a_scene(view: Any, name: str) -> None:
    before = state()
    mine = bpy.context.scene.name
    done(Op.ADD_PRESET, preset=name, place="SCENE")
    scene = bpy.context.window.scene
    assert scene.name == name
    assert scene.camera.hologram.role == "eye"
    assert document_of(scene).name == name
    assert not bpy.data.scenes[mine].objects
    assert view.region_3d.view_perspective == "CAMERA"
    assert view.clip_end > 1e5
    bpy.ops.ed.undo()
    assert name not in bpy.data.scenes
    assert state() == before


def test_preset_as_a_device(scene: Any) -> None:
    scene.cursor.location = (10.0, 20.0, 30.0)
    bpy.ops.ed.undo_push(message="cursor")
    before = state()
    done(Op.ADD_PRESET, preset="point_lens", place="DEVICE")
    root = bpy.context.object
    assert root.hologram.role == "root"
    assert tuple(root.location) == (10.0, 20.0, 30.0)
    assert_undone_and_redone(before)
    with pytest.raises(RuntimeError, match="holds a device already; delete all of it, or add"):
        call(Op.ADD_PRESET, preset="point_lens", place="DEVICE")


def test_presets_are_listed_by_name(registered: Any) -> None:
    titles = preset_titles()
    assert [name for name, *_ in preset_items()] == list(titles)
    assert [title for _, _, title, _ in preset_items()] == list(titles.values())
    labels = [label for _, label, _, _ in preset_items()]
    assert labels == sorted(labels, key=str.casefold)
    assert "Two Hologram AR" in labels


def test_tooltips_are_words(registered: Any) -> None:
    for name in (*ELEMENTS, Op.ADD_PRESET, Op.HOLOGRAM_ON_FACES, Op.TRUE_SIZE):
        group, _, operator = name.partition(".")
        kind = getattr(getattr(bpy.ops, group), operator).get_rna_type()
        assert len(kind.description) > 20, name
        for prop in kind.properties:
            if prop.identifier != "rna_type":
                assert prop.description, (name, prop.identifier)
            if prop.identifier.endswith(("_mm", "_nm", "_deg", "_cd_m2")):
                assert "(" in prop.name, (name, prop.identifier)


def drawn(menu: Any) -> list[Any]:
    """What a menu shows."""
    layout = Layout()
    menu.draw(SimpleNamespace(layout=layout), bpy.context)
    return layout.calls


def test_menus_offer_everything(registered: Any) -> None:
    top = drawn(bpy.types.HOE_MT_add)
    assert [call.name for call in top if call.kind == "menu"] == [Menu.ADD_SCENE, Menu.ADD_DEVICE]
    offered = {call.name for call in top if call.kind == "operator"}
    assert offered == {*ELEMENTS, Op.HOLOGRAM_ON_FACES}
    assert all(call.options["icon"] != "NONE" for call in top)
    for menu, place in (
        (bpy.types.HOE_MT_add_scene, "SCENE"),
        (bpy.types.HOE_MT_add_device, "DEVICE"),
    ):
        entries = drawn(menu)
        assert [entry.assigned["preset"] for entry in entries] == list(preset_titles())
        assert {entry.assigned["place"] for entry in entries} == {place}


def test_menus_come_and_go(clean_scene: Any) -> None:
    import hoe_addon

    menus = (bpy.types.VIEW3D_MT_add, bpy.types.VIEW3D_MT_edit_mesh_faces)
    before = [len(menu._dyn_ui_initialize()) for menu in menus]
    hoe_addon.register()
    assert [len(menu._dyn_ui_initialize()) for menu in menus] == [count + 1 for count in before]
    assert all(hasattr(bpy.types, menu) for menu in Menu)
    hoe_addon.unregister()
    assert [len(menu._dyn_ui_initialize()) for menu in menus] == before
    assert not any(hasattr(bpy.types, menu) for menu in Menu)


def test_small_things_in_a_large_view_are_shown(view: Any) -> None:
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 1.0
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    scene.cursor.location = (0.1, 0.2, 0.3)
    done(Op.ADD_PRESET, preset="holographic_sight", place="DEVICE")
    root = bpy.context.object
    region = view.region_3d
    assert 0.01 < region.view_distance < 1.0
    assert (region.view_location - root.location).length < 0.5
    assert view.clip_start < 0.01


def test_view_stays_where_something_new_is_seen_well(view: Any) -> None:
    region = view.region_3d
    region.view_perspective, region.view_distance = "PERSP", 100.0
    region.view_location = (0.0, 0.0, 0.0)
    done(Op.ADD_SLAB)
    assert region.view_distance == 100.0
    assert tuple(region.view_location) == (0.0, 0.0, 0.0)


def test_body_around_the_eye_is_told(registered: Any, capfd: pytest.CaptureFixture[str]) -> None:
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    call(Op.ADD_PRESET, preset="holographic_sight", place="DEVICE")
    assert "the eye stands inside Cube: move one of them" in capfd.readouterr().out


def test_new_scene_has_its_hologram_selected(registered: Any) -> None:
    done(Op.ADD_PRESET, preset="holographic_sight", place="SCENE")
    assert bpy.context.object.hologram.role == "hologram"
    done(Op.ADD_PRESET, preset="two_hologram_ar", place="SCENE")
    assert bpy.context.object == bpy.context.scene.hologram.guide.plate
