# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights of the room: few and large, so that a render has little noise."""

import math
from collections.abc import Sequence

import bpy
from mathutils import Vector

from .materials import Colour

AMBIENT = "ambient"
"""Light group of all that gives light in the room."""

_SKY: Colour = (0.92, 0.98, 1.06)


def add_window(
    collection: bpy.types.Collection,
    centre: Sequence[float],
    size: tuple[float, float],
    inward: Sequence[float],
    radiance: float,
) -> None:
    """Add a bright upright rectangle, the sky in a window.

    Args:
        collection: Where it is linked.
        centre: Its middle, in scene units.
        size: Width and height.
        inward: Level direction into the room.
        radiance: In scene units, before its faintly blue colour.
    """
    light = bpy.data.lights.new("Window", "AREA")
    light.shape = "RECTANGLE"
    light.size, light.size_y = size
    light.color = _SKY
    light.energy = math.pi * size[0] * size[1] * radiance
    _add(collection, light, centre).rotation_euler = (
        Vector(inward).to_track_quat("-Z", "Y").to_euler()
    )


def add_ball_light(
    collection: bpy.types.Collection,
    centre: Sequence[float],
    radius: float,
    colour: Colour,
    radiance: float,
) -> None:
    """Add a glowing ball.

    Args:
        collection: Where it is linked.
        centre: Its middle, in scene units.
        radius: Its radius.
        colour: Its colour.
        radiance: In scene units, before the colour.
    """
    light = bpy.data.lights.new("Lamp", "POINT")
    light.shadow_soft_size = radius
    light.color = colour
    light.energy = 4.0 * math.pi**2 * radius**2 * radiance
    _add(collection, light, centre)


def _add(
    collection: bpy.types.Collection, light: bpy.types.Light, centre: Sequence[float]
) -> bpy.types.Object:
    item = bpy.data.objects.new(light.name, light)
    item.location = centre
    item.lightgroup = AMBIENT
    collection.objects.link(item)
    return item
