# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Terms of grad V that come from a map: what has to be baked, and how the shader takes it.

The shader has two sockets, which an Image Texture feeds: the gradient, and how much of what it is
made of is recorded. Without these links nothing is recorded, so light goes straight on.
"""

from ..core.gradient_map import RECORDED_SHARE
from ..model.characteristic import CharacteristicSpec
from ..model.map_source import MapSource
from ..model.surface import SurfaceSpec
from ..model.waves import WAVES, WaveSpec
from .part import ShaderPart, parameter
from .source import ShaderSource, specialised
from .surface import surface_part

_MISSING = "vector(1.0, 0.0, 1.0)"
"""What Cycles gives for an image whose file is gone; no gradient has exactly this value."""

GRADIENT_SOCKET, RECORDED_SOCKET = "map_gradient", "map_recorded"


def by_map(sign: str, term: WaveSpec | CharacteristicSpec) -> ShaderPart:
    """The part of a wave or a characteristic function that no code gives.

    Args:
        sign: ``+`` or ``-``: how its gradient goes into ``gradient``.
        term: The wave or the function.

    Returns:
        A part that only asks for a map.
    """
    return ShaderPart(map=MapSource(((1 if sign == "+" else -1, term),)))


def map_part(source: MapSource) -> ShaderPart:
    """The part that takes a map in.

    Args:
        source: All terms of the map.

    Returns:
        Parameters and code; nothing where there are no terms.
    """
    if not source.terms:
        return ShaderPart()
    gradient = parameter(
        "vector", GRADIENT_SOCKET, "vector(0.0)", "Map", "Part of grad V, from a map"
    )
    recorded = parameter(
        "float", RECORDED_SOCKET, "0.0", "Map Recorded", "1 where the map is recorded"
    )
    # Where the map holds an object wave, this variable waits with the reference wave in it.
    waves = any(sign > 0 and isinstance(term, WAVES) for sign, term in source.terms)
    return ShaderPart(
        parameters=f"{gradient} {recorded}",
        code=(
            f"gradient += {GRADIENT_SOCKET}; "
            f"if ({RECORDED_SOCKET} < {RECORDED_SHARE} || {GRADIENT_SOCKET} == {_MISSING}) "
            f"recorded = 0;{' object_wave += gradient;' if waves else ''}"
        ),
    )


def coordinates_shader(surface: SurfaceSpec) -> ShaderSource:
    """The shader that finds a hit's place on the map.

    Args:
        surface: The shape of the element; hits count on the true surface, not on its facets.

    Returns:
        The flat text.
    """
    part = surface_part(surface, 1.0)
    definitions = {"HOE_SURFACE_PARAMETERS": part.parameters, "HOE_FIND_NORMAL": part.code}
    return specialised("hoe_map_coordinates", definitions, part.functions)
