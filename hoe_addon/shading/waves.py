# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves in the shader: each kind gives code for ``n s`` at ``position``."""

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import unit
from ..model.waves import PlaneWaveSpec, PointSourceSpec, WaveSpec
from .part import ShaderPart, parameter


def wave_part(role: str, sign: str, wave: WaveSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for one recording wave.

    Args:
        role: ``object`` or ``reference``: prefix of its parameters.
        sign: ``+`` or ``-``: how its ``n s`` goes into ``gradient``.
        wave: The wave.
        units_per_mm: Scene units in one mm.

    Returns:
        Code that adds the wave to ``gradient``, a vector in the frame of the recording.
    """
    index = parameter(
        "float", f"{role}_index", "1.0", f"{role} Index".title(), f"Index of the {role} medium"
    )
    match wave:
        case PlaneWaveSpec():
            return _plane(role, sign, wave, index)
        case PointSourceSpec():
            return _point(role, sign, wave, index, units_per_mm)


def _plane(role: str, sign: str, wave: PlaneWaveSpec, index: str) -> ShaderPart:
    name, label = f"{role}_direction", f"{role} Direction".title()
    direction = parameter(
        "vector", name, "vector(0.0, 0.0, 1.0)", label, "Direction of travel, in the frame"
    )
    return ShaderPart(
        parameters=f"{direction} {index}",
        code=f"gradient {sign}= {role}_index * {name};",
        sockets={name: triple(unit(wave.direction)), f"{role}_index": wave.index},
    )


def _point(
    role: str, sign: str, wave: PointSourceSpec, index: str, units_per_mm: float
) -> ShaderPart:
    name, label = f"{role}_position", f"{role} Position".title()
    place = parameter("vector", name, "vector(0.0)", label, "Its point, in the frame")
    beam = parameter(
        "int", f"{role}_converging", "0", f"{role} Converging".title(), "1 for a beam toward it"
    )
    return ShaderPart(
        parameters=f"{place} {beam} {index}",
        code=(
            f"gradient {sign}= {role}_index * hoe_point_wave({name}, {role}_converging, position);"
        ),
        sockets={
            name: triple(np.asarray(wave.position_mm) * units_per_mm),
            f"{role}_index": wave.index,
            f"{role}_converging": int(wave.beam == "converging"),
        },
    )


def triple(vector: ArrayLike) -> tuple[float, float, float]:
    """Three plain floats.

    Args:
        vector: Three numbers.

    Returns:
        The same.
    """
    x, y, z = (float(value) for value in np.asarray(vector))
    return (x, y, z)
