# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every ray that reaches a point, found from a fan over the first surface.

At each point the miss of all fan rays is looked at, and every local minimum of it over the
aperture starts a Newton search. So where a caustic has folded the beam, all its sheets are found.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .chain import NOWHERE, trace
from .landing import Landing, basis, blocked, smallest_stretch
from .newton import newton, tolerance
from .system import OpticalSystem

FAN = 33
"""Fan rays across the aperture's diameter."""

SINGULAR = 1e-4
"""Where a patch of the aperture shrinks to less than this in one direction, rays cross."""

_MOST = 8
"""Searches for one point."""

_SAME = 1e-6
"""Two starts nearer than this, over the semi-diameter, are one ray."""

_BESIDE = 3
"""A fold within so many fan rays may hide one of its two rays: minima so near melt into one. Within
one, rays cannot be told apart for sure."""

_CHUNK = 256
"""Points looked at together; each has a miss for every fan ray."""


@dataclass(frozen=True, eq=False)
class Fan:
    """Rays over the first aperture, traced once.

    Attributes:
        start: Places on the first surface, shape ``(F, 2)``.
        place: Points on the last surface, shape ``(F, 3)``; NaN for a ray that is lost.
        heading: Unit directions behind it, shape ``(F, 3)``.
        determinant: Coefficients 1, s, s^2 of the determinant of the change of place across the
            ray at the distance s behind the last surface, shape ``(3, F)``.
        passes: Which rays pass all apertures, shape ``(F,)``.
    """

    start: FloatArray
    place: FloatArray
    heading: FloatArray
    determinant: FloatArray
    passes: BoolArray

    @classmethod
    def of(cls, system: OpticalSystem) -> "Fan":
        """Trace a fan.

        Args:
            system: The chain.

        Returns:
            `FAN` by `FAN` rays, those off the round aperture NaN.
        """
        start = starts(system)
        rays = trace(system, start)
        semi_diameter = system.surfaces[0].semi_diameter
        inside = np.hypot(start[:, 0], start[:, 1]) <= semi_diameter
        with np.errstate(all="ignore"):
            across = basis(rays.heading)
            still = across @ np.swapaxes(rays.place_change, 1, 2)
            grow = across @ np.swapaxes(rays.heading_change, 1, 2)
        (a, b), (c, d) = np.moveaxis(still, 0, -1)
        (e, f), (g, h) = np.moveaxis(grow, 0, -1)
        determinant = np.stack((a * d - b * c, a * h + d * e - b * g - c * f, e * h - f * g))
        place = np.where(inside[:, None], rays.place, np.nan)
        passes = inside & (blocked(rays) == NOWHERE)
        return cls(start, place, rays.heading, determinant, passes)


def starts(system: OpticalSystem) -> FloatArray:
    """Return the grid of a fan on the first surface, metres, shape ``(FAN * FAN, 2)``."""
    steps = np.linspace(-1.0, 1.0, FAN) * system.surfaces[0].semi_diameter
    y, x = np.meshgrid(steps, steps, indexing="ij")
    return np.stack((x.ravel(), y.ravel()), axis=-1)


@dataclass(frozen=True, eq=False)
class Found:
    """What a search found for N points.

    Attributes:
        landing: The ray of each point; it counts only where there is exactly one.
        count: Number of different rays that reach it and pass all apertures, shape ``(N,)``; 2
            stands for more too, and for a caustic so near that rays cannot be told apart.
        in_shadow: Of points without a ray: those that rays would reach outside the apertures,
            or past the rim of the beam; shape ``(N,)``.
        nearest: How near a fan ray that passes all apertures comes, metres, shape ``(N,)``.
    """

    landing: Landing
    count: IntArray
    in_shadow: BoolArray
    nearest: FloatArray


def search(system: OpticalSystem, fan: Fan, points: FloatArray) -> Found:
    """Find all rays to points.

    Args:
        system: The chain.
        fan: Its fan.
        points: The points, metres, shape ``(N, 3)``.

    Returns:
        What was found.
    """
    parts = [
        _search(system, fan, points[first : first + _CHUNK])
        for first in range(0, len(points), _CHUNK)
    ]
    landing = parts[0].landing.joined([part.landing for part in parts[1:]])
    return Found(
        landing,
        np.concatenate([part.count for part in parts]),
        np.concatenate([part.in_shadow for part in parts]),
        np.concatenate([part.nearest for part in parts]),
    )


