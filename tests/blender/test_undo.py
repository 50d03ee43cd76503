# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""After undo and redo, in every frame, and after opening a file, shaders agree with properties."""

import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.props import changes
from hoe_addon.blender.props.made import is_stale
from hoe_addon.blender.props.sync import (
    catch_up,
    hologram_node,
    read_frame,
    read_spec,
    refresh,
    refresh_changed,
)
from hoe_addon.blender.shaders import nodes, osl
from hoe_addon.blender.shaders.animated import animated_holograms
from hoe_addon.core.errors import SpecError
from hoe_addon.shading.hologram import hologram_shader, hologram_sockets

type Make = Callable[..., Any]

FRAME_S = 20e-3
"""Time of the processor for one animated hologram in one frame; 3 ms measured."""


@pytest.fixture
def material(make_material: Make, lens: dict[str, Any]) -> Any:
    """A hologram that stays in a saved file."""
    made = make_material(lens)
    made.use_fake_user = True
    return made


def the_material() -> Any:
    """The one hologram, wherever Blender has put it."""
    (found,) = (each for each in bpy.data.materials if each.hologram.enabled)
    return found


def socket(material: Any, name: str) -> Any:
    node = hologram_node(material)
    assert node is not None
    return nodes.input_socket(node, name).default_value


def recorded_nm(material: Any) -> float:
    return round(socket(material, "recording_wavelength_nm"), 3)


def assert_agrees(material: Any) -> None:
    spec = read_spec(material)
    source = hologram_shader(spec)
    node = hologram_node(material)
    assert node is not None
    assert node.script.name == f"{source.name}_{source.digest}.osl"
    assert node.bytecode == osl.compiled(source)
    for name, value in hologram_sockets(spec, read_frame(material)).items():
        held, wanted = (
            np.array(each, dtype=np.float32) for each in (socket(material, name), value)
        )
        assert held.tolist() == wanted.tolist(), name
    assert not is_stale(material)


def test_undo_and_redo_of_a_number(material: Any) -> None:
    """As in a window: the step is kept before the timer has made the shader."""
    bpy.ops.ed.undo_push(message="before")
    material.hologram.recording.wavelength_nm = 600.0
    bpy.ops.ed.undo_push(message="after")
    refresh_changed()
    assert recorded_nm(the_material()) == 600.0
    bpy.ops.ed.undo()
    assert recorded_nm(the_material()) == 532.0
    assert_agrees(the_material())
    bpy.ops.ed.redo()
    assert recorded_nm(the_material()) == 600.0
    assert_agrees(the_material())


def test_undo_and_redo_of_a_kind(material: Any) -> None:
    bpy.ops.ed.undo_push(message="before")
    material.hologram.recording.object.kind = "plane"
    bpy.ops.ed.undo_push(message="after")
    refresh_changed()
    bpy.ops.ed.undo()
    assert_agrees(the_material())
    bpy.ops.ed.redo()
    assert the_material().hologram.recording.object.kind == "plane"
    assert_agrees(the_material())


