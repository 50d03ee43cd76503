# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances from rays to planar surfaces."""

import numpy as np

from ..arrays import FloatArray, IntArray
from .geometry import Rays
from .surfaces import LocalRays, PlanarSurface

NO_SURFACE = -1
"""Surface number of a ray that has hit nothing yet, or hits nothing."""

LEAVING_DISTANCE = 1e-12
"""Metres. A ray that starts this close to a plane is on it: a thousand times the rounding of
coordinates in millimetres, and far below the thickness of any part."""


def intersect(rays: Rays, surface: PlanarSurface) -> tuple[FloatArray, LocalRays]:
    """Return the signed distance along each ray to the plane, and the rays at their hits.

    Args:
        rays: R rays in the world.
        surface: The surface.

    Returns:
        Distances in metres, shape ``(R,)``, NaN where the ray does not meet the surface; and
        the local rays with their hit points at z = 0 exactly, or NaN.
    """
    start = surface.frame.point_to_local(rays.position)
    heading = surface.frame.vector_to_local(rays.direction)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = -start[:, 2] / heading[:, 2]
        points = start + distance[:, None] * heading
    points[:, 2] = 0.0
    meets = np.isfinite(distance) & surface.aperture.contains(points)
    points = np.where(meets[:, None], points, np.nan)
    return np.where(meets, distance, np.nan), LocalRays(points, heading, rays.wavelength)


def nearest(rays: Rays, surfaces: tuple[PlanarSurface, ...], left: IntArray) -> IntArray:
    """Return which surface each ray hits first.

    A plane cannot be met twice running, so the surface that a ray has just left is passed over.

    Args:
        rays: R rays in the world.
        surfaces: The surfaces. Two that coincide have no defined order.
        left: Number of the surface that each ray has just left, or NO_SURFACE, shape ``(R,)``.

    Returns:
        Number of the surface, or NO_SURFACE, shape ``(R,)``.
    """
    best = np.full(len(rays.wavelength), np.inf)
    which = np.full(len(rays.wavelength), NO_SURFACE, dtype=np.int64)
    for number, surface in enumerate(surfaces):
        distance, _local = intersect(rays, surface)
        with np.errstate(invalid="ignore"):
            closer = (distance > LEAVING_DISTANCE) & (distance < best) & (left != number)
        best = np.where(closer, distance, best)
        which = np.where(closer, number, which)
    return which
