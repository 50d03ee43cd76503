# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""By how much a ray misses a point, and how that changes with the ray's start."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .chain import NOWHERE, Rays, trace
from .system import OpticalSystem


@dataclass(frozen=True, eq=False)
class Landing:
    """N rays and the N points that they are to reach.

    Attributes:
        start: Places on the first surface, shape ``(N, 2)``.
        miss: The point from the ray's nearest place, in two directions across the ray, metres,
            shape ``(N, 2)``.
        jacobian: Derivative of ``-miss`` to the start, dimensionless, shape ``(N, 2, 2)``.
        ahead: How far behind the last surface the ray passes the point, metres, shape ``(N,)``.
        heading: Unit directions of travel, shape ``(N, 3)``.
        path: Optical path up to the point, metres, shape ``(N,)``.
        blocked: The surface that a ray is lost at or clipped by, or `NOWHERE`, shape ``(N,)``.
    """

    start: FloatArray
    miss: FloatArray
    jacobian: FloatArray
    ahead: FloatArray
    heading: FloatArray
    path: FloatArray
    blocked: IntArray

    @property
    def error(self) -> FloatArray:
        """Distance of the point from the ray, metres, shape ``(N,)``; infinite for a lost ray."""
        length = np.hypot(self.miss[:, 0], self.miss[:, 1])
        return np.where(np.isfinite(length), length, np.inf)

    @classmethod
    def nowhere(cls, count: int) -> Self:
        """Return rays that reach nothing."""
        two, three = np.full((count, 2), np.nan), np.full((count, 3), np.nan)
        one = np.full(count, np.nan)
        return cls(
            two,
            two.copy(),
            np.full((count, 2, 2), np.nan),
            one,
            three,
            one.copy(),
            np.full(count, NOWHERE),
        )

    def joined(self, others: Sequence[Self]) -> Self:
        """Return these rays and others behind them."""
        columns = zip(*(item._fields() for item in (self, *others)), strict=True)
        return type(self)(*(np.concatenate(column) for column in columns))

    def part(self, chosen: IntArray | BoolArray) -> Self:
        """Return some of the rays."""
        return type(self)(*(field[chosen] for field in self._fields()))

    def put(self, chosen: IntArray, other: Self) -> None:
        """Replace some of the rays."""
        for field, values in zip(self._fields(), other._fields(), strict=True):
            field[chosen] = values

    def _fields(self) -> tuple[np.ndarray, ...]:
        return (
            self.start,
            self.miss,
            self.jacobian,
            self.ahead,
            self.heading,
            self.path,
            self.blocked,
        )


def land(system: OpticalSystem, starts: FloatArray, points: FloatArray) -> Landing:
    """Trace rays and compare them with the points that they are to reach.

    Args:
        system: The chain.
        starts: Places on the first surface, in its frame, metres, shape ``(N, 2)``.
        points: The points, in the hologram's frame, metres, shape ``(N, 3)``.

    Returns:
        The landing of each ray.
    """
    rays = trace(system, starts)
    with np.errstate(all="ignore"):
        wanted = points - rays.place
        ahead = np.vecdot(wanted, rays.heading)
        across = basis(rays.heading)
        moved = rays.place_change + ahead[:, None, None] * rays.heading_change
        return Landing(
            starts,
            np.vecdot(across, wanted[:, None]),
            across @ np.swapaxes(moved, 1, 2),
            ahead,
            rays.heading,
            rays.path + system.index * ahead,
            blocked(rays),
        )


def blocked(rays: Rays) -> IntArray:
    """Return the first surface that stops each ray, or `NOWHERE`, shape ``(N,)``."""
    clipped_first = (rays.clipped != NOWHERE) & (
        (rays.lost == NOWHERE) | (rays.clipped <= rays.lost)
    )
    return np.where(clipped_first, rays.clipped, rays.lost)


def basis(heading: FloatArray) -> FloatArray:
    """Return two unit vectors across each direction.

    Args:
        heading: Unit vectors, shape ``(N, 3)``.

    Returns:
        Shape ``(N, 2, 3)``.

    References:
        Duff et al. (2017), "Building an orthonormal basis, revisited", J. Comput. Graph. Tech.
        6(1), 1-8.
    """
    x, y, z = heading[:, 0], heading[:, 1], heading[:, 2]
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.stack((1.0 + sign * x * x * a, sign * b, -sign * x), axis=-1)
    second = np.stack((b, sign + y * y * a, -y), axis=-1)
    return np.stack((first, second), axis=1)


def smallest_stretch(jacobian: FloatArray) -> FloatArray:
    """Return the smaller singular value of 2 x 2 matrices, shape ``(N,)``; 0 on a caustic."""
    with np.errstate(all="ignore"):
        a, b, c, d = (jacobian[:, i, j] for i in (0, 1) for j in (0, 1))
        larger = 0.5 * (np.hypot(a + d, b - c) + np.hypot(a - d, b + c))
        return np.abs(a * d - b * c) / larger
