# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a scene one in which one unit is one millimetre, as holograms need it.

Cycles starts rays a fixed small distance off a surface. Where a unit is a metre, the parts of a
device are not much larger than that, and its light goes wrong.
"""

import bpy

from ..core.errors import HoeError
from .ids import Role
from .unit_scaling import Scaler

MILLIMETRE = 1e-3
"""Metres in one scene unit."""

_NEAR = 1e-6

_IN_WORLD = ("LIMIT_LOCATION", "LIMIT_DISTANCE", "LIMIT_SCALE", "FLOOR", "TRANSFORM")
"""Constraints with lengths of their own."""


def in_millimetres(scene: bpy.types.Scene) -> bool:
    """Tell whether one unit of a scene is one millimetre."""
    return abs(scene.unit_settings.scale_length / MILLIMETRE - 1.0) < _NEAR


def use_millimetres(scene: bpy.types.Scene) -> None:
    """Say that one unit is one millimetre, and scale nothing."""
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.scale_length = MILLIMETRE
    scene.unit_settings.length_unit = "MILLIMETERS"


def scale_to_millimetres(scene: bpy.types.Scene) -> tuple[str, ...]:
    """Scale all that is not the add-on's, so that one unit is one millimetre.

    Everything keeps its true size and the picture stays the same. What the add-on has made is
    in millimetres already and stays.

    Args:
        scene: The scene.

    Returns:
        What could not be scaled, in words; mostly nothing.

    Raises:
        HoeError: An object cannot be scaled; nothing is changed then.
    """
    if in_millimetres(scene):
        return ()
    factor = scene.unit_settings.scale_length / MILLIMETRE
    own = {item for item in scene.objects if not is_made_here(scene, item)}
    _check(scene, own)
    scaler = Scaler(factor)
    for item in sorted(own, key=lambda each: each.name):
        if item.parent is None or item.parent.name not in scene.objects:
            scaler.object(item)
        for part in _parts(item):
            scaler.data(part.data)
            for slot in part.material_slots:
                if slot.material is not None:
                    scaler.shader(slot.material)
        limits = [each.name for each in item.constraints if each.type in _IN_WORLD]
        scaler.notes += [f"{item.name}: constraint {name} has lengths" for name in limits]
    if scene.world is not None:
        scaler.shader(scene.world)
        scene.world.mist_settings.start *= factor
        scene.world.mist_settings.depth *= factor
    scene.cursor.location *= factor
    use_millimetres(scene)
    return tuple(dict.fromkeys(scaler.notes))


def is_made_here(scene: bpy.types.Scene, item: bpy.types.Object) -> bool:
    """Tell whether an object has its size in millimetres already.

    Args:
        scene: The scene.
        item: One of its objects.

    Returns:
        Whether it is part of a device or its room, or carries a hologram.
    """
    room = scene.hologram.room.collection
    return (
        item.hologram.role != Role.NONE
        or (room is not None and item.name in room.all_objects)
        or any(
            slot.material is not None and slot.material.hologram.enabled
            for slot in item.material_slots
        )
    )


def _parts(item: bpy.types.Object) -> list[bpy.types.Object]:
    """An object, and what it shows as an instance."""
    shown = item.instance_collection
    return [item, *(shown.all_objects if shown is not None else ())]


def _check(scene: bpy.types.Scene, own: set[bpy.types.Object]) -> None:
    if scene.library is not None:
        raise HoeError(f"scene {scene.name}: comes from another file; scale it there")
    for item in sorted(own, key=lambda each: each.name):
        _check_own(scene, item)
    for item in scene.objects:
        if item not in own and item.parent in own:
            raise HoeError(
                f"object {item.name}: hangs on {item.parent.name}; clear its parent first "
                "(Object > Parent > Clear and Keep Transformation)"
            )


def _check_own(scene: bpy.types.Scene, item: bpy.types.Object) -> None:
    for block in (item, *(part.data for part in _parts(item))):
        scaled = isinstance(block, bpy.types.Light | bpy.types.Camera | bpy.types.Object)
        if scaled and block.library is not None:
            raise HoeError(
                f"{block.name}: comes from another file; make it local first "
                "(Object > Relations > Make Local)"
            )
    for other in item.users_scene:
        if other != scene:
            raise HoeError(
                f"object {item.name}: stands in scene {other.name} too; make it a copy of its "
                "own first (Object > Relations > Make Single User)"
            )
