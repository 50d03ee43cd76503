# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A function given as a formula."""

from dataclasses import dataclass

from ..arrays import FloatArray
from ..formula import Formula
from .planar import PlanarPattern, check_finite, check_positive


@dataclass(frozen=True, kw_only=True, eq=False)
class FormulaPattern(PlanarPattern):
    """V as a formula of x, y, r and phi.

    Attributes:
        formula: The formula.
        scale: What 1 of the formula's value stands for, metres.
        length: What 1 of its x, y and r stands for, metres, above 0.
    """

    formula: Formula
    scale: float
    length: float

    def __post_init__(self) -> None:
        """Check the fields."""
        super().__post_init__()
        check_finite("scale", (self.scale,))
        check_positive("length", self.length)

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V; see `PlanarPattern`."""
        return self.scale * self.formula.at(x / self.length, y / self.length)

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return its exact derivatives, NaN at a kink; see `PlanarPattern`."""
        both = self.formula.gradient(x / self.length, y / self.length)
        factor = self.scale / self.length
        return factor * both[..., 0], factor * both[..., 1]
