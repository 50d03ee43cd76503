# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of an element that rays of a drawing go to."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.shapes import MeshShape, Shape
from ...core.units import m_to_mm, mm_to_m
from ...model.surface import SurfaceSpec

_ELLIPSE_SIDES = 24
_INSIDE = 1.0 - 1e-6
"""Places of the rim are moved inward by this, so that rounding leaves them on the element."""


@dataclass(frozen=True, eq=False)
class Aims:
    """Places of an element, in mm in its own frame.

    Attributes:
        middle: Its middle, shape ``(3,)``.
        points: Where rays go to, the middle first, shape ``(n, 3)``.
        outline: Its rim, in order, shape ``(k, 3)``.
        size: The shorter of width and height.
    """

    middle: FloatArray
    points: FloatArray
    outline: FloatArray
    size: float


def aims_of(surface: SurfaceSpec, rays: int) -> Aims:
    """Choose places of an element.

    Args:
        surface: Its surface.
        rays: How many.

    Returns:
        The middle, and the others around the rim.
    """
    half = 0.5 * _INSIDE * np.asarray(surface.size_mm, dtype=np.float64)
    is_round = getattr(surface, "outline", "rectangle") == "ellipse"
    rim = (_ellipse if is_round else _rectangle)(max(rays - 1, 0))
    outline = _ellipse(_ELLIPSE_SIDES) if is_round else _rectangle(4)
    shape = surface.core_shape()
    flat = np.concatenate((np.zeros((1, 2)), rim * half, outline * half))
    places = _on_surface(shape, flat)
    count = 1 + len(rim)
    return Aims(places[0], places[:count], places[count:], 2.0 * float(half.min()))


def _on_surface(shape: Shape, flat: FloatArray) -> FloatArray:
    """Places of a surface above places of the plane z = 0; of a mesh, near them."""
    z = m_to_mm(shape.sag(mm_to_m(flat[:, 0]), mm_to_m(flat[:, 1])))
    places = np.column_stack((flat, np.broadcast_to(z, len(flat))))
    if isinstance(shape, MeshShape):
        corners = m_to_mm(shape.vertices)
        for number in np.flatnonzero(~np.isfinite(places[:, 2])):
            away = np.hypot(*(corners[:, :2] - flat[number]).T)
            places[number] = corners[np.argmin(away)]
    return places


def _ellipse(count: int) -> FloatArray:
    """Places around the unit circle, shape ``(count, 2)``."""
    angle = 2.0 * np.pi * np.arange(count) / max(count, 1)
    return np.stack((np.cos(angle), np.sin(angle)), axis=-1)


def _rectangle(count: int) -> FloatArray:
    """Places around the square from -1 to 1, from a corner on, shape ``(count, 2)``."""
    along = 4.0 * np.arange(count) / max(count, 1)
    side = along.astype(np.int64)
    corners = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)])
    share = (along - side)[:, None]
    return (1.0 - share) * corners[side] + share * corners[side + 1]
