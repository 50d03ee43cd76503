# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene shows beside its document is found, so that nothing its light needs is left out."""

from typing import Any

import bpy
import pytest

from hoe_addon import resources
from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document.foreign import things
from hoe_addon.blender.document.held import document_of
from hoe_addon.blender.document.live import settle


@pytest.fixture
def desk(registered: Any) -> Any:
    """A scene with a room, whose document knows all that is in it."""
    scene = add_scene("point_lens")
    assert scene.hologram.room.kind == "desk"
    assert things(scene) == ()
    return scene


def lamp(name: str = "Mine") -> Any:
    return bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))


def instance(collection: Any) -> Any:
    made = bpy.data.objects.new(f"Instance of {collection.name}", None)
    made.instance_type, made.instance_collection = "COLLECTION", collection
    return made


@pytest.mark.parametrize("name", resources.preset_paths())
def test_rooms_are_known(registered: Any, name: str) -> None:
    scene = add_scene(name)
    assert things(scene) == ()
    scene.hologram.room.kind = "road"
    settle(scene)
    assert things(scene) == ()


def test_lamp_in_the_room_is_none_of_it(desk: Any) -> None:
    desk.hologram.room.collection.objects.link(lamp())
    assert things(desk) == ("Mine",)
    assert document_of(desk).render.effects[:1] == ("all",)


def test_part_of_a_room_elsewhere_is_unknown(desk: Any) -> None:
    top = next(iter(desk.hologram.room.collection.all_objects)).copy()
    desk.collection.objects.link(top)
    assert things(desk) == (top.name,)


def test_instances_of_what_shows(desk: Any) -> None:
    inner, outer = bpy.data.collections.new("Inner"), bpy.data.collections.new("Outer")
    outer.objects.link(instance(inner))
    desk.collection.objects.link(instance(outer))
    assert things(desk) == ()
    inner.objects.link(instance(outer))
    assert things(desk) == (), "a collection in itself has an end"
    sun = lamp()
    inner.objects.link(sun)
    assert things(desk) == ("Instance of Outer",)
    sun.hide_render = True
    assert things(desk) == ()


@pytest.mark.parametrize("kind", ["none", "desk", "living_room", "road"])
def test_own_world_in_any_room(desk: Any, kind: str) -> None:
    desk.hologram.room.kind = kind
    settle(desk)
    assert things(desk) == ()
    desk.world = bpy.data.worlds.new("Sky of mine")
    assert things(desk) == ("Sky of mine",)
    desk.world = None
    assert things(desk) == ()
