# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hologram of a document evaluated in numpy: rays through it, and its efficiencies."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, as_float
from ..core.efficiency import Polarization, meet
from ..core.errors import SpecError
from ..core.orders import TRANSMITTED_ZERO, Branch, OrderFan, order_weights
from ..core.ray_law import Status
from ..core.shapes import MeshShape
from ..core.units import m_to_mm, mm_to_m, nm_to_m
from .convert import pattern_from
from .element import element_shape, first_hit
from .hologram import HologramSpec
from .medium import medium_from
from .rays import RayTable, TraceResult

DRAW_SEED = 20260601
"""Seed of the numbers by which `trace` draws points of extended sources, in the order of rays."""


def fan(
    spec: HologramSpec,
    points_mm: ArrayLike,
    direction: ArrayLike,
    wavelength_nm: ArrayLike,
    branches: Sequence[Branch],
    draws: ArrayLike | None = None,
    polarization: Polarization = Polarization.UNPOLARISED,
) -> OrderFan:
    """Diffract rays that hit a hologram, with the power of each branch.

    Args:
        spec: The hologram.
        points_mm: Points on its surface, mm, shape ``(..., 3)``.
        direction: Unit directions of travel, shape ``(..., 3)``; along the normal there, such as
            z > 0 on a plane, light comes from the back.
        wavelength_nm: Vacuum wavelengths, nm, broadcastable to ``(...)``.
        branches: Ways out to look at; any order, listed in the document or not.
        draws: Uniform numbers in [0, 1) that choose the points of extended sources, shape
            ``(..., pattern.draws)``; None for a middle point.
        polarization: Of the light.

    Returns:
        Directions, weights and status, shape ``(..., K)``; with total internal reflection, or
        where nothing is recorded, the transmitted and reflected order 0 may follow those asked
        for.

    Raises:
        SpecError: If a medium has no index at one of the wavelengths.
    """
    ways = tuple(branches)
    if spec.efficiency.total_internal_reflection and TRANSMITTED_ZERO not in ways:
        ways = (*ways, TRANSMITTED_ZERO)
    incident, wavelength_nm = as_float(direction), as_float(wavelength_nm)
    wavelength = nm_to_m(wavelength_nm)
    back, front = (_index(spec, side, wavelength) for side in ("back", "front"))
    points = mm_to_m(as_float(points_mm))
    normal = element_shape(spec).normal(points)
    pattern = pattern_from(spec.pattern)
    gradient, light = meet(pattern, points, draws, normal, incident, wavelength, (back, front))
    return order_weights(
        ways,
        spec.efficiency.model().shares(ways, light, polarization),
        incident,
        normal,
        gradient,
        wavelength_nm / spec.pattern.wavelength_nm,
        light.index_in,
        light.index_out,
        total_internal_reflection=spec.efficiency.total_internal_reflection,
    )


def _index(spec: HologramSpec, side: str, wavelength: FloatArray) -> FloatArray:
    try:
        return medium_from(getattr(spec.media, side)).index(wavelength)
    except SpecError as error:
        raise SpecError(f"media.{side}: {error}") from error


def trace(spec: HologramSpec, rays: RayTable) -> TraceResult:
    """Send rays through a hologram, each into the one branch that it names.

    In a multiplexed hologram an order has a branch for each exposure: a ray follows that which
    gives it the most light.

    Args:
        spec: The hologram, in its own frame.
        rays: Rays in its frame; with extended sources each meets the wave of a point of its own,
            drawn with the seed `DRAW_SEED`. One that starts beyond the element, runs along a
            plane, or passes outside its outline is a miss; one that starts on a plane hits there.

    Returns:
        Hit points, directions, status and efficiency.

    Raises:
        SpecError: If a medium has no index at one of the wavelengths.
    """
    distance, hit_mm = first_hit(spec, rays.origin_mm, rays.direction)
    met = np.isfinite(distance)
    count = len(rays)
    draws = np.random.default_rng(DRAW_SEED).random((count, pattern_from(spec.pattern).draws))
    direction = np.full((count, 3), np.nan)
    status = np.full(count, int(Status.MISS), dtype=np.int64)
    efficiency = np.full(count, np.nan)
    for order, reflected in sorted(
        set(zip(rays.order.tolist(), rays.reflected.tolist(), strict=True))
    ):
        chosen = np.flatnonzero(met & (rays.order == order) & (rays.reflected == reflected))
        ways = _of_order(spec, order, reflected=reflected)
        out = fan(
            spec,
            hit_mm[chosen],
            rays.direction[chosen],
            rays.wavelength_nm[chosen],
            ways,
            draws[chosen],
        )
        every = np.arange(len(chosen))
        best = np.argmax(out.weights[:, : len(ways)], axis=1)
        direction[chosen] = out.directions[every, best]
        status[chosen] = out.status[every, best]
        efficiency[chosen] = out.weights[every, best]
    return TraceResult(hit_mm, direction, status, efficiency)


