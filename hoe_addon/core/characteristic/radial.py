# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The circular grating."""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .planar import PlanarPattern, check_finite


@dataclass(frozen=True, kw_only=True, eq=False)
class RadialGrating(PlanarPattern):
    """Evenly spaced circles around the origin, as the track of a compact disc, or an axicon.

    Attributes:
        frequency: Circles per metre of radius; negative turns the orders around.
    """

    frequency: float

    def __post_init__(self) -> None:
        """Check the fields."""
        super().__post_init__()
        check_finite("frequency", (self.frequency,))

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return ``lambda_0 f r``; see `PlanarPattern`."""
        return self.wavelength * self.frequency * np.hypot(x, y)

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return ``lambda_0 f (x, y) / r``, not defined at the origin; see `PlanarPattern`."""
        radius = np.hypot(x, y)
        with np.errstate(invalid="ignore"):
            return (
                self.wavelength * self.frequency * (x / radius),
                self.wavelength * self.frequency * (y / radius),
            )
