# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Backdrops: a desk, open land with a target, a road from a car, a wall.

The eye at the origin looks along +y, z is up, one scene unit is 1 mm. All are lit so that a white
card that faces the eye, or the sky where there is one, has about the luminance asked for.
"""

from collections.abc import Callable, Mapping

import bpy

from ..build import meshes
from . import materials as materials
from . import shapes as shapes
from .lights import add_window
from .outdoor import add_range, add_road

_WALL_UNIT = 0.125
"""Luminance of a white card on the wall or over the desk with lights of unit radiance."""

DESK_TOP = -120.0
"""Height of the desk."""

_WALL_AT, _DESK_WALL_AT = 2000.0, 1100.0


def add_backdrop(
    scene: bpy.types.Scene, collection: bpy.types.Collection, kind: str, white: float
) -> None:
    """Add a backdrop.

    Args:
        scene: The scene; outdoors it gets a sky.
        collection: Where its objects are linked.
        kind: ``desk``, ``range``, ``road`` or ``wall``.
        white: Scene-linear value of something white in it.
    """
    _KINDS[kind](scene, collection, white)


def _add_wall(_scene: bpy.types.Scene, collection: bpy.types.Collection, white: float) -> None:
    """A plain wall at y = 2000 and a floor, dimly lit from behind the eye."""
    paint = materials.matte("Wall Paint", (0.32, 0.33, 0.35))
    wood = materials.mottled(
        "Floorboards", ((0.16, 0.10, 0.06), (0.22, 0.14, 0.08)), (60.0, 900.0, 9.0)
    )
    wall = shapes.box((-6000.0, _WALL_AT, -1000.0), (6000.0, _WALL_AT + 100.0, 3000.0))
    floor = shapes.box((-6000.0, -2000.0, -1100.0), (6000.0, _WALL_AT, -1000.0))
    board = shapes.box((-6000.0, _WALL_AT - 15.0, -1000.0), (6000.0, _WALL_AT, -900.0))
    meshes.add(collection, wall.mesh("Wall"), paint)
    meshes.add(collection, floor.mesh("Floor"), wood)
    pale = materials.matte("Skirting", (0.55, 0.55, 0.53))
    meshes.add(collection, board.mesh("Skirting"), pale)
    radiance = white / _WALL_UNIT
    add_window(collection, (0.0, -1800.0, 900.0), (2600.0, 1800.0), (0.0, 1.0, 0.0), radiance)


def _add_desk(_scene: bpy.types.Scene, collection: bpy.types.Collection, white: float) -> None:
    """A wooden desk top at z = -120 and a wall behind it, lit from the left and from behind."""
    paint = materials.matte("Wall Paint", (0.20, 0.235, 0.25))
    wood = materials.mottled(
        "Desk Top", ((0.20, 0.115, 0.06), (0.29, 0.175, 0.095)), (260.0, 22.0, 22.0)
    )
    top = shapes.box((-1500.0, -200.0, DESK_TOP - 30.0), (1500.0, _DESK_WALL_AT, DESK_TOP))
    wall = shapes.box((-4000.0, _DESK_WALL_AT, -1000.0), (4000.0, _DESK_WALL_AT + 50.0, 2500.0))
    meshes.add(collection, top.mesh("Desk"), wood)
    meshes.add(collection, wall.mesh("Wall"), paint)
    radiance = white / _WALL_UNIT
    side, behind = (1.0, 0.15, -0.25), (0.0, 1.0, -0.2)
    add_window(collection, (-1400.0, 300.0, 700.0), (1100.0, 1000.0), side, 1.2 * radiance)
    add_window(collection, (300.0, -1100.0, 800.0), (1200.0, 900.0), behind, 0.9 * radiance)


_KINDS: Mapping[str, Callable[[bpy.types.Scene, bpy.types.Collection, float], None]] = {
    "desk": _add_desk,
    "range": add_range,
    "road": add_road,
    "wall": _add_wall,
}
