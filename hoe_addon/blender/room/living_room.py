# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A living room, as seen behind a light guide: the eye at the origin looks along +y, z is up."""

import bpy

from ..build import meshes
from . import materials as materials
from . import shapes as shapes
from .bookcase import add_bookcase
from .furniture import FLOOR, WALL, add_lamp, add_picture, add_plant, add_sofa
from .lights import add_window

_LEFT, _RIGHT = -2000.0, 2000.0
_BACK, _CEILING = -1500.0, 1400.0

_WHITE_OF_UNIT_LIGHT = 0.296
"""Luminance of a white card in the middle of the room, its lights at their base strength."""


def add_living_room(collection: bpy.types.Collection, white: float) -> None:
    """Add a room with sofa, bookcase, plant, picture, lamp, and daylight from the left.

    One scene unit is 1 mm. The room is closed; its floor is at z = -1150, its far wall at
    y = 4400. The middle of the view is a calm wall.

    Args:
        collection: Where its objects are linked.
        white: Scene-linear value of a white card at (0, 2500, 0) that faces the eye.
    """
    unit = white / _WHITE_OF_UNIT_LIGHT
    _add_shell(collection)
    _add_daylight(collection, unit)
    add_sofa(collection)
    add_bookcase(collection)
    add_picture(collection)
    add_lamp(collection, unit)
    add_plant(collection)


def _add_shell(collection: bpy.types.Collection) -> None:
    paint = materials.matte("Wall Paint", (0.130, 0.165, 0.157))
    pale = materials.matte("Pale Paint", (0.62, 0.60, 0.56))
    wood = materials.matte("Floorboards", (0.26, 0.16, 0.09))
    low, high = (_LEFT, _BACK, FLOOR), (_RIGHT, WALL, _CEILING)
    shell = shapes.box(low, high)
    # Faces of a box: left, right, front, back, floor, ceiling; seen from inside, so turned over.
    inside = shapes.Shape(shell.corners, shell.faces[:, ::-1])
    room = meshes.add(collection, inside.mesh("Room"), pale, paint, wood)
    room.data.polygons.foreach_set("material_index", [0, 1, 0, 1, 2, 0])
    rug = shapes.box((-1100.0, 2300.0, FLOOR), (1100.0, 3700.0, FLOOR + 12.0))
    wool = materials.matte("Rug", (0.42, 0.38, 0.32))
    meshes.add(collection, rug.mesh("Rug"), wool)


def _add_daylight(collection: bpy.types.Collection, unit: float) -> None:
    """A window in the left wall and a wider, fainter one behind the eye."""
    add_window(
        collection, (_LEFT + 5.0, 2450.0, 400.0), (1900.0, 1500.0), (1.0, 0.0, 0.0), 5.0 * unit
    )
    add_window(collection, (0.0, _BACK + 5.0, 400.0), (2400.0, 1400.0), (0.0, 1.0, 0.0), 1.0 * unit)
