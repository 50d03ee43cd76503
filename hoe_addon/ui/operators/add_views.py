# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the 3-D views of a window show of something new."""

from collections.abc import Iterator, Sequence

import bpy
from mathutils import Vector

from ...blender.ids import Role

_CLIP_MM = (1.0, 1e6)
"""From a millimetre to a kilometre."""

_SEEN = (0.02, 1.5)
"""Sizes, over the distance of the view, between which something is neither lost nor too near."""

_AWAY = 2.5
"""Distance that something is shown from, over its size."""


def look_through_camera(window: bpy.types.Window) -> None:
    """Let the 3-D views of a window show what the camera sees, in solid shading.

    Args:
        window: The window; its scene is in millimetres.
    """
    for space in _views(window):
        space.shading.type = "SOLID"
        space.shading.color_type = "MATERIAL"
        space.overlay.show_relationship_lines = False  # a device has dozens, across the picture
        space.clip_start, space.clip_end = _CLIP_MM
        space.lock_camera = False
        space.region_3d.view_perspective = "CAMERA"


def show(context: bpy.types.Context, item: bpy.types.Object) -> None:
    """Turn the 3-D view of a click to something new that would be lost in it, or fill it.

    Args:
        context: Of the operator.
        item: What is new, with all that hangs on it.
    """
    space = context.space_data
    if not isinstance(space, bpy.types.SpaceView3D):
        return
    region = space.region_3d
    low, high = _bounds(item)
    size, middle = (high - low).length, (low + high) / 2.0
    if region.view_perspective == "CAMERA" or not size > 0.0:
        return
    distance = region.view_distance
    near = (middle - region.view_location).length < distance
    if near and _SEEN[0] * distance < size < _SEEN[1] * distance:
        return
    region.view_location, region.view_distance = middle, _AWAY * size
    space.clip_start = min(space.clip_start, 1e-2 * size)
    space.clip_end = max(space.clip_end, 1e3 * size)


def around(scene: bpy.types.Scene, item: bpy.types.Object) -> tuple[str, ...]:
    """Names of the user's bodies that a new object stands inside of, and so sees nothing but.

    Args:
        scene: The scene.
        item: The object.

    Returns:
        Names of meshes whose boxes hold its origin.
    """
    place = item.matrix_world.translation
    return tuple(
        other.name
        for other in scene.objects
        if other.type == "MESH" and other.hologram.role == Role.NONE and _holds(other, place)
    )


def _holds(body: bpy.types.Object, place: Vector) -> bool:
    here = body.matrix_world.inverted_safe() @ place
    low, high = _box([Vector(corner) for corner in body.bound_box])
    return all(low[axis] < here[axis] < high[axis] for axis in range(3))


def _bounds(item: bpy.types.Object) -> tuple[Vector, Vector]:
    """Box around an object and all that hangs on it, in the world."""
    corners = [
        part.matrix_world @ Vector(corner)
        for part in (item, *item.children_recursive)
        if part.type == "MESH" and part.hologram.role != Role.FILTER
        for corner in part.bound_box
    ]
    return _box(corners or [item.matrix_world.translation])


def _box(places: Sequence[Vector]) -> tuple[Vector, Vector]:
    """Least and greatest coordinates."""
    axes = list(zip(*places, strict=True))
    return Vector([min(axis) for axis in axes]), Vector([max(axis) for axis in axes])


def _views(window: bpy.types.Window) -> Iterator[bpy.types.SpaceView3D]:
    for area in window.screen.areas:
        space = area.spaces.active
        if isinstance(space, bpy.types.SpaceView3D):
            yield space
