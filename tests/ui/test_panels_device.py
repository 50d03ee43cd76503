# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels of device, render and study, in scenes of every kind."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.ids import Goal, Primaries, Role
from hoe_addon.core.spectrum import DISPLAY_PRIMARIES
from hoe_addon.model.document import load_device
from hoe_addon.model.field import field_degrees
from hoe_addon.ui.facts.device import in_metres, lines_of
from hoe_addon.ui.facts.scenes import DEVICE_FACTS
from hoe_addon.ui.ids import Menu, Op
from hoe_addon.ui.overlay import state
from hoe_addon.ui.overlay.document import OF_EYE, Kind
from hoe_addon.ui.panels import progress
from tests.ui.layouts import Drawn, draw, own_panels

BODIES = (
    "device",
    "device_display",
    "device_lens",
    "device_guide",
    "device_holograms",
    "device_element",
    "device_eye",
    "device_eyebox",
    "device_room",
)
OF_GUIDES = {f"device_{name}" for name in ("display", "lens", "guide", "holograms", "eyebox")}


@pytest.fixture
def show(registered: Any) -> Callable[[str], Any]:
    """Make a preset, without its room, the scene of the window."""

    def make(name: str) -> Any:
        spec = load_device(name)
        scene = add_scene(replace(spec, room=replace(spec.room, kind="none")))
        bpy.context.window.scene = scene
        DEVICE_FACTS.update_now(scene)
        return scene

    return make


def panel(name: str, place: str = "sidebar") -> Drawn | None:
    return draw(getattr(bpy.types, f"HOE_PT_{name}_{place}"))


def drawn(name: str, place: str = "sidebar") -> Drawn:
    found = panel(name, place)
    assert found is not None, f"{name} is not shown"
    return found


def shown(names: tuple[str, ...] = BODIES) -> set[str]:
    return {name for name in names if panel(name) is not None}


def test_empty_scene_tells_how_to_begin(registered: Any) -> None:
    assert shown() == {"device"}
    begin = drawn("device")
    assert "no device yet" in begin.words()
    assert [call.name for call in begin.of("menu")] == [Menu.ADD]
    assert begin.operators() == [Op.IMPORT_DEVICE]


@pytest.mark.parametrize("place", ["sidebar", "scene"])
def test_light_guide_in_both_places(show: Callable[[str], Any], place: str) -> None:
    show("two_hologram_ar")
    for name in BODIES:
        assert (panel(name, place) is not None) == (name != "device_element")
    words = drawn("device", place).words()
    assert "19° x 10.7°" in words
    assert "18 mm" in words
    assert "600 cd/m²" in words
    assert not any(call.alert for call in drawn("device", place).calls)


def test_scene_shows_nothing_of_light_guides(show: Callable[[str], Any]) -> None:
    show("hud_combiner")
    assert not shown() & OF_GUIDES
    assert {"device", "device_eye", "device_room"} <= shown()
    assert "10 m, -0.10 D" in drawn("device").words()


@pytest.mark.parametrize(
    ("preset", "role", "property_name"),
    [
        ("hud_combiner", Role.DISPLAY, "primaries"),
        ("grating_rainbow", Role.LAMP, "luminance_cd_m2"),
        ("diffractive_achromat", Role.CARD, "picture"),
    ],
)
def test_selected_element_has_its_own_fields(
    show: Callable[[str], Any], preset: str, role: Role, property_name: str
) -> None:
    scene = show(preset)
    found = [item for item in scene.objects if item.hologram.role == role]
    bpy.context.view_layer.objects.active = found[0]
    assert property_name in drawn("device_element").properties()
    assert found[0].name in drawn("device_element").words()
    bpy.context.view_layer.objects.active = scene.camera
    assert panel("device_element") is None


def test_scene_without_an_eye_offers_one(registered: Any) -> None:
    bpy.ops.hologram.add_lamp()
    scene = bpy.context.scene
    assert DEVICE_FACTS.update_now(scene).lines == ()
    begin = drawn("device")
    assert "no eye yet" in begin.words()
    assert Op.ADD_EYE in begin.operators()
    assert Op.LOOK_THROUGH_EYE not in begin.operators()
    assert panel("device_eye") is None
    assert not state.kinds_of(scene) & OF_EYE
    bpy.ops.hologram.add_eye()
    assert DEVICE_FACTS.update_now(scene).lines
    assert Op.ADD_EYE not in drawn("device").operators()
    assert panel("device_eye") is not None
    assert state.kinds_of(scene) >= {Kind.PUPIL, Kind.CHIEF_RAYS}


