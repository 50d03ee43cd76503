# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3-D view follows the scene, and a mistake in it ends it once."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.ui import parts
from hoe_addon.ui.overlay import draw, failure, state, watch
from hoe_addon.ui.overlay.document import Kind
from tests.ui import layouts

NEAR = 1e-4
"""Places are float32 in the scene: 1e-7 of at most a metre, in mm."""


@pytest.fixture
def sight(registered: Any) -> Iterator[Any]:
    """The holographic sight as the scene of the window, drawn once."""
    made = add_scene("holographic_sight")
    bpy.context.window.scene = made
    state.forget_all()
    assert state.refresh(made)
    yield made


def lines(scene: Any, kind: Kind) -> Any:
    return state.shown(scene).drawing.lines[kind]


def hologram_of(scene: Any) -> Any:
    return next(item for item in scene.objects if item.hologram.role == "hologram")


def test_every_kind_is_a_switch_and_only_a_light_guide_has_an_eyebox(registered: Any) -> None:
    for name, kinds in (
        ("holographic_sight", set(Kind) - {Kind.EYEBOX}),
        ("two_hologram_ar", set(Kind)),
    ):
        scene = add_scene(name)
        assert state.refresh(scene)
        assert set(state.shown(scene).drawing.lines) == kinds
        for kind in kinds:
            setattr(scene.hologram.overlay, kind.value, False)
            assert state.refresh(scene)
            kinds = kinds - {kind}
            assert set(state.shown(scene).drawing.lines) == kinds


def test_nothing_is_drawn_anew_without_a_change(sight: Any) -> None:
    before = state.shown(sight)
    assert not state.refresh(sight)
    sight.cycles.samples += 1
    assert not state.refresh(sight)
    assert state.shown(sight) is before


def test_moved_device_takes_its_drawing_along(sight: Any) -> None:
    before = {kind: some.ends for kind, some in state.shown(sight).drawing.lines.items()}
    shift = Matrix.Translation((30.0, -20.0, 5.0)) @ Matrix.Rotation(0.7, 4, "Z")
    sight.hologram.root.matrix_world = shift @ sight.hologram.root.matrix_world
    assert state.refresh(sight)
    turn = np.array(shift)
    for kind, ends in before.items():
        wanted = ends @ turn[:3, :3].T + turn[:3, 3]
        scale = max(1.0, float(np.abs(wanted).max()))
        assert np.allclose(lines(sight, kind).ends, wanted, atol=NEAR * scale), kind


def test_moved_hologram_takes_its_sources_along_and_turns_the_rays(sight: Any) -> None:
    sources, rays = lines(sight, Kind.SOURCES).ends, lines(sight, Kind.CHIEF_RAYS).ends
    # x of the device is x of the scene.
    hologram_of(sight).location.x += 2.0
    assert state.refresh(sight)
    moved = lines(sight, Kind.SOURCES).ends
    assert np.allclose(moved, sources + np.float32((2.0, 0.0, 0.0)), atol=NEAR * 500.0)
    assert not np.array_equal(lines(sight, Kind.CHIEF_RAYS).ends, rays)


def test_invalid_scene_keeps_its_last_drawing(sight: Any) -> None:
    before = state.shown(sight)
    block = next(item for item in sight.objects if item.hologram.role == "block")
    block.scale.x = 2.0
    assert state.refresh(sight)
    now = state.shown(sight)
    assert now.is_stale
    assert "scale: must be 1" in now.problem
    assert now.drawing is before.drawing
    assert not state.refresh(sight)
    block.scale.x = 1.0
    assert state.refresh(sight)
    assert not state.shown(sight).is_stale
    assert not state.shown(sight).problem


def test_density_and_orders_count(sight: Any) -> None:
    overlay = sight.hologram.overlay
    sparse = len(lines(sight, Kind.SOURCES).ends)
    overlay.rays = 25
    assert state.refresh(sight)
    assert len(lines(sight, Kind.SOURCES).ends) > 2 * sparse
    both = len(lines(sight, Kind.CHIEF_RAYS).ends)
    overlay.highest_order = 0
    assert state.refresh(sight)
    assert len(lines(sight, Kind.CHIEF_RAYS).ends) < both
    overlay.show = False
    assert state.refresh(sight)
    assert not state.shown(sight).drawing.lines


