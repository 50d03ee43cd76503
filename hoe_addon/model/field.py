# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the display's picture lies in the eye's picture."""

import numpy as np

from ..core.arrays import BoolArray
from .device import LightGuideSpec


def field_tangents(spec: LightGuideSpec) -> tuple[float, float]:
    """Half the display's field, as tangents of the angles from its axis.

    Args:
        spec: The device.

    Returns:
        Tangents of half the horizontal and half the vertical field.
    """
    width, height = spec.display.size_mm
    return width / (2.0 * spec.lens.focal_length_mm), height / (2.0 * spec.lens.focal_length_mm)


def field_degrees(spec: LightGuideSpec) -> tuple[float, float]:
    """The display's whole field.

    Args:
        spec: The device.

    Returns:
        Horizontal and vertical field in degrees.
    """
    horizontal, vertical = (2.0 * np.degrees(np.arctan(t)) for t in field_tangents(spec))
    return float(horizontal), float(vertical)


def field_mask(spec: LightGuideSpec, width: int, height: int) -> BoolArray:
    """Pixels whose centre sees the display.

    Args:
        spec: The device; the eye looks along the axis of the display's field.
        width: Width of the picture in pixels.
        height: Height of the picture in pixels.

    Returns:
        True inside the field, shape ``(height, width)``, top row first.
    """
    step = 2.0 * np.tan(np.radians(spec.eye.field_deg) / 2.0) / width
    x = (np.arange(width) + 0.5 - width / 2.0) * step
    y = (height / 2.0 - np.arange(height) - 0.5) * step
    half_x, half_y = field_tangents(spec)
    return (np.abs(y) <= half_y)[:, None] & (np.abs(x) <= half_x)[None, :]
