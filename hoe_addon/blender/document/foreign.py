# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Things in a scene that its document does not know.

A plan leaves out what the light of the document does not need. It knows nothing of other lamps and
mirrors, so where there are any, nothing may be left out.
"""

import bpy

from ..ids import Role, RoomKind

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
    room = scene.hologram.room.collection
    known = set(room.all_objects) if room is not None else set()
    found = [
        item.name
        for item in scene.objects
        if item.type in _SEEN
        and item.hologram.role in _UNKNOWN
        and not item.hide_render
        and item not in known
    ]
    found.sort()
    if scene.hologram.room.kind == RoomKind.NONE and _shines(scene.world):
        found.append(scene.world.name)
    return tuple(found)


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