def test_hologram_without_a_device_shows_its_sources(
    make_hologram: Callable[..., Any], plate: Any, lens: Any
) -> None:
    make_hologram(lens)
    scene = bpy.context.scene
    assert state.refresh(scene)
    assert set(state.shown(scene).drawing.lines) == {Kind.SOURCES}
    ends = lines(scene, Kind.SOURCES).ends
    # A document in mm in a scene in metres.
    plate.active_material.hologram.units_per_mm = 0.001
    plate.location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    assert state.refresh(scene)
    wanted = ends.astype(np.float64) * 0.001 + (1.0, 2.0, 3.0)
    assert np.allclose(lines(scene, Kind.SOURCES).ends, wanted, atol=1e-5)
    plate.hide_set(True)
    assert state.refresh(scene)
    assert not state.shown(scene).drawing.lines


def test_watching_is_for_all_scenes_in_windows(sight: Any) -> None:
    hologram_of(sight).location.x += 1.0
    assert watch.run()
    assert not watch.run()
    assert not watch.is_waiting(), "reading a document is no change"


def test_handlers_come_and_go(registered: Any) -> None:
    events = ("depsgraph_update_post", "frame_change_post", "load_post", "undo_post", "redo_post")

    def own() -> int:
        found = (getattr(bpy.app.handlers, event) for event in events)
        return sum(each.__module__ == watch.__name__ for some in found for each in some)

    assert watch in parts.PARTS
    assert draw in parts.PARTS
    assert own() == len(events)
    assert len(draw._drawing.handlers) == 2
    watch.unregister()
    draw.unregister()
    assert own() == 0
    assert not draw._drawing.handlers
    draw.register()
    watch.register()


def test_mistake_in_drawing_is_told_once(
    sight: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    space = SimpleNamespace(type="VIEW_3D", overlay=SimpleNamespace(show_overlays=True))
    context = SimpleNamespace(space_data=space, scene=sight)
    monkeypatch.setattr(draw, "bpy", SimpleNamespace(context=context))
    calls: list[Any] = []

    def broken(given: Any) -> None:
        calls.append(given)
        raise ZeroDivisionError("no width")

    for _ in range(3):
        draw._guarded(broken)
    assert len(calls) == 1
    assert capsys.readouterr().err.count("ZeroDivisionError: no width") == 1
    monkeypatch.undo()
    drawn = layouts.draw(bpy.types.HOE_PT_overlay)
    assert drawn is not None
    assert "ZeroDivisionError: no width" in drawn.words()
    failure.forget()
    monkeypatch.setattr(draw, "bpy", SimpleNamespace(context=context))
    space.overlay.show_overlays = False
    draw._guarded(broken)
    assert len(calls) == 1


def shown_in_panel() -> list[str]:
    drawn = layouts.draw(bpy.types.HOE_PT_overlay)
    assert drawn is not None
    return drawn.properties()


def test_panel_shows_what_applies(sight: Any) -> None:
    names = shown_in_panel()
    assert names[:4] == ["show", "sources", "chief_rays", "pupil"]
    assert set(names[4:]) == {"rays", "corners", "lowest_order", "highest_order"}
    sight.hologram.overlay.chief_rays = False
    assert "corners" not in shown_in_panel()
    bpy.context.window.scene = add_scene("two_hologram_ar")
    assert "eyebox" in shown_in_panel()


def test_panel_of_a_lone_hologram_is_about_its_sources(
    registered: Any, make_hologram: Callable[..., Any], lens: Any
) -> None:
    assert layouts.draw(bpy.types.HOE_PT_overlay) is None
    make_hologram(lens)
    assert shown_in_panel() == ["show", "sources", "rays"]


def test_switched_off_and_on_again_is_not_taken_for_what_was_there_before(sight: Any) -> None:
    numbers = [state.shown(sight).number]
    for show in (False, True, False, True):
        sight.hologram.overlay.show = show
        sight.hologram.overlay.rays += 1
        assert state.refresh(sight)
        numbers.append(state.shown(sight).number)
    drawn = [number for number in numbers if number]
    assert len(set(drawn)) == len(drawn) == 3


def test_scene_that_is_gone_is_forgotten(sight: Any) -> None:
    other = add_scene("point_lens")
    assert state.refresh(other)
    gone = other.session_uid
    assert state.is_kept(gone)
    bpy.data.scenes.remove(other)
    watch.run()
    assert not state.is_kept(gone)
    assert state.is_kept(sight.session_uid)
    state.forget_all()
    assert not state.shown(sight).drawing.lines
