# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions given outright, one kind a file; each is a `Pattern`."""

from .even_radial import EvenRadial
from .formula import FormulaPattern
from .linear import LinearGrating
from .planar import PlanarPattern
from .polynomial import Polynomial
from .radial import RadialGrating
from .spline import SplinePattern
from .zernike import Zernike, ZernikeTerm

__all__ = [
    "EvenRadial",
    "FormulaPattern",
    "LinearGrating",
    "PlanarPattern",
    "Polynomial",
    "RadialGrating",
    "SplinePattern",
    "Zernike",
    "ZernikeTerm",
]
