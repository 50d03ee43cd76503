# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts are made anew without taking anything that is the user's."""

from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document.held import device_of
from hoe_addon.blender.document.live import settle
from hoe_addon.blender.ids import Role
from hoe_addon.blender.marks import is_made


def cube(collection: bpy.types.Collection, name: str) -> bpy.types.Object:
    item = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    collection.objects.link(item)
    return item


def of_role(scene: bpy.types.Scene, role: Role) -> bpy.types.Object:
    return next(item for item in scene.objects if item.hologram.role == role)


def parts_of_room(scene: bpy.types.Scene) -> set[str]:
    return {item.name for item in scene.objects if item.hologram.role == Role.ROOM}


def shown(scene: bpy.types.Scene, item: bpy.types.Object) -> None:
    bpy.context.window.scene = scene
    layer = scene.view_layers[0].layer_collection
    scene.view_layers[0].active_layer_collection = layer.children[item.users_collection[0].name]


@pytest.mark.parametrize("kind", ["wall", "none"])
def test_what_the_user_put_into_the_room_stays(registered: Any, kind: str) -> None:
    scene = add_scene("point_lens")
    room = scene.hologram.room
    collection, own = room.collection, bpy.data.collections.new("Mine")
    collection.children.link(own)
    vase, flower = cube(collection, "My Vase"), cube(own, "My Flower")
    table = next(item for item in collection.objects if item.hologram.role == Role.ROOM)
    flower.parent, flower.location = table, (1.0, 2.0, 3.0)
    scene.view_layers[0].update()
    place = flower.matrix_world.copy()
    before = parts_of_room(scene)
    assert settle(scene) == ()
    room.kind = kind
    assert settle(scene) == ("room",)
    scene.view_layers[0].update()
    assert room.collection == collection
    assert {vase.name, flower.name} <= set(scene.objects.keys())
    assert flower.users_collection == (own,)
    assert flower.matrix_world == place
    assert parts_of_room(scene) != before
    assert bool(parts_of_room(scene)) == (kind != "none")


def test_room_grows_without_what_the_user_put_into_it(registered: Any) -> None:
    scene = add_scene("point_lens")
    vase = cube(scene.hologram.room.collection, "My Vase")
    scene.hologram.root.scale *= 2.0
    scene.view_layers[0].update()
    assert "room" in settle(scene)
    assert tuple(vase.scale) == (1.0, 1.0, 1.0)


def test_part_of_the_room_that_is_used_elsewhere_stays_there(registered: Any) -> None:
    scene, other = add_scene("point_lens"), bpy.data.scenes.new("Other")
    room = scene.hologram.room
    table = next(item for item in room.collection.objects if item.hologram.role == Role.ROOM)
    other.collection.objects.link(table)
    room.luminance_cd_m2 *= 2.0
    settle(scene)
    assert table.users_collection == (other.collection,)
    assert table.hologram.role == Role.NONE
    assert table.name not in scene.objects


def test_scene_with_linked_objects_gets_a_room_of_its_own(registered: Any) -> None:
    scene = add_scene("point_lens")
    bpy.context.window.scene = scene
    vase = cube(scene.hologram.room.collection, "My Vase")
    collection, parts = scene.hologram.room.collection, parts_of_room(scene)
    bpy.ops.scene.new(type="LINK_COPY")
    twin = bpy.context.scene
    twin.hologram.room.luminance_cd_m2 *= 2.0
    assert settle(twin) == ("room",)
    assert scene.hologram.room.collection == collection
    assert parts_of_room(scene) == parts
    assert len(parts_of_room(twin)) == len(parts)
    assert not parts_of_room(twin) & parts
    assert vase.name in twin.objects
    assert vase.name in scene.objects
    assert device_of(scene).room == collection
    assert settle(scene) == settle(twin) == ()