def test_primaries_are_chosen_from_a_menu(show: Callable[[str], Any]) -> None:
    display = show("two_hologram_ar").hologram.engine.display
    assert display.kind_of_primaries == Primaries.LED
    assert "primaries" not in drawn("device_display").properties()
    display.kind_of_primaries = Primaries.LASER
    assert display.primaries == "laser_rgb"
    display.kind_of_primaries = Primaries.OWN
    lines = display.to_document()["primaries"]
    assert lines[0] == {"centre_nm": 625.0, "fwhm_nm": 1.0}
    assert display.kind_of_primaries == Primaries.OWN
    assert "primaries" in drawn("device_display").properties()


def test_every_set_of_primaries_is_in_the_menu() -> None:
    assert set(Primaries) - {Primaries.OWN} == DISPLAY_PRIMARIES.keys()


def test_lengths_carry_mm_in_scenes_of_any_unit(show: Callable[[str], Any]) -> None:
    show("two_hologram_ar")
    for name in ("device_lens", "device_guide", "device_eye"):
        assert "mm" in [call.name for call in drawn(name).of("label")]
    lengths = [
        prop
        for kind in bpy.types.PropertyGroup.__subclasses__()
        if kind.__name__.startswith("HOE_PG_")
        for prop in kind.bl_rna.properties
        if prop.identifier.endswith("_mm")
    ]
    assert lengths
    # A unit of Blender's would show 10 as 10 m where a scene is in metres.
    assert {prop.unit for prop in lengths} == {"NONE"}


def test_only_the_fields_that_count(show: Callable[[str], Any]) -> None:
    scene = show("two_hologram_ar")
    eye, display = scene.hologram.eye, scene.hologram.engine.display
    assert "focus_mm" not in drawn("device_eye").properties()
    eye.at_infinity = False
    assert "focus_mm" in drawn("device_eye").properties()
    assert "image" not in drawn("device_display").properties()
    display.picture = "image"
    assert "image" in drawn("device_display").properties()


def test_list_of_holograms(show: Callable[[str], Any]) -> None:
    scene = show("two_hologram_ar")
    words = drawn("device_holograms").words()
    assert "in_coupler" in words
    assert words.count("eye side") == 2
    assert drawn("device_holograms").operators() == [Op.ADD_PATCH, Op.REMOVE_PATCH]
    for place in (0, 1):
        scene.hologram.active_patch = place
        owners = {call.owner for call in drawn("device_holograms").of("prop")}
        assert scene.hologram.patches[place] in owners
    scene.hologram.patches.clear()
    assert "face" not in drawn("device_holograms").properties()


def test_problem_stands_in_the_panel(show: Callable[[str], Any]) -> None:
    scene = show("two_hologram_ar")
    scene.hologram.patches[1].center_mm = (100.0, 0.0)
    facts = DEVICE_FACTS.update_now(scene)
    assert "holograms[1] (out_coupler).center_mm" in facts.problem
    alerts = [call.name for call in drawn("device").calls if call.alert]
    assert "must keep the patch" in " ".join(alerts)
    assert "center_mm" not in " ".join(alerts)
    marked = {name for name in BODIES if _is_marked(name)}
    assert marked == {"device_holograms"}


def test_problem_of_a_hologram_is_only_pointed_to(show: Callable[[str], Any]) -> None:
    scene = show("holographic_sight")
    scene.objects["window"].active_material.hologram.recording.object.follows = True
    DEVICE_FACTS.update_now(scene)
    words = drawn("device").words()
    assert "Problem in the Recording of window" in words
    assert "target" not in words


def _is_marked(name: str) -> bool:
    found = panel(name)
    icons = [call.options.get("icon") for call in found.calls] if found is not None else []
    return icons[:1] == ["ERROR"]


