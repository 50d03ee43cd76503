# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effects panel: what is simulated and why, and deciding otherwise."""

import time
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document.held import document_of
from hoe_addon.model.document import load_device
from hoe_addon.model.effects import plan_effects
from hoe_addon.model.effects.names import Effect
from hoe_addon.ui.facts import plans
from hoe_addon.ui.facts.effect_words import LABELS, error_words
from hoe_addon.ui.facts.scenes import DEVICE_FACTS
from hoe_addon.ui.ids import Op
from tests.ui.layouts import Drawn, draw

ENDS_WITHIN_S = 60.0
"""A plan takes a second; a loaded machine may take its time."""


def shown(name: str) -> Any:
    """Make a preset, without its room, the scene of the window."""
    spec = load_device(name)
    made = add_scene(replace(spec, room=replace(spec.room, kind="none")))
    bpy.context.window.scene = made
    DEVICE_FACTS.update_now(made)
    return made


@pytest.fixture
def scene(registered: Any) -> Any:
    """The point lens as the scene of the window."""
    return shown("point_lens")


def panel() -> Drawn:
    drawn = draw(bpy.types.HOE_PT_effects_sidebar)
    assert drawn is not None
    return drawn


def switches(drawn: Drawn) -> dict[tuple[str, str], Any]:
    """Buttons of effects, by effect and hologram."""
    return {
        (call.assigned["effect"], call.assigned["hologram"]): call
        for call in drawn.of("operator")
        if call.name == Op.OVERRIDE
    }


def choices(scene: Any) -> list[str]:
    return [entry.name for entry in scene.hologram.render.effects]


def test_every_effect_has_words() -> None:
    assert set(LABELS) == set(Effect)
    assert all(label and words and not words.endswith(".") for label, words in LABELS.values())


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (0.0, "0 %"),
        (5e-5, "below 0.01 %"),
        (0.0312, "3.1 %"),
        (0.998, "100 %"),
        (8.6, "over 100 %"),
    ],
)
def test_errors_in_words(error: float, words: str) -> None:
    assert error_words(error) == words


def test_without_a_device_there_is_no_panel(registered: Any) -> None:
    assert draw(bpy.types.HOE_PT_effects_sidebar) is None
    with pytest.raises(RuntimeError, match="holds no device"):
        bpy.ops.hologram.plan()


def test_before_the_plan_there_is_one_button(scene: Any) -> None:
    drawn = panel()
    assert drawn.operators() == [Op.PLAN]
    assert not drawn.of("label")


def test_plan_shows_all_that_is_there(scene: Any) -> None:
    assert bpy.ops.hologram.plan() == {"FINISHED"}
    drawn = panel()
    plan = plan_effects(document_of(scene), in_full=True)
    present = {(str(each.effect), each.hologram) for each in plan.decisions if each.present}
    assert set(switches(drawn)) == present
    assert "dispersed" in drawn.words()
    assert "changed" not in drawn.words()
    on = {(str(each.effect), each.hologram) for each in plan.decisions if each.present and each.on}
    for key, call in switches(drawn).items():
        assert call.options["icon"] == ("CHECKBOX_HLT" if key in on else "CHECKBOX_DEHLT")
        assert call.assigned["on"] == (key not in on)


def test_what_must_stay_cannot_be_clicked(registered: Any) -> None:
    scene = shown("two_hologram_ar")
    bpy.ops.hologram.plan()
    plan = plan_effects(document_of(scene), in_full=True)
    free = {
        (str(each.effect), each.hologram)
        for each in plan.decisions
        if each.present and each.error_without is not None
    }
    found = switches(panel())
    assert {call.enabled for call in found.values()} == {True, False}
    for key, call in found.items():
        assert call.enabled == (key in free)