def followed_frequency(spec: HologramSpec, rays: RayTable) -> FloatArray:
    """Tell which exposure each ray follows in `trace`: that which gives it the most light.

    Args:
        spec: The hologram.
        rays: Rays in its frame.

    Returns:
        `Branch.frequency` of the branch, shape ``(n,)``; 1 unless the hologram is multiplexed.
    """
    found = np.ones(len(rays))
    for order, reflected in set(zip(rays.order.tolist(), rays.reflected.tolist(), strict=True)):
        ways = _of_order(spec, order, reflected=reflected)
        if len(ways) == 1:
            continue
        distance, hit_mm = first_hit(spec, rays.origin_mm, rays.direction)
        asked = np.isfinite(distance) & (rays.order == order) & (rays.reflected == reflected)
        chosen = np.flatnonzero(asked)
        nm = rays.wavelength_nm[chosen]
        out = fan(spec, hit_mm[chosen], rays.direction[chosen], nm, ways)
        best = np.argmax(out.weights[:, : len(ways)], axis=1)
        found[chosen] = np.asarray([way.frequency for way in ways])[best]
    return found


def _of_order(spec: HologramSpec, order: int, *, reflected: bool) -> tuple[Branch, ...]:
    """The ways out of one order: one for each exposure of a multiplexed hologram."""
    first = Branch(order, reflected=reflected)
    listed = spec.efficiency.branches((order,), spec.pattern.wavelength_nm)
    further = (way for way in listed if way.order == order and way.reflected == reflected)
    return tuple(dict.fromkeys((first, *further)))


def centre_mm(spec: HologramSpec) -> FloatArray:
    """Find the middle of an element.

    Args:
        spec: The hologram.

    Returns:
        The vertex; for a mesh the place at x = y = 0 or, where there is none, the corner nearest
        to that line. In mm, shape ``(3,)``.
    """
    shape = element_shape(spec)
    if not isinstance(shape, MeshShape):
        return np.zeros(3)
    height = float(shape.sag(0.0, 0.0))
    if np.isfinite(height):
        return m_to_mm(np.array((0.0, 0.0, height)))
    corners = shape.vertices
    return m_to_mm(corners[np.argmin(np.hypot(corners[:, 0], corners[:, 1]))])


def incident_direction(theta_deg: ArrayLike, phi_deg: ArrayLike, *, from_front: bool) -> FloatArray:
    """Direction of an incident ray from its angles in its own medium.

    Args:
        theta_deg: Angle from the surface normal, degrees, shape ``(...)``.
        phi_deg: Azimuth of the direction of travel from +x toward +y, degrees, broadcastable.
        from_front: Whether the ray comes from z > 0, and so travels toward -z.

    Returns:
        Unit vectors, shape ``(..., 3)``.
    """
    theta, phi = np.broadcast_arrays(np.radians(as_float(theta_deg)), np.radians(as_float(phi_deg)))
    toward = -1.0 if from_front else 1.0
    sine = np.sin(theta)
    return np.stack((sine * np.cos(phi), sine * np.sin(phi), toward * np.cos(theta)), axis=-1)


def efficiencies(
    spec: HologramSpec,
    direction: ArrayLike,
    wavelength_nm: ArrayLike,
    orders: Sequence[int],
    polarization: Polarization = Polarization.UNPOLARISED,
) -> FloatArray:
    """Share of the power in each order and side, for rays through the centre of a hologram.

    Args:
        spec: The hologram.
        direction: Unit directions of travel, shape ``(..., 3)``.
        wavelength_nm: Vacuum wavelengths, nm, broadcastable to ``(...)``.
        orders: The K orders, listed in the document or not.
        polarization: Of the light.

    Returns:
        Shares, shape ``(..., K, 2)``: transmitted, reflected; exactly 0 where evanescent. Of a
        multiplexed hologram an order is the sum over its exposures.

    Raises:
        SpecError: If a medium has no index at one of the wavelengths.
    """
    groups = [_of_order(spec, order, reflected=side) for order in orders for side in (False, True)]
    ways = [way for group in groups for way in group]
    out = fan(spec, centre_mm(spec), direction, wavelength_nm, ways, polarization=polarization)
    starts = np.cumsum([0, *(len(group) for group in groups[:-1])])
    shares = np.add.reduceat(out.weights[..., : len(ways)], starts, axis=-1)
    return shares.reshape(*shares.shape[:-1], len(orders), 2)
