# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Luminance of what backward rays end at: the room, emitters, and matte bodies in their light."""

import numpy as np

from ...core.arrays import FloatArray, IntArray, unit
from .bodies import Body, nearest
from .light import ROOM, ROOM_ALBEDO, Component
from .walk import Level, Walk

_SEED = 20260815
_SKY_DIRECTIONS = 6
_ROOM_DISTANCE_MM = 1000.0
"""How far the walls of a room are from its lamps, where they count as lit by them."""


def radiance(
    walked: Walk, level: Level, components: tuple[Component, ...], component: IntArray
) -> FloatArray:
    """Work out what is met at the ends of one level.

    Args:
        walked: The walk.
        level: The level.
        components: The light.
        component: Number of the component whose wavelength each root has, shape ``(n,)``.

    Returns:
        Luminance of the light that each ray's wavelength stands for, cd/m^2; 0 where a ray goes on.
    """
    found = np.zeros(len(level.body))
    own = component[level.rays.root]
    rooms = np.array([not each.emitter for each in components])
    white = np.array([each.luminance for each in components])
    at_room = level.end & (level.body == ROOM)
    has_room = bool(rooms.any())
    found[at_room & rooms[own]] = ROOM_ALBEDO * white[own][at_room & rooms[own]]
    if has_room:
        area = np.array([each.area_mm2 for each in components])
        lit = white * np.minimum(area / (np.pi * _ROOM_DISTANCE_MM**2), 1.0)
        others = at_room & ~rooms[own]
        found[others] = ROOM_ALBEDO * lit[own][others]
    for number, body in enumerate(walked.bodies):
        there = np.flatnonzero(level.end & (level.body == number))
        if there.size == 0:
            continue
        points, way = body.local(level.points[there], level.rays.way[there])
        if body.emits is not None:
            names = np.array([each.emitter == body.name for each in components])
            found[there] += np.where(
                body.emits(points, way) & names[own[there]], white[own[there]], 0
            )
        if body.reflectance > 0.0:
            lit_by = _light_on(walked.bodies, level, there, components, own[there])
            found[there] += body.reflectance * lit_by
    return found


def _light_on(
    bodies: tuple[Body, ...],
    level: Level,
    there: IntArray,
    components: tuple[Component, ...],
    own: IntArray,
) -> FloatArray:
    """Luminance of white at matte bodies: the open part of the room, and lamps without shadows."""
    points = level.points[there]
    found = np.zeros(len(there))
    origins = {body.name: body.origin for body in bodies}
    for number, component in enumerate(components):
        chosen = own == number
        if not chosen.any():
            continue
        if not component.emitter:
            found[chosen] = component.luminance * _open_share(
                bodies, points[chosen], level.rays.way[there][chosen]
            )
        else:
            away = points[chosen] - origins[component.emitter]
            filled = component.area_mm2 / (np.pi * np.maximum(np.sum(away**2, axis=1), 1e-6))
            found[chosen] = component.luminance * np.minimum(filled, 1.0)
    return found


def _open_share(bodies: tuple[Body, ...], points: FloatArray, way: FloatArray) -> FloatArray:
    """Share of the half space before matte points, toward the eye's ray, that shows the room."""
    rng = np.random.default_rng(_SEED)
    start = points - 1e-3 * way
    seen = np.zeros(len(points))
    for _ in range(_SKY_DIRECTIONS):
        up = unit(rng.standard_normal((len(points), 3)) - 1.2 * way)
        which, _ = nearest(bodies, start, up, np.full(len(points), -1))
        seen += which == ROOM
    return seen / _SKY_DIRECTIONS
