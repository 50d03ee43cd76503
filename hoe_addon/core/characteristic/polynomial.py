# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The polynomial of x and y."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import polynomial

from ..arrays import FloatArray, as_float
from .planar import PlanarPattern, check_finite, check_positive


@dataclass(frozen=True, kw_only=True, eq=False)
class Polynomial(PlanarPattern):
    """V = sum of c_ij u^i v^j with (u, v) = (x, y) / radius ("Binary 1").

    Attributes:
        coefficients: c_ij by (i, j), metres.
        radius: Length where u or v is 1, metres, above 0.
    """

    coefficients: Mapping[tuple[int, int], float]
    radius: float

    def __post_init__(self) -> None:
        """Check the fields."""
        super().__post_init__()
        check_finite("coefficients", self.coefficients.values())
        check_positive("radius", self.radius)

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V; see `PlanarPattern`."""
        return _sum(self.coefficients, x / self.radius, y / self.radius)

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return its derivatives; see `PlanarPattern`."""
        u, v = x / self.radius, y / self.radius
        return _sum(self.slope_terms(0), u, v), _sum(self.slope_terms(1), u, v)

    def slope_terms(self, axis: int) -> dict[tuple[int, int], float]:
        """Return the terms of a derivative of V.

        Args:
            axis: 0 for the one along x, 1 for y.

        Returns:
            Coefficients without dimension by powers of u and v; constants of V leave none.
        """
        return {
            (i - (axis == 0), j - (axis == 1)): (i, j)[axis] * value / self.radius
            for (i, j), value in self.coefficients.items()
            if (i, j)[axis] > 0
        }


def _sum(terms: Mapping[tuple[int, int], float], u: FloatArray, v: FloatArray) -> FloatArray:
    size = 1 + max((max(powers) for powers in terms), default=0)
    matrix = np.zeros((size, size))
    for powers, value in terms.items():
        matrix[powers] = value
    across, up = np.broadcast_arrays(u, v)
    return as_float(polynomial.polyval2d(across, up, matrix))
