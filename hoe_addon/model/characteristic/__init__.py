# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions V(x, y) as documents write them, told apart by ``kind``; in mm."""

from .formula import FormulaSpec
from .gratings import LinearSpec, RadialSpec
from .grids import SampledSpec, SplineSpec
from .polynomials import EvenRadialSpec, PolynomialSpec, PolynomialTerm
from .zernike import ZernikeSpec

__all__ = [
    "CHARACTERISTICS",
    "CharacteristicSpec",
    "EvenRadialSpec",
    "FormulaSpec",
    "LinearSpec",
    "PolynomialSpec",
    "PolynomialTerm",
    "RadialSpec",
    "SampledSpec",
    "SplineSpec",
    "ZernikeSpec",
]

type CharacteristicSpec = (
    LinearSpec
    | RadialSpec
    | EvenRadialSpec
    | PolynomialSpec
    | ZernikeSpec
    | SplineSpec
    | FormulaSpec
    | SampledSpec
)

CHARACTERISTICS = (
    LinearSpec,
    RadialSpec,
    EvenRadialSpec,
    PolynomialSpec,
    ZernikeSpec,
    SplineSpec,
    FormulaSpec,
    SampledSpec,
)
"""Every kind of characteristic function."""
