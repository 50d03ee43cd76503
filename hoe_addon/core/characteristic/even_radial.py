# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The even polynomial of the radius."""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .planar import PlanarPattern, check_finite, check_positive


@dataclass(frozen=True, kw_only=True, eq=False)
class EvenRadial(PlanarPattern):
    """V = sum of c_k rho^(2k), k = 1, 2, ..., with rho = r / radius ("Binary 2").

    Attributes:
        coefficients: c_1, c_2, ..., metres.
        radius: Radius where rho is 1, metres, above 0.
    """

    coefficients: tuple[float, ...]
    radius: float

    def __post_init__(self) -> None:
        """Check the fields."""
        super().__post_init__()
        check_finite("coefficients", self.coefficients)
        check_positive("radius", self.radius)

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V; see `PlanarPattern`."""
        square = (x / self.radius) ** 2 + (y / self.radius) ** 2
        return horner((0.0, *self.coefficients), square)

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return sum of 2 k c_k rho^(2k - 2) times (x, y) / radius^2; see `PlanarPattern`."""
        u, v = x / self.radius, y / self.radius
        factor = horner(self.slope_factors, u * u + v * v)
        return factor * u, factor * v

    @property
    def slope_factors(self) -> tuple[float, ...]:
        """The numbers 2 k c_k / radius: grad V is their polynomial in rho^2 times (x, y) / radius.

        Returns:
            Without dimension, for k = 1, 2, ....
        """
        return tuple(
            2.0 * k * value / self.radius for k, value in enumerate(self.coefficients, start=1)
        )


def horner(coefficients: tuple[float, ...], at: FloatArray) -> FloatArray:
    """Return a polynomial.

    Args:
        coefficients: From the constant term up.
        at: Where, any shape.

    Returns:
        Its values, same shape.
    """
    total = np.zeros_like(at)
    for value in reversed(coefficients):
        total = total * at + value
    return total