def test_one_click_overrides_and_one_goes_back(scene: Any) -> None:
    bpy.ops.hologram.plan()
    assert not choices(scene)
    bpy.ops.hologram.override(effect="wavelength", hologram="lens", on=False)
    assert choices(scene) == ["lens:-wavelength"]
    switch = switches(panel())["wavelength", "lens"]
    assert switch.options["icon"] == "CHECKBOX_DEHLT"
    assert Op.BACK_TO_PLAN in panel().operators()
    assert "efficiency by wavelength" in panel().words()
    bpy.ops.hologram.override(effect="wavelength", hologram="lens", on=True)
    assert not choices(scene)
    assert switches(panel())["wavelength", "lens"].options["icon"] == "CHECKBOX_HLT"


def test_choice_for_all_holograms_is_taken_back_by_a_click(scene: Any) -> None:
    scene.hologram.render.effects.add().name = "-wavelength"
    bpy.ops.hologram.plan()
    bpy.ops.hologram.override(effect="wavelength", hologram="lens", on=True)
    assert not choices(scene)


def test_back_to_the_plan(scene: Any) -> None:
    for name in ("-wavelength", "lens:-angle"):
        scene.hologram.render.effects.add().name = name
    assert bpy.ops.hologram.back_to_plan() == {"FINISHED"}
    assert not choices(scene)
    with pytest.raises(RuntimeError, match="decides about all effects already"):
        bpy.ops.hologram.back_to_plan()


def test_unknown_effect_is_refused(scene: Any) -> None:
    with pytest.raises(RuntimeError, match="must name an effect"):
        bpy.ops.hologram.override(effect="magic", hologram="", on=True)
    assert not choices(scene)


def test_what_no_document_can_do_without_is_told(scene: Any) -> None:
    bpy.ops.hologram.override(effect="orders", hologram="", on=False)
    bpy.ops.hologram.override(effect="haze", hologram="lens", on=False)
    scene.hologram.render.effects.add().name = "-magic"
    bpy.ops.hologram.plan()
    assert "must name an effect" in panel().words()


def test_plan_is_told_out_of_date(scene: Any) -> None:
    bpy.ops.hologram.plan()
    scene.cycles.samples += 1
    DEVICE_FACTS.update_now(scene)
    assert "changed since" not in panel().words()
    scene.hologram.eye.pupil_diameter_mm = 3.5
    DEVICE_FACTS.update_now(scene)
    assert "changed since" in panel().words()
    bpy.ops.hologram.plan()
    assert "changed since" not in panel().words()


def test_foreign_things_are_named(scene: Any) -> None:
    lamp = bpy.data.objects.new("Ceiling Lamp", bpy.data.lights.new("Ceiling Lamp", "POINT"))
    scene.collection.objects.link(lamp)
    DEVICE_FACTS.update_now(scene)
    assert "Nothing is left out" in panel().words()
    assert "Ceiling Lamp" in panel().words()
    bpy.ops.hologram.plan()
    assert "Everything" in panel().words()


def test_invalid_document_is_told_once(scene: Any) -> None:
    scene.hologram.room.luminance_cd_m2 = 100.0
    scene.objects["lens"].scale = (2.0, 2.0, 2.0)
    with pytest.raises(RuntimeError, match="scale"):
        bpy.ops.hologram.plan()


def test_plan_beside_the_window(scene: Any) -> None:
    """What the window does: a thread plans, and a timer fetches the plan."""
    told: list[bool] = []
    plans.start(scene, document_of(scene), lambda: told.append(True))
    assert plans.is_planning(scene)
    drawn = panel()
    assert not drawn.of("operator")[0].enabled
    assert "Working" in (drawn.of("operator")[0].text or "")
    until = time.monotonic() + ENDS_WITHIN_S
    while plans.is_planning(scene) and time.monotonic() < until:
        plans._fetch()
        time.sleep(0.02)
    assert told == [True]
    assert plans.plan_of(scene) == plans.plan_now(scene, document_of(scene))


def test_undo_takes_a_choice_back(scene: Any) -> None:
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.hologram.override(effect="wavelength", hologram="lens", on=False)
    bpy.ops.ed.undo_push(message="override")
    bpy.ops.ed.undo()
    scene = bpy.context.window.scene
    assert not choices(scene)
    bpy.ops.ed.redo()
    assert choices(bpy.context.window.scene) == ["lens:-wavelength"]
