# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The outline of an element, seen along z, and which points lie on the element."""

import math
from typing import Literal, Protocol

import numpy as np

from ..core.arrays import BoolArray, FloatArray, as_float
from ..core.shapes import Shape
from ..core.units import m_to_mm, mm_to_m

type Outline = Literal["rectangle", "ellipse"]
OUTLINES = ("rectangle", "ellipse")

ON_SURFACE_MM = 5e-10
"""A point nearer to the surface than this counts as on it; far below any real position."""


class Covering(Protocol):
    """A surface with a shape and an outline."""

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        ...

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        ...


def inside_outline(outline: str, size_mm: tuple[float, float], points_mm: FloatArray) -> BoolArray:
    """Tell which points lie in an outline, its edge included.

    Args:
        outline: ``rectangle`` or ``ellipse``.
        size_mm: Width and height in mm.
        points_mm: Points in mm, shape ``(..., 3)``; z does not matter.

    Returns:
        Mask, shape ``(...)``; false for NaN.
    """
    share = np.abs(points_mm[..., :2]) / (0.5 * as_float(size_mm))
    if outline == "ellipse":
        return np.asarray(np.sum(share * share, axis=-1) <= 1.0)
    return np.asarray(np.all(share <= 1.0, axis=-1))


def reach_mm(outline: str, size_mm: tuple[float, float]) -> float:
    """Find how far an outline reaches from the axis.

    Args:
        outline: ``rectangle`` or ``ellipse``.
        size_mm: Width and height in mm.

    Returns:
        Distance of its farthest point in mm.
    """
    width, height = size_mm
    return 0.5 * (max(width, height) if outline == "ellipse" else math.hypot(width, height))


def on_surface(surface: Covering, position_mm: tuple[float, float, float]) -> bool:
    """Tell whether a point lies on an element given by a formula.

    Args:
        surface: The element.
        position_mm: The point, in the frame of the surface.

    Returns:
        True on it, edges included.
    """
    place = as_float(position_mm)
    if not bool(surface.covers(place)):
        return False
    x, y, z = mm_to_m(place)
    return bool(np.abs(m_to_mm(as_float(surface.core_shape().sag(x, y) - z))) <= ON_SURFACE_MM)
