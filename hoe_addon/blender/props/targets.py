# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens when an object that is a recording source is deleted.

Blender gives drivers whose object is gone the value 0, which would put the source into the origin
without a word. So the places are remembered; when the object goes, the last one stays in the shader
and the problem stands in the hologram's properties. An object that was only taken out of the scene
still has its place.
"""

from collections.abc import Iterator

import bpy
from bpy.app.handlers import persistent

from ...core.errors import HoeError
from ...shading.following import FRAME_SOCKETS, ROLES, frame_socket
from ..ids import PatternKind
from .followed import out_of_scene, read_followed
from .shader_node import hologram_node

_EVENTS = ("depsgraph_update_post", "frame_change_post", "load_post")

type _Places = dict[str, tuple[float, float, float]]

_remembered: dict[tuple[int, str], _Places] = {}
"""Last values of a role's sockets, by the material's session id and role."""


def register() -> None:
    """Watch the scene."""
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).append(_watch)


def unregister() -> None:
    """Watch no more."""
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).remove(_watch)
    _remembered.clear()


@persistent
def _watch(*_arguments: object) -> None:
    for material, role, group in _following():
        node = hologram_node(material)
        if node is None:
            continue
        sockets = [s for s in node.inputs if s.identifier in _names(role)]
        key = (material.session_uid, role)
        if group.target is not None:
            _remembered[key] = {s.identifier: tuple(s.default_value) for s in sockets}
            lost = out_of_scene(material)
            if lost and material.hologram.problem != lost:
                material.hologram.problem = lost
        elif key in _remembered:
            _keep(material, sockets, _remembered.pop(key))


def _following() -> Iterator[tuple[bpy.types.Material, str, bpy.types.PropertyGroup]]:
    for material in bpy.data.materials:
        hologram = material.hologram
        if (
            hologram.enabled
            and material.library is None
            and hologram.pattern == PatternKind.RECORDING
        ):
            for role in ROLES:
                group = getattr(hologram.recording, role)
                if group.follows:
                    yield material, role, group


def _names(role: str) -> frozenset[str]:
    return frozenset(frame_socket(role, field) for field in FRAME_SOCKETS)


def _keep(
    material: bpy.types.Material, sockets: list[bpy.types.NodeSocket], places: _Places
) -> None:
    """Take the drivers away, leave the last place, and say what is wrong."""
    for socket in sockets:
        socket.driver_remove("default_value")
        socket.default_value = places[socket.identifier]
    try:
        read_followed(material)
    except HoeError as error:
        material.hologram.problem = str(error)
