# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects of a scene are elements of its document, and which holograms they carry."""

from collections.abc import Iterator

import bpy

from ...model.scene_lens import Face
from ..ids import Role

_ROLES = frozenset(
    (Role.HOLOGRAM, Role.LENS, Role.DISPLAY, Role.LAMP, Role.CARD, Role.BLOCK, Role.HOLDER)
)
"""Roles of objects that are elements of a scene's document."""


def element_objects(scene: bpy.types.Scene) -> Iterator[bpy.types.Object]:
    """Objects that are elements of a scene's document, in its order, then that of their names.

    What is linked from another file is part of a device there: here it counts only where it hangs
    on the root of the scene's own.

    Args:
        scene: The scene.
    """
    root = scene.hologram.root
    for item in sorted(scene.objects, key=lambda each: (each.hologram.rank, each.name)):
        if item.hologram.role in _ROLES and (item.library == scene.library or _hangs(item, root)):
            yield item


def rank_of(scene: bpy.types.Scene, item: bpy.types.Object) -> int:
    """Where an object stands among the elements of a scene: a new one comes last.

    Args:
        scene: The scene.
        item: The object, an element or not yet.
    """
    ranks = {each: each.hologram.rank for each in element_objects(scene)}
    return ranks[item] if item in ranks else max(ranks.values(), default=-1) + 1


def elements_by_name(scene: bpy.types.Scene) -> dict[str, bpy.types.Object]:
    """Elements of a scene's document by name; the scene may hold linked objects of equal names.

    Args:
        scene: A scene with a valid document, in which each name is used once.
    """
    return {item.name: item for item in element_objects(scene)}


def hologram_slot(item: bpy.types.Object) -> bpy.types.Material | None:
    """The first material of an object that is a hologram, or None."""
    for slot in item.material_slots:
        if slot.material is not None and slot.material.hologram.enabled:
            return slot.material
    return None


def face_of(child: bpy.types.Object) -> Face:
    """Which face of a lens a part of it is."""
    return "front" if child.location.z > 0.0 else "back"


def _hangs(item: bpy.types.Object, root: bpy.types.Object | None) -> bool:
    above = item.parent
    while above is not None and above != root:
        above = above.parent
    return above is not None
