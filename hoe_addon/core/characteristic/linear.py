# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The uniform grating."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float
from ..errors import SpecError


@dataclass(frozen=True)
class LinearGrating:
    """Straight, evenly spaced lines; a `Pattern`.

    Attributes:
        frequency: Components of the grating vector Q along x and y, cycles per metre.
        wavelength: Wavelength that V is stated for, metres; directions do not depend on it.
    """

    frequency: tuple[float, float]
    wavelength: float = 1.0
    draws = 0

    def __post_init__(self) -> None:
        """Check the fields."""
        if len(self.frequency) != 2 or not all(map(math.isfinite, self.frequency)):
            raise SpecError(f"frequency: must be two finite numbers, got {list(self.frequency)}")
        if not (math.isfinite(self.wavelength) and self.wavelength > 0.0):
            raise SpecError(f"wavelength: must be above 0, got {self.wavelength}")

    def function(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``lambda_0 Q . P``, metres; see `Pattern`."""
        del draws
        return self.wavelength * (as_float(points)[..., :2] @ as_float(self.frequency))

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``lambda_0 Q``, the same everywhere; see `Pattern`."""
        del draws
        vector = self.wavelength * as_float((*self.frequency, 0.0))
        return np.broadcast_to(vector, as_float(points).shape)