def test_what_agrees_is_not_written(material: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A look after an undo costs a comparison, and leads to no further evaluation."""
    tried: list[Any] = []
    monkeypatch.setattr("hoe_addon.blender.props.sync.refresh", lambda *a, **k: tried.append(a))
    catch_up()
    assert not tried
    material.hologram.recording.wavelength_nm = 600.0
    catch_up()
    assert len(tried) == 1


def test_a_refresh_that_changes_nothing_marks_nothing(material: Any) -> None:
    carrier(material)
    bpy.context.view_layer.update()
    seen: list[Any] = []
    handler = lambda _scene, graph: seen.extend(graph.updates)  # noqa: E731
    bpy.app.handlers.depsgraph_update_post.append(handler)
    try:
        assert not refresh(material)
        bpy.context.view_layer.update()
    finally:
        bpy.app.handlers.depsgraph_update_post.remove(handler)
    assert not seen


def test_a_file_is_not_dirty_after_opening(material: Any, tmp_path: Path) -> None:
    path = str(tmp_path / "kept.blend")
    material.hologram.recording.wavelength_nm = 600.0  # the shader is behind when saved
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert_agrees(the_material())
    assert recorded_nm(the_material()) == 600.0
    assert not bpy.data.is_dirty


def animate(material: Any, frames: dict[int, float]) -> None:
    recording = material.hologram.recording
    for frame, value in frames.items():
        recording.wavelength_nm = value
        recording.keyframe_insert("wavelength_nm", frame=frame)


def test_keyframes_reach_the_shader(material: Any) -> None:
    carrier(material)
    animate(material, {1: 600.0, 11: 500.0})
    assert list(animated_holograms()) == [material]
    scene = bpy.context.scene
    for frame in (1, 6, 11):
        scene.frame_set(frame)
        held = material.hologram.recording.wavelength_nm
        assert recorded_nm(material) == pytest.approx(held, abs=1e-3)
    assert recorded_nm(material) == 500.0


def test_drivers_reach_the_shader(material: Any) -> None:
    carrier(material)
    scene = bpy.context.scene
    scene["colour"] = 500.0
    driver = material.hologram.recording.driver_add("wavelength_nm").driver
    driver.type = "SUM"
    variable = driver.variables.new()
    variable.targets[0].id_type = "SCENE"
    variable.targets[0].id = scene
    variable.targets[0].data_path = '["colour"]'
    for value in (510.0, 620.0):
        scene["colour"] = value
        scene.update_tag()
        scene.frame_set(scene.frame_current + 1)
        assert recorded_nm(material) == value


def test_a_driver_follows_what_is_moved_without_a_new_frame(material: Any) -> None:
    carrier(material)
    handle = bpy.data.objects.new("handle", None)
    bpy.context.scene.collection.objects.link(handle)
    driver = material.hologram.recording.driver_add("wavelength_nm").driver
    driver.type = "SUM"
    variable = driver.variables.new()
    variable.type = "TRANSFORMS"
    variable.targets[0].id = handle
    for place in (510.0, 620.0):
        handle.location.x = place
        bpy.context.view_layer.update()
        assert recorded_nm(material) == place


def test_other_animation_costs_nothing(material: Any) -> None:
    material.diffuse_color = (1.0, 0.0, 0.0, 1.0)
    material.keyframe_insert("diffuse_color", frame=1)
    assert not list(animated_holograms())


def test_animated_nonsense_is_told_and_the_shader_stays(material: Any) -> None:
    carrier(material)
    animate(material, {1: 600.0, 2: 600.0})
    efficiency = material.hologram.efficiency
    for frame, levels in ((1, 2), (2, 1)):
        efficiency.levels = levels
        efficiency.keyframe_insert("levels", frame=frame)
    bpy.context.scene.frame_set(1)
    assert material.hologram.problem == ""
    before = hologram_node(material).script.name
    bpy.context.scene.frame_set(2)
    assert material.hologram.problem.startswith("efficiency.levels: must be 0")
    assert hologram_node(material).script.name == before
    bpy.context.scene.frame_set(1)
    assert material.hologram.problem == ""


def test_a_frame_is_quick(material: Any) -> None:
    carrier(material)
    animate(material, {1: 600.0, 100: 500.0})
    scene = bpy.context.scene
    seconds = []
    for frame in range(1, 21):
        start = time.process_time()
        scene.frame_set(frame)
        seconds.append(time.process_time() - start)
    assert statistics.median(seconds) < FRAME_S


def carrier(material: Any) -> Any:
    mesh = bpy.data.meshes.new("plate")
    mesh.from_pydata([(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    item = bpy.data.objects.new("plate", mesh)
    bpy.context.scene.collection.objects.link(item)
    return item


def test_a_copy_is_independent(material: Any) -> None:
    copy = material.copy()
    number = recorded_nm(copy)
    material.hologram.recording.wavelength_nm = 640.0
    refresh_changed()
    assert (recorded_nm(material), recorded_nm(copy)) == (640.0, number)
    assert_agrees(copy)
    copy.hologram.recording.object.kind = "plane"
    refresh_changed()
    assert_agrees(copy)
    assert_agrees(material)


def test_a_scene_copied_in_full_is_independent(material: Any) -> None:
    carrier(material)
    bpy.ops.scene.new(type="FULL_COPY")
    kinds = {"object": True, "obdata": True, "material": True}
    bpy.ops.object.make_single_user(type="ALL", **kinds)
    (item,) = bpy.context.scene.objects
    copied = item.active_material
    assert copied != material
    copied.hologram.recording.wavelength_nm = 640.0
    refresh_changed()
    assert (recorded_nm(material), recorded_nm(copied)) == (532.0, 640.0)
    assert_agrees(material)
    assert_agrees(copied)


def test_a_new_hologram_is_valid_at_once(registered: Any) -> None:
    material = bpy.data.materials.new("fresh")
    material.hologram.enabled = True
    refresh_changed()
    assert material.hologram.problem == ""
    spec = read_spec(material)
    assert spec.orders == (0, 1)
    assert spec.efficiency.relief == 1.5
    wave = spec.pattern.object
    assert (wave.position_mm, wave.beam) == ((0.0, 0.0, 100.0), "converging")
    assert_agrees(material)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("recording.object.kind", "plane"),
        ("pattern", "characteristic"),
        ("efficiency.model", "kogelnik"),
        ("efficiency.model", "constant"),
        ("efficiency.relief.kind", "catalogue"),
        ("surface.outline", "ellipse"),
        ("media.front.kind", "catalogue"),
    ],
)
def test_a_new_hologram_may_be_switched(registered: Any, field: str, value: str) -> None:
    material = bpy.data.materials.new("fresh")
    material.hologram.enabled = True
    *path, name = field.split(".")
    group = material.hologram
    for step in path:
        group = getattr(group, step)
    setattr(group, name, value)
    refresh_changed()
    assert material.hologram.problem == ""
    assert_agrees(material)


def test_switching_on_again_keeps_what_was_set(material: Any) -> None:
    material.hologram.orders.clear()
    material.hologram.orders.add().order = 3
    material.hologram.enabled = False
    material.hologram.enabled = True
    assert [entry.order for entry in material.hologram.orders] == [3]
    assert list(changes.taken(bpy.data.materials)) == [material]


def test_sockets_of_passes_stay(material: Any) -> None:
    """A pass of a render numbers its orders in sockets that no property knows."""
    node = hologram_node(material)
    nodes.input_socket(node, "first_orders").default_value = 2
    nodes.input_socket(node, "first_gain").default_value = 4.0
    material.hologram.recording.wavelength_nm = 600.0
    refresh(material)
    material.hologram.recording.object.kind = "plane"
    assert refresh(material)
    assert (socket(material, "first_orders"), socket(material, "first_gain")) == (2, 4.0)


def test_the_plain_text_stays_while_it_is_valid(material: Any) -> None:
    """Numbers leave the text of a render job alone; another kind takes the general text."""
    from hoe_addon.shading.source import defining

    node = hologram_node(material)
    plain = defining(hologram_shader(read_spec(material)), "HOE_PLAIN")
    nodes.set_script(node, plain)
    material.hologram.recording.wavelength_nm = 600.0
    assert not refresh(material)
    assert node.script.name.endswith(f"{plain.digest}.osl")
    material.hologram.recording.object.kind = "plane"
    assert refresh(material)
    assert_agrees(material)


def test_a_broken_text_property_is_told(material: Any) -> None:
    material.hologram.recording.object.kind = "window"
    material.hologram.recording.object.details = "{"
    with pytest.raises(SpecError):
        refresh(material)
    assert material.hologram.problem
