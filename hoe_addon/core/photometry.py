# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an eye would measure of a scene-linear picture."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, as_float
from .colour import LINEAR_REC709_TO_XYZ, LUMINANCE_WEIGHTS, uv_prime


@dataclass(frozen=True)
class Photometry:
    """Luminance and colour of a picture or a part of it.

    Attributes:
        mean_cd_m2: Mean luminance.
        min_cd_m2: Least luminance.
        peak_cd_m2: Greatest luminance.
        u_prime: CIE 1976 u' of the mean colour; NaN for black.
        v_prime: CIE 1976 v' of the mean colour; NaN for black.
    """

    mean_cd_m2: float
    min_cd_m2: float
    peak_cd_m2: float
    u_prime: float
    v_prime: float

    @property
    def uniformity(self) -> float:
        """Least over greatest luminance; 0 for black."""
        return self.min_cd_m2 / self.peak_cd_m2 if self.peak_cd_m2 > 0.0 else 0.0


def luminance(pixels: NDArray[np.floating], unit_cd_m2: float) -> FloatArray:
    """Luminance of scene-linear colours.

    Args:
        pixels: Linear Rec. 709 values, shape ``(..., 3)``.
        unit_cd_m2: Luminance of the value 1 in all channels, in cd/m^2.

    Returns:
        Luminance in cd/m^2, shape ``(...)``.
    """
    return unit_cd_m2 * (as_float(pixels) @ LUMINANCE_WEIGHTS)


def measure(pixels: NDArray[np.floating], unit_cd_m2: float) -> Photometry:
    """Measure a picture.

    Args:
        pixels: Linear Rec. 709 values, shape ``(..., 3)``, at least one.
        unit_cd_m2: Luminance of the value 1 in all channels, in cd/m^2.

    Returns:
        Its luminance and mean colour.
    """
    values = luminance(pixels, unit_cd_m2)
    mean_rgb = as_float(pixels).reshape(-1, 3).mean(axis=0)
    u_prime, v_prime = uv_prime(LINEAR_REC709_TO_XYZ @ mean_rgb)
    return Photometry(
        mean_cd_m2=float(values.mean()),
        min_cd_m2=float(values.min()),
        peak_cd_m2=float(values.max()),
        u_prime=float(u_prime),
        v_prime=float(v_prime),
    )
