# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording sources that are objects of the scene: drivers carry their place to the shader.

Drivers follow moves, parents and animation frame by frame, also in a .blend on a machine without
this add-on. They are plain sums and products of the object's world transform, which Blender
evaluates without asking for permission to run scripts.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import SpecError
from ...model.motion import moved
from ...model.waves import PlaneWaveSpec, PointSourceSpec, WaveSpec
from ...shading.following import FRAME_SOCKETS, ROLES, frame_socket

_PLACE = {"px": "LOC_X", "py": "LOC_Y", "pz": "LOC_Z"}
_TURN = {"w": "ROT_W", "x": "ROT_X", "y": "ROT_Y", "z": "ROT_Z"}

_EXPRESSIONS = {
    "origin": ("px", "py", "pz"),
    "x": ("1 - 2*(y*y + z*z)", "2*(x*y + w*z)", "2*(x*z - w*y)"),
    "y": ("2*(x*y - w*z)", "1 - 2*(x*x + z*z)", "2*(y*z + w*x)"),
}
"""Columns of the rotation matrix of a unit quaternion."""


@dataclass(frozen=True)
class Followed:
    """A recording wave that follows an object.

    Attributes:
        target: The object.
        wave: The wave in the object's own frame; lengths are in mm whatever its scale.
    """

    target: bpy.types.Object
    wave: WaveSpec


def lamp_like(wave: WaveSpec) -> WaveSpec:
    """The wave that an object gives by itself: from its origin, or along its -z as lamps shine.

    Args:
        wave: A wave; kind, beam and index are taken from it.

    Returns:
        A point in the origin, or a plane wave along -z; other kinds as they are.
    """
    match wave:
        case PlaneWaveSpec():
            return PlaneWaveSpec(direction=(0.0, 0.0, -1.0), index=wave.index)
        case PointSourceSpec():
            return PointSourceSpec(position_mm=(0.0, 0.0, 0.0), beam=wave.beam, index=wave.index)
        case _:
            return wave


def waves_of(followed: Mapping[str, Followed]) -> dict[str, WaveSpec]:
    """What the shading layer needs to know.

    Args:
        followed: Waves by role.

    Returns:
        The same without the objects.
    """
    return {role: entry.wave for role, entry in followed.items()}


def drive(node: bpy.types.Node, followed: Mapping[str, Followed]) -> None:
    """Let the sockets of a hologram's shader follow objects; others follow nothing any more.

    Args:
        node: The Script node; it has the sockets of the followed roles.
        followed: Waves by role.
    """
    sockets = {socket.identifier: socket for socket in node.inputs}
    for role, field in product(ROLES, FRAME_SOCKETS):
        socket = sockets.get(frame_socket(role, field))
        if socket is not None:
            socket.driver_remove("default_value")
            if role in followed:
                _drive(socket, followed[role].target, _EXPRESSIONS[field])


def in_frame_of(
    followed: Followed, carrier: bpy.types.Object | None, frame: NDArray[np.float64], units: float
) -> WaveSpec:
    """The numbers of a followed wave in the frame of a hologram, as they are now.

    Args:
        followed: The wave.
        carrier: Object that carries the hologram; None stands for one at the world's origin.
        frame: Frame of the recording in the carrier's space, in scene units, shape ``(4, 4)``.
        units: Scene units in one mm.

    Returns:
        The wave in the frame of the recording.

    Raises:
        SpecError: The object is too far away for a document, or the carrier has no volume.
    """
    here = frame if carrier is None else np.array(carrier.matrix_world) @ frame
    lengths = np.linalg.norm(here[:3, :3], axis=0)
    if not lengths.min() > 0.0:
        raise SpecError(f"object {carrier and carrier.name}: must not be scaled to nothing")
    # As in the shader: directions by unit axes at right angles, places by the object's matrix.
    there = np.array(followed.target.matrix_world.to_quaternion().to_matrix())
    rotation = _unit_axes(here[:3, :3]).T @ there
    away = np.array(followed.target.matrix_world.translation) - here[:3, 3]
    origin = np.linalg.solve(here[:3, :3], away)
    return moved(followed.wave, rotation, origin / units)


def _unit_axes(mapped: NDArray[np.float64]) -> NDArray[np.float64]:
    """Axes at right angles by columns: x as mapped, z normal to the mapped plane z = 0."""
    hand = -1.0 if np.linalg.det(mapped) < 0.0 else 1.0
    x = mapped[:, 0] / np.linalg.norm(mapped[:, 0])
    z = hand * np.cross(mapped[:, 0], mapped[:, 1])
    z /= np.linalg.norm(z)
    return np.stack((x, hand * np.cross(z, x), z), axis=1)


def _drive(
    socket: bpy.types.NodeSocket, target: bpy.types.Object, expressions: tuple[str, ...]
) -> None:
    for component, expression in enumerate(expressions):
        driver = socket.driver_add("default_value", component).driver
        driver.type = "SCRIPTED"
        for name, transform in {**_PLACE, **_TURN}.items():
            if not re.search(rf"\b{name}\b", expression):
                continue
            variable = driver.variables.new()
            variable.name = name
            variable.type = "TRANSFORMS"
            source = variable.targets[0]
            source.id = target
            source.transform_type = transform
            source.transform_space = "WORLD_SPACE"
            source.rotation_mode = "QUATERNION"
        driver.expression = expression
