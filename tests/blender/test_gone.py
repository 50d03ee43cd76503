# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A device that was deleted is none: another one may come, and undo gives it back."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.add import emitters, eye, hologram
from hoe_addon.blender.add.presets import add_device, add_scene
from hoe_addon.blender.document.foreign import things
from hoe_addon.blender.document.held import device_of, document_of, has_device
from hoe_addon.blender.document.live import settle
from hoe_addon.blender.readiness import troubles
from hoe_addon.core.errors import HoeError
from hoe_addon.ui.facts.device import DeviceFacts, device_facts
from hoe_addon.ui.overlay import state

ROOT = Path(__file__).parents[2]

PRESETS = ("two_hologram_ar", "point_lens")

STEPS = """
import bpy, hoe_addon
from hoe_addon.blender.add.presets import add_device
from hoe_addon.blender.document.held import document_of, has_device

bpy.ops.wm.read_factory_settings(use_empty=True)
hoe_addon.register()
add_device(bpy.context.scene, "two_hologram_ar")
before = document_of(bpy.context.scene)
bpy.ops.ed.undo_push(message="add")
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.ops.ed.undo_push(message="delete")
assert not has_device(bpy.context.scene)
add_device(bpy.context.scene, "point_lens")
bpy.ops.ed.undo_push(message="another")
bpy.ops.ed.undo()
assert not has_device(bpy.context.scene)
bpy.ops.ed.undo()
assert document_of(bpy.context.scene) == before
hoe_addon.unregister()
print("same document")
"""


def delete(scene: Any, *kept: Any) -> None:
    """Delete all that can be selected, as the keys A and X do."""
    bpy.context.window.scene = scene
    bpy.ops.object.select_all(action="SELECT")
    for item in kept:
        item.select_set(False)
    bpy.ops.object.delete()


@pytest.mark.parametrize("name", PRESETS)
def test_deleted_device_is_none(registered: Any, name: str) -> None:
    scene = add_scene(name)
    state.refresh(scene)
    assert state.shown(scene).drawing.lines
    delete(scene)
    assert not has_device(scene)
    state.refresh(scene)
    assert state.shown(scene).drawing.lines == {}
    assert device_facts(scene) == DeviceFacts()
    assert troubles(scene) == ()
    with pytest.raises(HoeError, match="holds no device; add one"):
        document_of(scene)


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("other", PRESETS)
def test_another_device_comes(registered: Any, name: str, other: str) -> None:
    scene = add_scene(name)
    scene.hologram.overlay.rays = 7
    delete(scene)
    assert [item.hologram.role for item in scene.objects] == ["filter"]
    add_device(scene, other)
    assert [item.hologram.role for item in scene.objects].count("filter") == 1
    assert [each.name for each in bpy.data.collections if "Room" in each.name] == ["Room.001"]
    assert scene.hologram.overlay.rays == 7
    assert document_of(scene).name == other
    assert device_of(scene).root in set(scene.objects)
    assert scene.camera == device_of(scene).eye, "the deleted eye is no camera of the user's"
    assert things(scene) == ()
    assert settle(scene) == ()


def test_single_elements_come_after_a_light_guide(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    delete(scene)
    item, _ = hologram.add_hologram(scene)
    panel, _ = emitters.add_display(scene)
    camera, _ = eye.give_eye(scene)
    names = sorted(element.name for element in document_of(scene).elements)
    assert names == sorted((item.name, panel.name))
    assert device_of(scene).eye == camera


@pytest.mark.parametrize("name", PRESETS)
def test_overlay_without_root_and_eye(registered: Any, name: str) -> None:
    scene = add_scene(name)
    bpy.data.objects.remove(scene.hologram.eye.camera)
    state.refresh(scene)
    assert state.shown(scene).drawing.lines
    bpy.data.objects.remove(scene.hologram.root)
    state.refresh(scene)
    assert not state.shown(scene).problem


def test_overlay_tells_that_the_root_is_gone(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    bpy.data.objects.remove(scene.hologram.root)
    state.refresh(scene)
    assert state.shown(scene).problem.startswith("root: must be an object")


def test_new_eye_is_the_camera_that_the_deleted_one_was(registered: Any) -> None:
    scene = registered
    emitters.add_display(scene)
    for _ in range(2):
        camera, _ = eye.give_eye(scene)
        assert scene.camera == camera
        for child in camera.children:
            bpy.data.objects.remove(child)
        bpy.ops.object.select_all(action="DESELECT")
        camera.select_set(True)
        bpy.ops.object.delete()


def test_elements_that_are_left_are_no_new_device(registered: Any) -> None:
    scene = add_scene("point_lens")
    lens = next(item for item in scene.objects if item.hologram.role == "hologram")
    delete(scene, lens)
    assert not has_device(scene)
    with pytest.raises(HoeError, match="holds a device already; delete all of it"):
        add_device(scene, "point_lens")
    assert lens.hologram.role == "hologram"


def test_device_of_another_scene_stays(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    before = document_of(scene)
    bpy.context.window.scene = scene
    bpy.ops.scene.new(type="EMPTY")
    copy = bpy.context.scene
    assert not has_device(copy)
    add_device(copy, "point_lens")
    assert document_of(scene) == before
    assert device_of(scene).room == scene.hologram.room.collection


def test_children_of_the_user_stay_where_they_are(registered: Any) -> None:
    scene = add_scene("point_lens")
    (screen,) = (item for item in scene.objects if item.hologram.role == "filter")
    mine = bpy.data.objects.new("Mine", None)
    scene.collection.objects.link(mine)
    mine.parent, mine.location = screen, (1.0, 2.0, 3.0)
    scene.view_layers[0].update()
    place = mine.matrix_world.copy()
    delete(scene, mine)
    add_device(scene, "point_lens")
    scene.view_layers[0].update()
    assert mine.parent is None
    assert np.allclose(mine.matrix_world, place, atol=1e-5)


def test_undo_gives_the_device_back() -> None:
    """In a process of its own, for a mistake here ends Blender."""
    done = subprocess.run(
        [sys.executable, "-c", STEPS], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert "same document" in done.stdout
