# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording wave that follows an object of the scene.

The numbers of such a wave are those in the frame of the object, in units of the hologram's object,
so that they grow with the hologram; where that frame lies in the world comes through three sockets,
which drivers keep up to date. So any kind of wave can follow, and the shader needs no new text when
the object moves.
"""

from dataclasses import replace

from .part import ShaderPart, parameter

ROLES = ("object", "reference")
"""The two recording waves."""

FRAME_SOCKETS = ("origin", "x", "y")


def frame_socket(role: str, field: str) -> str:
    """Identifier of a socket that says where the followed object is.

    Args:
        role: One of `ROLES`.
        field: One of `FRAME_SOCKETS`.

    Returns:
        The identifier.
    """
    return f"{role}_world_{field}"


def following(role: str, part: ShaderPart) -> ShaderPart:
    """Let a wave's code work in the frame of the followed object.

    Args:
        role: One of `ROLES`.
        part: The wave's part; its numbers are those in the frame of the object.

    Returns:
        The part that reads ``position`` and adds to ``gradient`` in the recording's frame.
    """
    origin, x, y = (frame_socket(role, field) for field in FRAME_SOCKETS)
    label = role.title()
    sockets = (
        parameter("vector", origin, "vector(0.0)", f"{label} World Origin", "Its place, in world"),
        parameter("vector", x, "vector(1.0, 0.0, 0.0)", f"{label} World X", "Its x axis, in world"),
        parameter("vector", y, "vector(0.0, 1.0, 0.0)", f"{label} World Y", "Its y axis, in world"),
    )
    here, there = f"{role}_place", f"{role}_gradient"
    code = (
        f"vector {here} = position; vector {there} = gradient; gradient = vector(0.0); "
        f"vector {role}_z = cross({x}, {y}); "
        f'vector {role}_away = vector(transform("object", "common", point(frame_origin + '
        f"position[0] * frame_x + position[1] * frame_y + position[2] * frame_z))) - {origin}; "
        f"{role}_away /= length(mapped_x); "
        f"position = vector(dot({role}_away, {x}), dot({role}_away, {y}), "
        f"dot({role}_away, {role}_z)); "
        f"{part.code} "
        f"vector {role}_world = gradient[0] * {x} + gradient[1] * {y} + gradient[2] * {role}_z; "
        f"gradient = {there} + vector(dot({role}_world, axis_x), dot({role}_world, axis_y), "
        f"dot({role}_world, axis_z)); position = {here};"
    )
    return replace(part, parameters=f"{part.parameters} {' '.join(sockets)}", code=code)
