# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an extended source touches the element, and whether a window is before it."""

import numpy as np

from ..core.arrays import FloatArray, as_float, unit
from ..core.shapes import MeshShape
from ..core.units import m_to_mm, mm_to_m
from .source_shapes import Point
from .surface import SurfaceSpec
from .waves import FlatWindowSpec

_LOOKED_AT = 9
"""Points of an element along each side."""
_NEAR_MM = 1e-6
"""An end of an edge nearer to the surface than this, along z, counts as on it."""


def touched_mm(surface: SurfaceSpec, edges_mm: FloatArray) -> Point | None:
    """Find a place where edges of a source meet an element.

    Args:
        surface: The element's surface.
        edges_mm: Start and end of each edge, in the frame of the surface, mm, shape
            ``(n, 2, 3)``.

    Returns:
        One such place, in mm; None where there is none.
    """
    ends = np.unique(edges_mm.reshape(-1, 3), axis=0)
    upright = np.array((0.0, 0.0, _NEAR_MM))
    # An edge that lies in the surface crosses it nowhere: its ends are looked at, too.
    through = np.stack((ends - upright, ends + upright), axis=1)
    # From both ends, since only the first crossing is found, and it may be beside the element.
    both_ways = np.concatenate((edges_mm, edges_mm[:, ::-1], through))
    start, step = both_ways[:, 0], both_ways[:, 1] - both_ways[:, 0]
    length = np.linalg.norm(step, axis=1)
    start, step, length = start[length > 0.0], step[length > 0.0], length[length > 0.0]
    heading = unit(step)
    distance = m_to_mm(surface.core_shape().intersect(mm_to_m(start), heading))
    places = start + distance[:, None] * heading
    with np.errstate(invalid="ignore"):
        met = np.flatnonzero((distance <= length) & surface.covers(places))
    if len(met) == 0:
        return None
    x, y, z = places[met[0]]
    return (float(x), float(y), float(z))


def is_behind(surface: SurfaceSpec, window: FlatWindowSpec) -> bool:
    """Tell whether any part of an element lies behind a window, where its light comes out.

    Args:
        surface: The element's surface.
        window: The window.

    Returns:
        True where one of some points does, or lies on the far face.
    """
    shape = surface.core_shape()
    if isinstance(shape, MeshShape):
        points_mm = m_to_mm(shape.vertices)
    else:
        steps = np.linspace(-0.5, 0.5, _LOOKED_AT)
        x_mm, y_mm = (
            grid.ravel()
            for grid in np.meshgrid(surface.size_mm[0] * steps, surface.size_mm[1] * steps)
        )
        sag_mm = m_to_mm(shape.sag(mm_to_m(x_mm), mm_to_m(y_mm)))
        points_mm = np.stack((x_mm, y_mm, sag_mm), axis=-1)
    depths_mm = (points_mm - as_float(window.position_mm)) @ unit(window.normal)
    return bool(np.any(depths_mm >= window.thickness_mm - _NEAR_MM))
