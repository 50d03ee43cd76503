# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Things in a scene that its document does not know.

A plan leaves out what the light of the document does not need. It knows nothing of other lamps and
mirrors, so where there are any, nothing may be left out.
"""

import bpy

from ..ids import Role

_SEEN = frozenset(
    ("MESH", "CURVE", "SURFACE", "META", "FONT", "CURVES", "POINTCLOUD", "VOLUME", "LIGHT")
)
"""Types of object that a render shows."""

_UNKNOWN = frozenset((Role.NONE, Role.IDEAL_LENS, Role.SLAB, Role.GLASS))
"""Roles that documents have no words for."""


def things(scene: bpy.types.Scene) -> tuple[str, ...]:
    """Names of what a render shows and the document does not know.

    Args:
        scene: A scene that holds a document.

    Returns:
        Names of objects, in order; last the world, where it gives light.
    """
    room = scene.hologram.room
    in_room = set(room.collection.all_objects) if room.collection is not None else set()
    found = sorted(
        item.name
        for item in scene.objects
        if (item.hologram.role != Role.ROOM if item in in_room else _is_unknown(scene, item))
        and _shows(item)
    )
    if scene.world != room.world and _shines(scene.world):
        found.append(scene.world.name)
    return tuple(found)


def _is_unknown(scene: bpy.types.Scene, item: bpy.types.Object) -> bool:
    """Tell whether an object outside the room is none that the document was made into."""
    role = item.hologram.role
    # What is linked is part of a device in its own file.
    return role in _UNKNOWN or role == Role.ROOM or item.library != scene.library


def _shows(item: bpy.types.Object, above: tuple[bpy.types.Collection, ...] = ()) -> bool:
    """Tell whether a render shows an object, or what a collection has that it is an instance of.

    Args:
        item: The object.
        above: Collections that it is an instance in; one may come back in itself.
    """
    if item.hide_render:
        return False
    if item.type in _SEEN:
        return True
    inside = item.instance_collection if item.instance_type == "COLLECTION" else None
    if inside is None or inside in above:
        return False
    return any(_shows(each, (*above, inside)) for each in inside.all_objects)


def _shines(world: bpy.types.World | None) -> bool:
    """Tell whether a world may give light; only a plain black one surely gives none."""
    if world is None:
        return False
    tree = world.node_tree
    if tree is None:
        return max(world.color) > 0.0
    for node in tree.nodes:
        if node.bl_idname == "ShaderNodeBackground":
            strength, colour = node.inputs["Strength"], node.inputs["Color"]
            plain = not strength.is_linked and not colour.is_linked
            if not plain or strength.default_value * max(colour.default_value[:3]) > 0.0:
                return True
        elif node.bl_idname not in ("ShaderNodeOutputWorld",):
            return True
    return False
