# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through a chain of surfaces, with their derivatives to the place where they start.

A ray is named by the place ``(x, y)`` where it meets the first surface, in metres in the frame of
that surface. For a point source this fixes the direction, for a plane wave the place on the wave
front; unlike these it stays in the aperture's bounds whether the source is near or far.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, as_float, unit
from ..waves.plane import PlaneWave
from .system import OpticalSurface, OpticalSystem

NOWHERE = -1
"""In place of the number of a surface."""

_RIM = 1e-12
"""The rim of an aperture belongs to it, also after rounding; relative, to the square."""


@dataclass(frozen=True, eq=False)
class Rays:
    """N rays behind the last surface, or wherever they are on their way.

    Attributes:
        place: Points, metres, shape ``(N, 3)``; NaN for a ray that is lost.
        heading: Unit directions of travel, shape ``(N, 3)``.
        place_change: Derivatives of `place` to the two coordinates of the start, at the same
            travelled distance or not: along the ray they mean nothing. Shape ``(N, 2, 3)``.
        heading_change: Derivatives of `heading`, per metre, shape ``(N, 2, 3)``.
        path: Optical path up to `place`, metres, shape ``(N,)``.
        lost: The surface that a ray does not meet or pass, or `NOWHERE`, shape ``(N,)``.
        clipped: The first surface that it meets outside the aperture, or `NOWHERE`, ``(N,)``.
    """

    place: FloatArray
    heading: FloatArray
    place_change: FloatArray
    heading_change: FloatArray
    path: FloatArray
    lost: IntArray
    clipped: IntArray


def trace(system: OpticalSystem, starts: FloatArray) -> Rays:
    """Send rays from the source through all surfaces.

    Apertures stop no ray: `Rays.clipped` says where one should have. So a search may pass over
    places that no ray comes from.

    Args:
        system: The chain.
        starts: Places on the first surface, in its frame, metres, shape ``(N, 2)``.

    Returns:
        The rays at the last surface, behind it, in the frame of the hologram.
    """
    first = system.surfaces[0]
    with np.errstate(all="ignore"):
        rays, path = _launch(system, starts)
        lost = np.where(np.isfinite(rays[:, 1, 0]), NOWHERE, 0)
        clipped = np.where(_outside(rays[:, 0], first), 0, NOWHERE)
        for number, surface in enumerate(system.surfaces):
            if number:
                rays, travelled = _to_surface(rays, system.surfaces[number - 1], surface)
                path = path + system.indices[number] * travelled
                outside = _outside(rays[:, 0], surface)
                clipped = np.where((clipped == NOWHERE) & outside, number, clipped)
            rays = _across(rays, surface, system.indices[number], system.indices[number + 1])
            alive = np.isfinite(rays[:, 1, 0])
            lost = np.where((lost == NOWHERE) & ~alive, number, lost)
        rays = rays @ system.surfaces[-1].frame.rotation.T
        place = rays[:, 0] + system.surfaces[-1].frame.origin
    return Rays(place, rays[:, 1], rays[:, 2:4], rays[:, 4:6], path, lost, clipped)


# Inside this file a ray is one array of six vectors, so that a change of frame is one product:
# place, heading, the two derivatives of the place, the two of the heading.


def _launch(system: OpticalSystem, starts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rays at the first surface, before it, in its frame; and their optical path."""
    surface, source = system.surfaces[0], system.source
    x, y = starts[:, 0], starts[:, 1]
    rays = np.zeros((len(starts), 6, 3))
    rays[:, 0] = np.stack((x, y, surface.shape.sag(x, y)), axis=-1)
    rays[:, 2:4, :2] = np.eye(2)
    normal = surface.shape.normal(rays[:, 0])
    rays[:, 2:4, 2] = -normal[:, :2] / normal[:, 2:]
    if isinstance(source, PlaneWave):
        rays[:, 1] = surface.frame.vector_to_local(unit(source.direction))
        heading = unit(source.direction)
        return rays, source.index * np.vecdot(surface.frame.point_to_world(rays[:, 0]), heading)
    sign = -1.0 if source.converging else 1.0
    away = rays[:, 0] - surface.frame.point_to_local(as_float(source.position))
    distance = np.sqrt(np.vecdot(away, away))
    rays[:, 1] = sign * away / distance[:, None]
    along = np.vecdot(rays[:, 2:4], rays[:, None, 1])[..., None] * rays[:, None, 1]
    rays[:, 4:6] = sign * (rays[:, 2:4] - along) / distance[:, None, None]
    return rays, sign * source.index * distance


def _to_surface(
    rays: FloatArray, before: OpticalSurface, surface: OpticalSurface
) -> tuple[FloatArray, FloatArray]:
    """Return rays at the next surface, in its frame, and how far they travelled to it."""
    rays = rays @ (before.frame.rotation.T @ surface.frame.rotation)
    rays[:, 0] += surface.frame.point_to_local(before.frame.origin)
    distance = surface.shape.intersect(rays[:, 0], rays[:, 1])
    rays[:, 0] += distance[:, None] * rays[:, 1]
    rays[:, 2:4] += distance[:, None, None] * rays[:, 4:6]
    # The derivative of the distance keeps the changed place on the surface.
    normal = surface.shape.normal(rays[:, 0])
    slip = np.vecdot(rays[:, 2:4], normal[:, None]) / np.vecdot(rays[:, 1], normal)[:, None]
    rays[:, 2:4] -= slip[..., None] * rays[:, None, 1]
    return rays, distance


def _across(rays: FloatArray, surface: OpticalSurface, before: float, after: float) -> FloatArray:
    """Return rays behind a surface; NaN for total reflection."""
    heading, heading_change = rays[:, 1], rays[:, 4:6]
    normal, normal_change = _normal(surface, rays[:, 0], rays[:, 2:4])
    cos = np.vecdot(heading, normal)
    turned = np.where(cos < 0.0, -1.0, 1.0)
    normal, cos = turned[:, None] * normal, turned * cos
    normal_change = turned[:, None, None] * normal_change
    cos_change = np.vecdot(heading_change, normal[:, None]) + np.vecdot(
        normal_change, heading[:, None]
    )
    if surface.index_after is None:
        push, push_change, after = -2.0 * before * cos, -2.0 * before * cos_change, before
    else:
        # (n' cos')^2 from the change of index: no digits are lost toward grazing.
        inner = np.sqrt((after - before) * (after + before) + (before * cos) ** 2)
        push = inner - before * cos
        push_change = (before * (before * cos / inner - 1.0))[:, None] * cos_change
    result = rays.copy()
    result[:, 1] = (before * heading + push[:, None] * normal) / after
    result[:, 4:6] = (
        before * heading_change
        + push_change[..., None] * normal[:, None]
        + push[:, None, None] * normal_change
    ) / after
    return result


def _normal(
    surface: OpticalSurface, place: FloatArray, place_change: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return unit normals, shape ``(N, 3)``, and their derivatives, shape ``(N, 2, 3)``."""
    bend = -as_float(surface.shape.weights) * surface.shape.curvature
    upright = bend * place
    upright[:, 2] += 1.0
    length = np.sqrt(np.vecdot(upright, upright))
    normal = upright / length[:, None]
    change = bend * place_change / length[:, None, None]
    change -= np.vecdot(change, normal[:, None])[..., None] * normal[:, None]
    return normal, change


def _outside(place: FloatArray, surface: OpticalSurface) -> np.ndarray:
    square = place[:, 0] ** 2 + place[:, 1] ** 2
    return square > surface.semi_diameter**2 * (1.0 + _RIM)
