# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A device that was deleted: its document goes when another one comes, for undo may need it."""

import bpy

from ..ids import DeviceKind, Role
from ..props import changes
from . import exchange
from .held import has_device
from .places import is_in

_NO_PARTS = frozenset((Role.NONE, Role.FILTER, Role.PART, Role.ROOM))
"""Roles of what does not make a device: nothing of one, or what hangs on one."""

_KEPT = frozenset(("rna_type", "name", "overlay", "render"))
"""What of a document are choices of the user's that hold for another device too."""


def is_gone(scene: bpy.types.Scene) -> bool:
    """Tell whether a scene holds the document of a device of which no element is left."""
    if scene.hologram.kind == DeviceKind.NONE or has_device(scene):
        return False
    here = (item for item in scene.objects if item.library == scene.library)
    return all(item.hologram.role in _NO_PARTS for item in here)


def clear_gone(scene: bpy.types.Scene) -> None:
    """Let a scene hold no document, where its device is gone, and remove what cannot be selected.

    Args:
        scene: The scene.
    """
    if not is_gone(scene):
        return
    room = scene.hologram.room.collection
    with changes.unmarked():
        for field in set(scene.hologram.bl_rna.properties.keys()) - _KEPT:
            scene.hologram.property_unset(field)
    here = {scene.collection, *scene.collection.children_recursive}
    for item in list(scene.objects):
        hung = item.hologram.role in (Role.FILTER, Role.PART)
        if hung and (item.parent is None or not is_in(scene, item.parent)):
            exchange.take_out(item, here)
    if room in here and not (room.all_objects or room.children):
        for collection in here - {room}:
            if room.name in collection.children:
                collection.children.unlink(room)
        if not room.users:
            bpy.data.collections.remove(room)