def _search(system: OpticalSystem, fan: Fan, points: FloatArray) -> Found:
    miss, sign = _misses(fan, points)
    owner, nearest, at_rim = _candidates(miss)
    tried = newton(system, fan.start[nearest], points[owner])
    semi_diameter = system.surfaces[0].semi_diameter
    enough = tolerance(system, points)
    arrived = tried.error <= enough
    # A search that ends nowhere inside the beam means that a caustic keeps rays away.
    in_shadow = np.ones(len(points), dtype=np.bool_)
    in_shadow[owner[~arrived & ~at_rim]] = False
    in_shadow[owner[arrived & ~_reaches(tried, enough)]] = True

    doubtful = _reaches(tried, enough) & _near_fold(sign, owner, tried, semi_diameter, _BESIDE)
    more, their_owner = _around(system, points, tried.part(doubtful), owner[doubtful])
    tried, owner = tried.joined([more]), np.concatenate((owner, their_owner))
    reaches = _reaches(tried, enough)
    unclear = reaches & (
        (smallest_stretch(tried.jacobian) < SINGULAR)
        | _near_fold(sign, owner, tried, semi_diameter, 1)
    )
    several = _spread(tried.start, owner, reaches, len(points)) > _SAME * semi_diameter
    count = np.where(several, 2, 0)
    count[owner[reaches]] = np.maximum(count[owner[reaches]], 1)
    count[owner[unclear]] = 2
    passing = np.where(fan.passes, miss.reshape(len(points), -1), np.inf)
    return Found(
        _one_each(tried, owner, reaches, len(points)),
        count,
        in_shadow,
        np.sqrt(passing.min(axis=1)),
    )


def _reaches(tried: Landing, enough: float) -> BoolArray:
    """Return which rays pass through their points and all apertures."""
    return (tried.error <= enough) & (tried.blocked < 0) & (tried.ahead > 0.0)


def _around(
    system: OpticalSystem, points: FloatArray, found: Landing, owner: IntArray
) -> tuple[Landing, IntArray]:
    """Search again from all around rays, for others so near that their minima had melted."""
    cell = 2.0 * system.surfaces[0].semi_diameter / (FAN - 1)
    turns = np.arange(8) * (0.25 * np.pi)
    ring = np.stack((np.cos(turns), np.sin(turns)), axis=-1)
    offsets = cell * np.concatenate([radius * ring for radius in (1.5, _BESIDE)])
    start = (found.start[:, None] + offsets).reshape(-1, 2)
    their_owner = np.repeat(owner, len(offsets))
    return newton(system, start, points[their_owner]), their_owner


def _misses(fan: Fan, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return squared misses, infinite for none, and signs of determinants, ``(N, FAN, FAN)``."""
    with np.errstate(invalid="ignore"):
        wanted = points[:, None] - fan.place
        ahead = np.vecdot(wanted, fan.heading)
        across = wanted - ahead[..., None] * fan.heading
        square = np.vecdot(across, across)
        usable = (ahead > 0.0) & np.isfinite(square)
        constant, linear, quadratic = fan.determinant
        sign = np.sign(constant + ahead * (linear + ahead * quadratic))
    shape = (len(points), FAN, FAN)
    return (
        np.where(usable, square, np.inf).reshape(shape),
        np.where(usable, sign, 0.0).reshape(shape),
    )


def _candidates(miss: FloatArray) -> tuple[IntArray, IntArray, BoolArray]:
    """Return local minima: point, fan ray, and whether it lies at the rim of the beam."""
    padded = np.pad(miss, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    lowest = np.isfinite(miss)
    at_rim = np.zeros(miss.shape, dtype=np.bool_)
    for j, i in ((j, i) for j in range(3) for i in range(3) if (j, i) != (1, 1)):
        neighbour = padded[:, j : j + FAN, i : i + FAN]
        lowest &= miss <= neighbour
        at_rim |= np.isinf(neighbour)
    owner, ray = np.nonzero(lowest.reshape(len(miss), -1))
    flat = miss.reshape(len(miss), -1)[owner, ray]
    order = np.lexsort((flat, owner))
    owner, ray = owner[order], ray[order]
    rank = np.arange(len(owner)) - np.searchsorted(owner, owner)
    owner, ray = owner[rank < _MOST], ray[rank < _MOST]
    return owner, ray, at_rim.reshape(len(miss), -1)[owner, ray]


def _near_fold(
    sign: FloatArray, owner: IntArray, tried: Landing, semi_diameter: float, reach: int
) -> BoolArray:
    """Return which rays have both signs of the determinant among the fan rays around them.

    A fold lies there: its two rays may have been found as one.
    """
    with np.errstate(invalid="ignore"):
        place = np.nan_to_num((tried.start / semi_diameter + 1.0) * 0.5 * (FAN - 1))
    column, row = np.clip(np.rint(place), 0, FAN - 1).astype(np.int64).T
    lowest, highest = np.zeros(len(owner)), np.zeros(len(owner))
    for j in range(-reach, reach + 1):
        for i in range(-reach, reach + 1):
            there = sign[owner, np.clip(row + j, 0, FAN - 1), np.clip(column + i, 0, FAN - 1)]
            lowest, highest = np.minimum(lowest, there), np.maximum(highest, there)
    return (highest > 0.0) & (lowest < 0.0)


def _spread(start: FloatArray, owner: IntArray, reaches: BoolArray, count: int) -> FloatArray:
    """Return how far the starts of each point's rays lie apart, metres."""
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, owner[reaches], start[reaches])
    np.maximum.at(high, owner[reaches], start[reaches])
    return np.max(high - low, axis=1)


def _one_each(tried: Landing, owner: IntArray, reaches: BoolArray, count: int) -> Landing:
    """Return one ray a point: one that reaches it, else NaN."""
    result = Landing.nowhere(count)
    chosen = np.flatnonzero(reaches)
    result.put(owner[chosen], tried.part(chosen))
    return result
