# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of lines: of light by its wavelength, and of what is no light."""

from functools import lru_cache

import numpy as np

from ...core.colour import LUMINANCE_WEIGHTS, linear_rgb_bar
from ...core.units import nm_to_m

type Rgb = tuple[float, float, float]

VISIBLE_NM = (380.0, 750.0)
"""What lies outside is drawn in greys."""

ULTRAVIOLET: Rgb = (0.62, 0.52, 0.74)
INFRARED: Rgb = (0.72, 0.50, 0.50)
MIXED: Rgb = (0.86, 0.86, 0.86)
"""Light of several wavelengths at once."""

PUPIL: Rgb = (0.35, 0.78, 0.98)
EYEBOX: Rgb = (1.0, 0.72, 0.26)
MEASURE: Rgb = (0.80, 0.80, 0.80)

_LEAST_LUMINANCE = 0.22
"""Of linear RGB: deep blue and red lines would be lost before a dark background."""


@lru_cache(maxsize=256)
def of_wavelength(nm: float) -> Rgb:
    """Give light a colour that can be seen as a line on a screen.

    Args:
        nm: Vacuum wavelength.

    Returns:
        Red, green and blue in [0, 1], as a screen takes them: the hue of the light as bright as it
        goes; outside the visible a grey-violet or a grey-red.
    """
    if nm < VISIBLE_NM[0]:
        return ULTRAVIOLET
    if nm > VISIBLE_NM[1]:
        return INFRARED
    linear = np.clip(linear_rgb_bar(nm_to_m(nm)), 0.0, None)
    linear = linear / np.max(linear)
    luminance = float(linear @ LUMINANCE_WEIGHTS)
    white = max(0.0, (_LEAST_LUMINANCE - luminance) / (1.0 - luminance))
    red, green, blue = (_encoded(float(part)) for part in linear + white * (1.0 - linear))
    return (red, green, blue)


def _encoded(linear: float) -> float:
    """The transfer function of sRGB, IEC 61966-2-1."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1.0 / 2.4) - 0.055
