# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders that send exact rays through a hologram and read back what became of them."""

import numpy as np
from numpy.typing import NDArray

from .part import ShaderPart
from .source import ShaderSource, array, specialised

MISSED = 4.0
"""What hoe_probe_direction answers for a ray that met nothing; no direction has it."""

UNRECORDED = 8.0
"""What a hologram answers where nothing is recorded, for an order that is then not there."""


def ray_camera_shader(origin: NDArray[np.float64], direction: NDArray[np.float64]) -> ShaderSource:
    """A camera whose pixel rows, from the bottom, are these rays.

    Args:
        origin: Start points in scene units, in the camera's frame, shape ``(n, 3)``.
        direction: Unit directions there, shape ``(n, 3)``.

    Returns:
        The flat text.
    """
    numbers = np.concatenate((origin, direction), axis=1).ravel()
    return specialised(
        "hoe_probe_camera",
        {
            "HOE_RAYS": str(len(origin)),
            "HOE_RAY_NUMBERS": str(numbers.size),
            "HOE_RAY_TABLE": array(numbers),
        },
    )


def direction_world_shader() -> ShaderSource:
    """The world that answers with directions."""
    return specialised("hoe_probe_direction", {})


def first_hit_only(source: ShaderSource) -> ShaderSource:
    """A hologram whose second hit by the same ray, on a curved surface, changes nothing.

    Args:
        source: The hologram's shader.

    Returns:
        The flat text.
    """
    return ShaderSource(source.name, f"#define HOE_FIRST_HIT_ONLY 1\n{source.text}")


def position_shader(part: ShaderPart | None = None) -> ShaderSource:
    """The surface that answers with the point where it is hit.

    Args:
        part: What moves the hit from a facet onto the true surface, if anything does.

    Returns:
        The flat text.
    """
    if part is None:
        return specialised("hoe_probe_position", {})
    definitions = {"HOE_SURFACE_PARAMETERS": part.parameters, "HOE_FIND_NORMAL": part.code}
    return specialised("hoe_probe_position", definitions, part.functions)
