# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A smooth function through a grid."""

from dataclasses import dataclass

from ..arrays import FloatArray
from ..spline import Spline2D
from .planar import PlanarPattern


@dataclass(frozen=True, kw_only=True, eq=False)
class SplinePattern(PlanarPattern):
    """V as a bicubic spline; nothing is recorded outside its grid.

    Attributes:
        spline: V in metres over x and y in metres, one channel.
    """

    spline: Spline2D

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V; see `PlanarPattern`."""
        return self.spline.value(x, y)

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of the spline; see `PlanarPattern`."""
        both = self.spline.derivative(x, y)
        return both[..., 0], both[..., 1]
