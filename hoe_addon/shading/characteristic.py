# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions in the shader: each kind gives code for ``gradient`` at ``position``."""

import math

from ..model.characteristic import (
    CharacteristicSpec,
    EvenRadialSpec,
    FormulaSpec,
    LinearSpec,
    PolynomialSpec,
    RadialSpec,
    SampledSpec,
    SplineSpec,
    ZernikeSpec,
)
from .formula import formula_part
from .map import by_map
from .part import ShaderPart, parameter
from .polynomials import even_radial_part, polynomial_part, zernike_part


def characteristic_part(
    spec: CharacteristicSpec, units_per_mm: float, reach_mm: float | None = None
) -> ShaderPart:
    """The shader's part for a characteristic function.

    Args:
        spec: The function.
        units_per_mm: Scene units in one mm.
        reach_mm: How far the element reaches from its centre; where it is known, powers of the
            radius are scaled to it, so that float32 holds them whatever the normalization.

    Returns:
        Its part; one that asks for a map where V stands on a grid.
    """
    match spec:
        case LinearSpec():
            return _linear(spec)
        case RadialSpec():
            return _radial(spec)
        case EvenRadialSpec():
            return even_radial_part(spec, units_per_mm, reach_mm)
        case PolynomialSpec():
            return polynomial_part(spec, units_per_mm, reach_mm)
        case ZernikeSpec():
            return zernike_part(spec, units_per_mm)
        case FormulaSpec():
            return formula_part(spec, units_per_mm)
        case SplineSpec() | SampledSpec():
            return by_map("+", spec)


def _linear(spec: LinearSpec) -> ShaderPart:
    size = _steepness(spec)
    angle = math.radians(spec.azimuth_deg)
    return ShaderPart(
        parameters=parameter(
            "vector", "grating", "vector(0.0)", "Grating", "Recording wavelength times Q"
        ),
        code="gradient = grating;",
        sockets={"grating": (size * math.cos(angle), size * math.sin(angle), 0.0)},
    )


def _radial(spec: RadialSpec) -> ShaderPart:
    return ShaderPart(
        parameters=parameter(
            "float", "grating", "0.0", "Grating", "Recording wavelength times the size of Q"
        ),
        code=(
            "{ float radius = sqrt(position[0] * position[0] + position[1] * position[1]); "
            "if (radius > 0.0) gradient = (grating / radius) * "
            "vector(position[0], position[1], 0.0); else recorded = 0; }"
        ),
        sockets={"grating": _steepness(spec)},
    )


def _steepness(spec: LinearSpec | RadialSpec) -> float:
    """lambda_0 Q has no dimension: lines per mm times nm, times 1e-6 mm per nm."""
    return spec.lines_per_mm * spec.wavelength_nm * 1e-6
