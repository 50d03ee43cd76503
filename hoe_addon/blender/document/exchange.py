# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on made is exchanged or taken away; whatever is the user's stays."""

from collections.abc import Callable, Hashable, Iterable, Set

import bpy

from ..build.element import ERROR_PROPERTY
from ..ids import Role
from ..marks import is_made


def join_parts(
    owner: bpy.types.Object,
    made: Iterable[bpy.types.Object],
    kind_of: Callable[[bpy.types.Object], Hashable],
) -> None:
    """Let the parts of an element be what new ones are; one that is gone is there again.

    Args:
        owner: What the parts hang on.
        made: The new parts.
        kind_of: What a part is; an old and a new part of a kind are one.
    """
    there = [child for child in owner.children if child.hologram.role == Role.PART]
    for new in list(made):
        old = next((part for part in there if kind_of(part) == kind_of(new)), None)
        if old is None:
            new.parent, new.hologram.role = owner, Role.PART
            continue
        exchange_mesh(old, new.data)
        old.location = new.location
        if ERROR_PROPERTY in new:
            old[ERROR_PROPERTY] = new[ERROR_PROPERTY]
        bpy.data.objects.remove(new)


def exchange_mesh(item: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """Give an object another mesh and the materials in it, but for those that the user put there.

    Args:
        item: A mesh object.
        mesh: The new mesh; slots that it has no material for keep theirs.
    """
    new, held = list(mesh.materials), [slot.material for slot in item.material_slots]
    for place, slot in enumerate(item.material_slots):
        stays = slot.material is not None and not is_made(slot.material)
        if place >= len(new):
            mesh.materials.append(item.data.materials[place])
        elif slot.link == "DATA" and stays:
            mesh.materials[place] = slot.material
        elif slot.link == "OBJECT" and not stays:
            slot.material = new[place]
    put_mesh(item, mesh, (*new, *held))


def put_mesh(
    item: bpy.types.Object,
    mesh: bpy.types.Mesh,
    spare: Iterable[bpy.types.Material | None] = (),
) -> None:
    """Give an object another mesh, and remove what the add-on made and nothing uses any more.

    Args:
        item: A mesh object.
        mesh: The new mesh, with its materials.
        spare: Materials that may be without a user now, beside those of the old mesh.
    """
    old, name = item.data, item.data.name
    item.data = mesh
    _drop(old, spare)
    mesh.name = name


def remove(item: bpy.types.Object) -> None:
    """Remove an object that the add-on made; what the user hung on it stays where it is.

    Args:
        item: The object.
    """
    mesh = item.data
    places = [(child, child.matrix_world.copy()) for child in item.children]
    bpy.data.objects.remove(item)
    for child, place in places:
        child.matrix_world = place
    if isinstance(mesh, bpy.types.Mesh):
        _drop(mesh)


def take_out(item: bpy.types.Object, collections: Set[bpy.types.Collection]) -> None:
    """Take a part of the room out of it, and remove it unless the user has it elsewhere too.

    Args:
        item: The object.
        collections: All collections of the room.
    """
    elsewhere = set(item.users_collection) - collections
    if not elsewhere:
        remove(item)
        return
    for collection in set(item.users_collection) & collections:
        collection.objects.unlink(item)
    item.hologram.role = Role.NONE  # the user's from now on


def _drop(mesh: bpy.types.Mesh, spare: Iterable[bpy.types.Material | None] = ()) -> None:
    # One material may be in several slots.
    materials = {each for each in (*mesh.materials, *spare) if is_made(each)}
    if is_made(mesh) and not mesh.users:
        bpy.data.meshes.remove(mesh)
    bpy.data.batch_remove([each for each in materials if each is not None and not each.users])