def test_sky_that_the_user_has_replaced_stays_so(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    scene.hologram.room.kind = "road"
    settle(scene)
    assert scene.world == scene.hologram.room.world
    scene.world = own = bpy.data.worlds.new("My Sky")
    scene.hologram.room.luminance_cd_m2 *= 2.0
    settle(scene)
    assert scene.world == own


def test_new_objects_do_not_come_into_the_room(registered: Any) -> None:
    scene = add_scene("point_lens")
    room = scene.hologram.room
    shown(scene, next(iter(room.collection.objects)))
    assert bpy.context.collection == room.collection
    bpy.ops.hologram.add_lamp()
    lamp = bpy.context.object
    assert lamp.users_collection == (scene.collection,)
    room.kind = "wall"
    settle(scene)
    assert lamp.name in scene.objects


def test_light_engine_stays_the_same_with_what_is_on_it(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    engine = scene.hologram.engine
    parts = set(engine.mount.children)
    housing = next(part for part in parts if part.name.startswith("Housing"))
    plastic = bpy.data.materials.new("My Plastic")
    housing.material_slots[0].material = plastic
    housing.modifiers.new("Bevel", "BEVEL")
    cable, panel = cube(scene.collection, "Cable"), engine.panel
    cable.parent = housing
    materials, meshes = len(bpy.data.materials), len(bpy.data.meshes)
    engine.display.size_mm[0] *= 0.9
    assert settle(scene) == ("engine",)
    assert set(engine.mount.children) == parts
    assert engine.panel == panel
    assert housing.active_material == plastic
    assert "Bevel" in housing.modifiers
    assert cable.parent == housing
    assert len(bpy.data.meshes) == meshes
    assert len(bpy.data.materials) <= materials


def test_part_of_a_light_engine_that_is_gone_is_there_again(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    engine = scene.hologram.engine
    bpy.data.objects.remove(engine.panel)
    engine.display.size_mm[0] *= 0.9
    assert settle(scene)[0] == "engine"
    assert engine.panel in tuple(engine.mount.children)
    assert [child.hologram.role for child in engine.mount.children] == [Role.PART] * 3


@pytest.mark.parametrize("slots", [1, 2])
@pytest.mark.parametrize("link", ["DATA", "OBJECT"])
def test_card_keeps_the_material_of_the_user(registered: Any, slots: int, link: str) -> None:
    scene = add_scene("diffractive_achromat")
    card, own = of_role(scene, Role.CARD), bpy.data.materials.new("My Print")
    while len(card.data.materials) < slots:
        card.data.materials.append(None)
    for slot in card.material_slots:
        slot.link = link
        slot.material = own
    before = card.data.name
    card.hologram.size_mm[0] *= 1.1
    assert settle(scene) == ("shape",)
    assert [slot.material for slot in card.material_slots] == [own] * slots
    assert card.data.name == before
    assert own.name in bpy.data.materials


def test_material_in_two_slots_is_removed_once(registered: Any) -> None:
    scene = add_scene("diffractive_achromat")
    card = of_role(scene, Role.CARD)
    card.data.materials.append(card.data.materials[0])
    card.hologram.size_mm[0] *= 1.1
    assert settle(scene) == ("shape",)
    assert is_made(card.material_slots[0].material)


def test_mesh_of_the_user_is_not_removed(registered: Any) -> None:
    scene = add_scene("diffractive_achromat")
    card, own = of_role(scene, Role.CARD), bpy.data.meshes.new("My Mesh")
    card.data = own
    card.hologram.size_mm[0] *= 1.1
    settle(scene)
    assert own.name in bpy.data.meshes
    assert card.data != own


def test_faces_of_a_lens_stay_the_same_objects(registered: Any) -> None:
    scene = add_scene("diffractive_achromat")
    lens = of_role(scene, Role.LENS)
    faces, mark = set(lens.children), cube(scene.collection, "My Mark")
    mark.parent = next(iter(faces))
    details = lens.hologram.details
    lens.hologram.details = details.replace('"thickness_mm": ', '"thickness_mm": 1')
    assert "shape" in settle(scene)
    assert set(lens.children) == faces
    assert mark.parent in faces


def test_light_with_a_material_of_the_user_keeps_it(registered: Any) -> None:
    scene = add_scene("holographic_sight")
    display, own = of_role(scene, Role.DISPLAY), bpy.data.materials.new("My Light")
    display.material_slots[0].material = own
    display.hologram.display.luminance_cd_m2 *= 2.0
    scene.hologram.render.spectrum_floor *= 1.5
    assert {"light", "spectrum"} <= set(settle(scene))
    assert display.active_material == own


def test_what_hangs_on_the_filter_stays(registered: Any) -> None:
    scene = add_scene("holographic_sight")
    screen = of_role(scene, Role.FILTER)
    note = cube(scene.collection, "My Note")
    note.parent = screen
    scene.view_layers[0].update()
    place = note.matrix_world.copy()
    scene.hologram.render.mode = "preview"
    settle(scene)
    scene.view_layers[0].update()
    assert Role.FILTER not in {item.hologram.role for item in scene.objects}
    np.testing.assert_allclose(note.matrix_world, place, atol=1e-4)
