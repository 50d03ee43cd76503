# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From characteristic functions of documents (nm, mm, their unit) to those of the core (SI)."""

import math

from ...core import characteristic
from ...core.characteristic import ZernikeTerm
from ...core.pattern import Pattern
from ...core.units import mm_to_m, nm_to_m
from . import CharacteristicSpec
from .formula import FormulaSpec
from .gratings import LinearSpec, RadialSpec
from .grids import SampledSpec, SplineSpec
from .polynomials import EvenRadialSpec, PolynomialSpec
from .unit import metres_per_unit
from .zernike import ORDERS, ZernikeSpec


def characteristic_from(spec: CharacteristicSpec) -> Pattern:
    """Make a characteristic function of the core.

    Args:
        spec: The function of a document.

    Returns:
        The same in SI units.
    """
    match spec:
        case LinearSpec():
            return _linear(spec)
        case RadialSpec():
            return characteristic.RadialGrating(
                frequency=_per_metre(spec.lines_per_mm),
                wavelength=float(nm_to_m(spec.wavelength_nm)),
            )
        case EvenRadialSpec():
            return even_radial_from(spec)
        case PolynomialSpec():
            return polynomial_from(spec)
        case ZernikeSpec():
            return zernike_from(spec)
        case FormulaSpec():
            return characteristic.FormulaPattern(
                formula=spec.parsed(),
                scale=metres_per_unit(spec.unit, spec.wavelength_nm),
                length=float(mm_to_m(1.0)),
                wavelength=float(nm_to_m(spec.wavelength_nm)),
            )
        case SplineSpec() | SampledSpec():
            return characteristic.SplinePattern(
                spline=spec.spline(metres_per_unit(spec.unit, spec.wavelength_nm)),
                wavelength=float(nm_to_m(spec.wavelength_nm)),
            )


def even_radial_from(spec: EvenRadialSpec) -> characteristic.EvenRadial:
    """Make an even polynomial of the radius.

    Args:
        spec: The polynomial of a document.

    Returns:
        The same in SI units.
    """
    scale = metres_per_unit(spec.unit, spec.wavelength_nm)
    return characteristic.EvenRadial(
        coefficients=tuple(scale * value for value in spec.coefficients),
        radius=float(mm_to_m(spec.normalization_mm)),
        wavelength=float(nm_to_m(spec.wavelength_nm)),
    )


def polynomial_from(spec: PolynomialSpec) -> characteristic.Polynomial:
    """Make a polynomial of x and y.

    Args:
        spec: The polynomial of a document.

    Returns:
        The same in SI units.
    """
    scale = metres_per_unit(spec.unit, spec.wavelength_nm)
    return characteristic.Polynomial(
        coefficients={(term.x, term.y): scale * term.coefficient for term in spec.terms},
        radius=float(mm_to_m(spec.normalization_mm)),
        wavelength=float(nm_to_m(spec.wavelength_nm)),
    )


def zernike_from(spec: ZernikeSpec) -> characteristic.Zernike:
    """Make a sum of Zernike polynomials.

    Args:
        spec: The sum of a document.

    Returns:
        The same in SI units, by degree and frequency.
    """
    scale = metres_per_unit(spec.unit, spec.wavelength_nm)
    order, _ = ORDERS[spec.index]
    terms: list[ZernikeTerm] = []
    for index, value in spec.coefficients.items():
        n, m, factor = order(int(index))
        terms.append(ZernikeTerm(n, m, scale * factor * value))
    return characteristic.Zernike(
        terms=tuple(terms),
        radius=float(mm_to_m(spec.normalization_mm)),
        wavelength=float(nm_to_m(spec.wavelength_nm)),
    )


def _linear(spec: LinearSpec) -> characteristic.LinearGrating:
    along = math.radians(spec.azimuth_deg)
    lines = _per_metre(spec.lines_per_mm)
    frequency = (lines * math.cos(along), lines * math.sin(along))
    return characteristic.LinearGrating(frequency, float(nm_to_m(spec.wavelength_nm)))


def _per_metre(lines_per_mm: float) -> float:
    return float(lines_per_mm / mm_to_m(1.0))
