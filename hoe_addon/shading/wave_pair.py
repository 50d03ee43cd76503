# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two plane or spherical waves in the shader, as what they are at the origin and how they turn.

Far sources make nearly equal unit vectors: their difference would be the rounding of float32, and
high orders would multiply it. So the difference at the frame's origin is found here, in double
precision, and the shader adds how far each wave has turned between the origin and the hit: small
numbers that keep all their digits, and none for a plane wave.
"""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..core.arrays import FloatArray, as_float, unit
from ..model.waves import PlaneWaveSpec, PointSourceSpec
from .part import ShaderPart, joined, parameter
from .waves import triple, wave_part

_FAR = 2.0
"""A source this many times as far as the element reaches is far. The turn then keeps its digits:
the distance of a hit, over that of the origin, is at least one half."""


# A refresh of a material asks for the text, for the numbers, and twice for the map.
@lru_cache(maxsize=64)
def pair_part(
    first: PlaneWaveSpec | PointSourceSpec,
    second: PlaneWaveSpec | PointSourceSpec,
    units_per_mm: float,
    reach_mm: float | None,
) -> ShaderPart:
    """The shader's part for both waves of a recording.

    Args:
        first: Object wave.
        second: Reference wave.
        units_per_mm: Scene units in one mm.
        reach_mm: How far the element reaches from its centre; None where only the text counts.

    Returns:
        Code that sets ``gradient`` and ``object_wave`` in the frame of the recording.
    """
    reach = math.inf if reach_mm is None else reach_mm
    at_origin = first.index * _heading(first, reach) - second.index * _heading(second, reach)
    words = "n s of the object less that of the reference wave, at the frame's origin"
    origin = ShaderPart(
        parameters=parameter("vector", "origin_gradient", "vector(0.0)", "Origin Gradient", words),
        code="gradient += origin_gradient;",
        sockets={"origin_gradient": triple(at_origin)},
    )
    whole = ShaderPart(code="object_wave = gradient + object_index * object_direction;")
    turning = (
        _turning(role, sign, wave, units_per_mm, reach)
        for role, sign, wave in (("object", "+", first), ("reference", "-", second))
    )
    return joined((next(turning), whole, next(turning), origin))


def _turning(
    role: str,
    sign: str,
    wave: PlaneWaveSpec | PointSourceSpec,
    units_per_mm: float,
    reach_mm: float,
) -> ShaderPart:
    """The wave less what it is at the origin, where the source is far; else the whole wave."""
    part = wave_part(role, sign, wave, units_per_mm)
    if isinstance(wave, PlaneWaveSpec):
        return replace(part, code="")
    direction, curvature = f"{role}_direction", f"{role}_curvature"
    heading = _heading(wave, reach_mm)
    bend = 0.0
    if heading.any():
        bend = (-1.0 if wave.beam == "converging" else 1.0) / (
            math.hypot(*wave.position_mm) * units_per_mm
        )
    words = "Direction of travel at the frame's origin; zero for a source near to it"
    declared = (
        parameter("vector", direction, "vector(0.0)", direction.replace("_", " ").title(), words),
        parameter(
            "float",
            curvature,
            "0.0",
            curvature.replace("_", " ").title(),
            "One over the distance of its point; negative while converging",
        ),
    )
    return replace(
        part,
        parameters=" ".join((part.parameters, *declared)),
        code=(
            f"gradient {sign}= {role}_index * hoe_point_turn({direction}, {curvature}, "
            f"{role}_position, {role}_converging, position);"
        ),
        sockets=part.sockets | {direction: triple(heading), curvature: bend},
    )


def _heading(wave: PlaneWaveSpec | PointSourceSpec, reach_mm: float) -> FloatArray:
    """The unit direction of travel at the origin, or zero for a source that is near to it."""
    if isinstance(wave, PlaneWaveSpec):
        return unit(wave.direction)
    if math.hypot(*wave.position_mm) < _FAR * reach_mm:
        return np.zeros(3)
    toward = unit(as_float(wave.position_mm))
    return toward if wave.beam == "converging" else -toward