def test_drawing_computes_nothing(
    show: Callable[[str], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A panel that is drawn before its facts are there shows none, and asks for them."""
    scene = show("two_hologram_ar")
    DEVICE_FACTS._forget()
    monkeypatch.setattr(DEVICE_FACTS, "_work_out", lambda _: pytest.fail("worked out in draw"))
    drawn("device")
    assert scene.session_uid in DEVICE_FACTS._wanted


@pytest.mark.parametrize("preset", ["two_hologram_ar", "point_lens"])
def test_panel_does_not_grow_when_its_facts_come(show: Callable[[str], Any], preset: str) -> None:
    """Blender draws the panels below one that has grown over it, for one redraw."""
    scene = show(preset)
    DEVICE_FACTS._forget()
    before = len(drawn("device").of("label"))
    DEVICE_FACTS.update_now(scene)
    assert len(drawn("device").of("label")) == before


def test_facts_follow_object_and_settings(show: Callable[[str], Any]) -> None:
    """The place of the eye and the size of the picture note no change of their own."""
    scene = show("two_hologram_ar")
    scene.render.resolution_x = 320
    scene.camera.location.z += 1.0
    bpy.context.view_layer.update()
    DEVICE_FACTS._compare_stamps()
    DEVICE_FACTS._catch_up()
    assert "19 mm" in drawn("device").words()
    assert "320 x 480 px" in drawn("device").words()


def test_lines_are_those_of_the_model() -> None:
    spec = load_device("three_hologram_ar")
    lines = {line.label: line.value for line in lines_of(spec)}
    across, up = field_degrees(spec)
    assert lines["Field of View"] == f"{across:.3g}° x {up:.3g}°"


@pytest.mark.parametrize(
    ("metres", "words"),
    [
        (0.25, "250 mm, -4.00 D"),
        (10.0, "10 m, -0.10 D"),
        (-2.0, "-2 m, +0.50 D"),
        (2e3, "at infinity"),
    ],
)
def test_distances_of_images(metres: float, words: str) -> None:
    assert in_metres(metres) == words


def test_virtual_image_of_the_sight_is_at_its_design(show: Callable[[str], Any]) -> None:
    show("holographic_sight")
    assert "50.2 m" in drawn("device").words()


def test_no_render_panel_without_a_device(registered: Any) -> None:
    for name in ("render", "study"):
        assert panel(name) is None


@pytest.mark.parametrize(
    ("goal", "own"),
    [
        (Goal.QUALITY, {"quality"}),
        (Goal.ERROR, {"error", "ends_in_time", "seconds"}),
        (Goal.SECONDS, {"seconds"}),
        (Goal.SAMPLES, {"samples"}),
    ],
)
def test_render_shows_the_number_of_its_goal(
    show: Callable[[str], Any], goal: Goal, own: set[str]
) -> None:
    scene = show("point_lens")
    scene.hologram.render.goal = goal
    numbers = {"quality", "error", "ends_in_time", "seconds", "samples"}
    assert numbers & set(drawn("render").properties()) == own
    assert Op.RENDER in drawn("render", "render").operators()


def test_quality_says_its_error(show: Callable[[str], Any]) -> None:
    scene = show("point_lens")
    scene.hologram.render.goal, scene.hologram.render.quality = Goal.QUALITY, "final"
    assert "pixel error 10 %" in drawn("render").words()


def test_running_job_has_progress_and_cancel(
    show: Callable[[str], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    show("point_lens")
    job = SimpleNamespace(words="Render: 42 %, error 0.08 so far", share=0.42)
    monkeypatch.setattr(progress, "running", lambda context: job)
    for name in ("render", "study"):
        found = drawn(name)
        assert [call.options["factor"] for call in found.of("progress")] == [0.42]
        assert "error 0.08 so far" in found.words()
        assert Op.CANCEL in found.operators()
        assert Op.RENDER not in found.operators()


def test_subpanels_are_closed_at_first(registered: Any) -> None:
    parts = [each for each in own_panels() if getattr(each, "bl_parent_id", "").startswith("HOE_")]
    assert parts
    assert all("DEFAULT_CLOSED" in each.bl_options for each in parts)
