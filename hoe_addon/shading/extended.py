# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Extended sources in the shader: an expression for a point drawn on the source."""

import numpy as np

from ..core.arrays import FloatArray
from ..core.waves.source_shapes import TriangleMesh, cumulative
from ..model.source_shapes import DiscShape, LineShape, MeshShape, RectangleShape
from ..model.waves import ExtendedSourceSpec
from .part import ShaderPart, SocketValues, parameter
from .source import array

_SOURCES = {"object": 0, "reference": 1}
"""Each draws numbers of its own."""


def source_point(role: str, wave: ExtendedSourceSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part that draws a point of a source.

    The middle and the axes are sockets. A mesh is a table in the text, in mm in its own frame.

    Args:
        role: ``object`` or ``reference``: prefix of its parameters.
        wave: The wave.
        units_per_mm: Scene units in one mm.

    Returns:
        Parameters and sockets; the code is an expression for the point, in the frame of the
        recording, in scene units.
    """
    centre, spans = f"{role}_position", [f"{role}_span_{axis}" for axis in "xyz"]
    axes = wave.axes() * units_per_mm
    tables = ""
    match wave.shape:
        case LineShape(length_mm=length):
            halves = [length / 2]
            drawn = f"hoe_line_point({centre}, {spans[0]}, {draw(role, 0)})"
        case RectangleShape(size_mm=(width, height)):
            halves = [width / 2, height / 2]
            drawn = f"hoe_rectangle_point({_flat(role, centre, spans)})"
        case DiscShape(diameter_mm=size):
            halves = [size / 2, size / 2]
            drawn = f"hoe_disc_point({_flat(role, centre, spans)})"
        case MeshShape():
            halves = [1.0, 1.0, 1.0]
            tables = _tables(role, wave.shape.triangles_mm())
            drawn = _mesh_point(role, centre, spans, len(wave.shape.triangles_mm()))
    sockets: SocketValues = {centre: _triple(np.asarray(wave.position_mm) * units_per_mm)}
    sockets |= {
        name: _triple(axis * half) for name, axis, half in zip(spans, axes, halves, strict=False)
    }
    declared = (
        parameter("vector", name, "vector(0.0)", name.replace("_", " ").title(), words)
        for name, words in zip(sockets, _WORDS, strict=False)
    )
    return ShaderPart(parameters=" ".join((*declared, tables)), code=drawn, sockets=sockets)


_WORDS = (
    "Middle of the source, in the frame",
    "From the middle to the edge along x; x axis of a mesh",
    "From the middle to the edge along y; y axis of a mesh",
    "z axis of a mesh",
)


def draw(role: str, dimension: int) -> str:
    """An OSL expression for a uniform number in [0, 1).

    Args:
        role: ``object`` or ``reference``, which draw independently.
        dimension: From 0; each is independent of the others.

    Returns:
        The expression.
    """
    return f"hoe_random({_SOURCES[role]}, {dimension})"


def _flat(role: str, centre: str, spans: list[str]) -> str:
    return f"{centre}, {spans[0]}, {spans[1]}, {draw(role, 0)}, {draw(role, 1)}"


def _mesh_point(role: str, centre: str, spans: list[str], count: int) -> str:
    numbers = ", ".join(draw(role, dimension) for dimension in range(3))
    point = f"hoe_mesh_point({role}_corners_mm, {role}_shares, {count}, {numbers})"
    return f"hoe_placed({centre}, {', '.join(spans)}, {point})"


def _tables(role: str, triangles_mm: FloatArray) -> str:
    shares = cumulative(TriangleMesh(triangles_mm).areas)
    return (
        f"float {role}_corners_mm[{triangles_mm.size}] = {array(triangles_mm.ravel())}, "
        f"float {role}_shares[{len(shares)}] = {array(shares)},"
    )


def _triple(vector: FloatArray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return (x, y, z)
