# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves in the shader: each kind gives code for ``n s`` at ``position``."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import as_float, dot, unit
from ..model.optical_system import SystemWaveSpec
from ..model.waves import (
    AstigmaticSpec,
    ExtendedSourceSpec,
    PlaneWaveSpec,
    PointSourceSpec,
    WaveSpec,
    WindowSourceSpec,
)
from .extended import source_point
from .map import by_map
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
    match wave:
        case PlaneWaveSpec():
            return _with_index(role, wave.index, _plane(role, sign, wave))
        case PointSourceSpec():
            return _with_index(role, wave.index, _point(role, sign, wave, units_per_mm))
        case WindowSourceSpec():
            return _with_index(role, wave.index, _window(role, sign, wave, units_per_mm))
        case AstigmaticSpec():
            return _with_index(role, wave.index, _astigmatic(role, sign, wave, units_per_mm))
        case ExtendedSourceSpec():
            return _with_index(role, wave.index, _extended(role, sign, wave, units_per_mm))
        case SystemWaveSpec():
            return by_map(sign, wave)


def _with_index(role: str, index: float, part: ShaderPart) -> ShaderPart:
    name = f"{role}_index"
    declared = parameter("float", name, "1.0", _label(name), f"Index of the {role} medium")
    return replace(
        part,
        parameters=f"{part.parameters} {declared}",
        sockets=part.sockets | {name: index},
    )


def _plane(role: str, sign: str, wave: PlaneWaveSpec) -> ShaderPart:
    name, label = f"{role}_direction", f"{role} Direction".title()
    return ShaderPart(
        parameters=parameter(
            "vector", name, "vector(0.0, 0.0, 1.0)", label, "Direction of travel, in the frame"
        ),
        code=f"gradient {sign}= {role}_index * {name};",
        sockets={name: triple(unit(wave.direction))},
    )


def _point(role: str, sign: str, wave: PointSourceSpec, units_per_mm: float) -> ShaderPart:
    name = f"{role}_position"
    return ShaderPart(
        parameters=f"{_place(name, 'Its point, in the frame')} {_beam(role)}",
        code=(
            f"gradient {sign}= {role}_index * hoe_point_wave({name}, {role}_converging, position);"
        ),
        sockets={name: _scaled(wave.position_mm, units_per_mm), **_beam_socket(role, wave.beam)},
    )


def _window(role: str, sign: str, wave: WindowSourceSpec, units_per_mm: float) -> ShaderPart:
    window = f"{role}_window"
    numbers = {
        f"{role}_source_index": ("1.0", "Index of the medium around the point"),
        f"{window}_thickness": ("0.0", "Thickness of the window, in scene units"),
        f"{window}_index": ("1.0", "Index of the window"),
    }
    declared = (
        _place(f"{role}_position", "Its point, before the window, in the frame"),
        _place(f"{window}_position", "A point on the window's face toward the source"),
        _place(f"{window}_normal", "Normal of the window, away from the source"),
        _beam(role),
        *(
            parameter("float", name, default, _label(name), words)
            for name, (default, words) in numbers.items()
        ),
    )
    given = (
        f"{role}_position, {role}_converging, {role}_source_index, {window}_position, "
        f"{window}_normal, {window}_thickness, {window}_index, {role}_index"
    )
    return ShaderPart(
        parameters=" ".join(declared),
        code=(
            f"{{ vector arriving; if (hoe_window_wave({given}, position, arriving)) "
            f"gradient {sign}= {role}_index * arriving; else recorded = 0; }}"
        ),
        sockets={
            f"{role}_position": _scaled(wave.position_mm, units_per_mm),
            f"{role}_source_index": wave.source_index,
            f"{window}_position": _scaled(wave.window.position_mm, units_per_mm),
            f"{window}_normal": triple(unit(wave.window.normal)),
            f"{window}_thickness": wave.window.thickness_mm * units_per_mm,
            f"{window}_index": wave.window.index,
            **_beam_socket(role, wave.beam),
        },
    )


def _astigmatic(role: str, sign: str, wave: AstigmaticSpec, units_per_mm: float) -> ShaderPart:
    first, second, radius = f"{role}_first", f"{role}_second", f"{role}_arc_radius"
    chief, line = f"{role}_chief_direction", f"{role}_line_direction"
    between_mm = as_float(wave.second_mm) - as_float(wave.first_mm)
    forward, upright = unit(between_mm), unit(wave.line_direction)
    declared = (
        _place(first, "Place of the straight line focus, in the frame"),
        _place(second, "Place of the arc focus, in the frame"),
        parameter("float", radius, "1.0", _label(radius), "Distance of the two places"),
        parameter(
            "vector", chief, "vector(0.0, 0.0, 1.0)", _label(chief), "From the first to the second"
        ),
        parameter(
            "vector", line, "vector(1.0, 0.0, 0.0)", _label(line), "Of the straight line focus"
        ),
        _beam(role),
    )
    return ShaderPart(
        parameters=" ".join(declared),
        code=(
            f"gradient {sign}= {role}_index * hoe_astigmatic_wave({first}, {second}, {radius}, "
            f"{chief}, {line}, {role}_converging, position);"
        ),
        sockets={
            first: _scaled(wave.first_mm, units_per_mm),
            second: _scaled(wave.second_mm, units_per_mm),
            radius: math.hypot(*between_mm) * units_per_mm,
            chief: triple(forward),
            line: triple(unit(upright - dot(upright, forward) * forward)),
            **_beam_socket(role, wave.beam),
        },
    )


def _extended(role: str, sign: str, wave: ExtendedSourceSpec, units_per_mm: float) -> ShaderPart:
    drawn = source_point(role, wave, units_per_mm)
    return ShaderPart(
        parameters=f"{drawn.parameters} {_beam(role)}",
        code=(
            f"gradient {sign}= {role}_index * "
            f"hoe_point_wave({drawn.code}, {role}_converging, position);"
        ),
        sockets={**drawn.sockets, **_beam_socket(role, wave.beam)},
    )


def _place(name: str, words: str) -> str:
    return parameter("vector", name, "vector(0.0)", _label(name), words)


def _beam(role: str) -> str:
    name = f"{role}_converging"
    return parameter("int", name, "0", _label(name), "1 for a beam toward it")


def _beam_socket(role: str, beam: str) -> dict[str, int]:
    return {f"{role}_converging": int(beam == "converging")}


def _label(name: str) -> str:
    return name.replace("_", " ").title()


def _scaled(vector_mm: ArrayLike, units_per_mm: float) -> tuple[float, float, float]:
    return triple(np.asarray(vector_mm) * units_per_mm)


def triple(vector: ArrayLike) -> tuple[float, float, float]:
    """Three plain floats.

    Args:
        vector: Three numbers.

    Returns:
        The same.
    """
    x, y, z = (float(value) for value in np.asarray(vector))
    return (x, y, z)
