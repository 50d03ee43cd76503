# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The even asphere: a conic and a polynomial in r^2."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import BoolArray, FloatArray, as_float, dot
from ..errors import SpecError
from .quadric import Conic
from .shape import check_conic, check_radius

_NEWTON_STEPS = 12
"""Newton doubles the digits with each step: from the conic, half of these are enough."""

_SCAN = 48
"""Places at which a ray is looked at when Newton does not settle its first crossing."""

_BISECTIONS = 60
"""Halvings of a bracket until float64 has no number left inside."""


@dataclass(frozen=True)
class EvenAsphere:
    """A rotational asphere, up to its semi-diameter; see `Shape`.

    ``z = c r^2 / (1 + sqrt(1 - (1 + conic) c^2 r^2)) + a4 r^4 + a6 r^6 + ...``

    Attributes:
        radius: Radius at the vertex, metres, not 0; may be infinite.
        conic: Conic constant.
        coefficients: a4, a6, ..., in metres^-3, metres^-5, ...
        semi_diameter: Radius of the domain, metres. Beyond it a polynomial is not meant, and
            the wings of it must not catch rays.
    """

    radius: float
    conic: float
    coefficients: tuple[float, ...]
    semi_diameter: float

    def __post_init__(self) -> None:
        """Check the fields."""
        check_radius(self.radius)
        check_conic(self.conic)
        if not all(map(math.isfinite, self.coefficients)):
            raise SpecError(f"coefficients: must be finite, got {list(self.coefficients)}")
        if not (math.isfinite(self.semi_diameter) and self.semi_diameter > 0.0):
            raise SpecError(f"semi_diameter: must be above 0, got {self.semi_diameter}")
        if (1.0 + self.conic) * (self.semi_diameter / self.radius) ** 2 > 1.0:
            raise SpecError(
                f"semi_diameter: must lie on the conic of radius {self.radius}, "
                f"got {self.semi_diameter}"
            )

    def sag(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the height of the surface; see `Shape`."""
        square = as_float(x) ** 2 + as_float(y) ** 2
        return np.where(square <= self._rim_square, self._height(square), np.nan)

    def normal(self, points: ArrayLike) -> FloatArray:
        """Return the unit normal on the side of +z; see `Shape`."""
        places = as_float(points)
        square = places[..., 0] ** 2 + places[..., 1] ** 2
        slope = 2.0 * np.where(square <= self._rim_square, self._derivative(square), np.nan)
        upright = np.stack((-slope * places[..., 0], -slope * places[..., 1], np.ones_like(slope)))
        return np.moveaxis(upright / np.sqrt(np.sum(upright**2, axis=0)), 0, -1)

    def intersect(self, origin: ArrayLike, direction: ArrayLike) -> FloatArray:
        """Return the distance to the first crossing; see `Shape`.

        Newton from the crossing of the conic answers for nearly every ray. Where it does not
        converge, or arrives at a crossing from the wrong side, the ray's way through the
        domain is scanned and the first bracket is halved.
        """
        start, heading = np.broadcast_arrays(as_float(origin), as_float(direction))
        shape = start.shape[:-1]
        start, heading = start.reshape(-1, 3), heading.reshape(-1, 3)
        enter, leave = self._way_through(start, heading)
        inside = enter <= leave
        distance = np.full(len(start), np.nan)
        if inside.any():
            chosen = np.flatnonzero(inside)
            distance[chosen] = self._first(
                start[chosen], heading[chosen], enter[chosen], leave[chosen]
            )
        return distance.reshape(shape)

    @property
    def _rim_square(self) -> float:
        # The rim itself belongs to the domain, also after rounding.
        return self.semi_diameter**2 * (1.0 + 1e-12)

    def _height(self, square: FloatArray) -> FloatArray:
        c = 1.0 / self.radius
        root = np.sqrt(np.maximum(1.0 - (1.0 + self.conic) * c * c * square, 0.0))
        return c * square / (1.0 + root) + square * square * self._polynomial(square)

    def _derivative(self, square: FloatArray) -> FloatArray:
        """Return dz / d(r^2)."""
        c = 1.0 / self.radius
        with np.errstate(divide="ignore"):
            root = np.sqrt(np.maximum(1.0 - (1.0 + self.conic) * c * c * square, 0.0))
            slope = 0.5 * c / root
        for power, value in enumerate(self.coefficients, start=2):
            slope = slope + power * value * square ** (power - 1)
        return slope

    def _polynomial(self, square: FloatArray) -> FloatArray:
        total = np.zeros_like(square)
        for value in reversed(self.coefficients):
            total = total * square + value
        return total

    def _way_through(self, start: FloatArray, heading: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where each ray is over the domain and between its lowest and highest z."""
        deepest = abs(float(Conic(self.radius, self.conic).sag(self.semi_diameter, 0.0)))
        deepest = deepest if math.isfinite(deepest) else abs(self.radius)
        for power, value in enumerate(self.coefficients, start=2):
            deepest += abs(value) * self.semi_diameter ** (2 * power)
        across, along = heading[:, :2], heading[:, 2]
        a, b = dot(across, across), dot(start[:, :2], across)
        with np.errstate(divide="ignore", invalid="ignore"):
            nearest = np.where(a > 0.0, -b / a, 0.0)
            closest = start[:, :2] + nearest[:, None] * across
            half_square = self._rim_square - dot(closest, closest)
            half = np.sqrt(half_square / a)
            half = np.where((a == 0.0) & (half_square >= 0.0), np.inf, half)
            slab = np.sort(np.stack(((-deepest - start[:, 2]), (deepest - start[:, 2]))), axis=0)
            slab = np.sort(slab / along, axis=0)
        level = along == 0.0
        between = np.abs(start[:, 2]) <= deepest
        slab[0] = np.where(level, np.where(between, -np.inf, np.inf), slab[0])
        slab[1] = np.where(level, np.where(between, np.inf, -np.inf), slab[1])
        enter = np.maximum(np.maximum(nearest - half, slab[0]), 0.0)
        leave = np.minimum(nearest + half, slab[1])
        return np.where(np.isnan(half), np.inf, enter), leave

    def _above(
        self, start: FloatArray, heading: FloatArray, distance: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the height of rays over the surface, and its derivative along them."""
        place = start + distance[..., None] * heading
        square = place[..., 0] ** 2 + place[..., 1] ** 2
        outward = place[..., 0] * heading[..., 0] + place[..., 1] * heading[..., 1]
        height = place[..., 2] - self._height(square)
        with np.errstate(invalid="ignore"):
            return height, heading[..., 2] - 2.0 * self._derivative(square) * outward

    def _first(
        self, start: FloatArray, heading: FloatArray, enter: FloatArray, leave: FloatArray
    ) -> FloatArray:
        distance, settled = self._newton(start, heading, enter, leave)
        rest = np.flatnonzero(~settled)
        if rest.size:
            distance[rest] = self._scan(start[rest], heading[rest], enter[rest], leave[rest])
        return distance

    def _newton(
        self, start: FloatArray, heading: FloatArray, enter: FloatArray, leave: FloatArray
    ) -> tuple[FloatArray, BoolArray]:
        side = np.sign(self._above(start, heading, enter)[0])
        distance = Conic(self.radius, self.conic).intersect(start, heading)
        distance = np.clip(np.where(np.isnan(distance), enter, distance), enter, leave)
        step = np.full_like(distance, np.inf)
        slope = np.zeros_like(distance)
        with np.errstate(divide="ignore", invalid="ignore"):
            for _ in range(_NEWTON_STEPS):
                height, slope = self._above(start, heading, distance)
                moved = np.clip(distance - height / slope, enter, leave)
                step, distance = np.abs(moved - distance), moved
                if np.all(step == 0.0):
                    break
            height, slope = self._above(start, heading, distance)
        size = self.semi_diameter + np.max(np.abs(start), axis=-1)
        # An asphere is first crossed from the side on which the ray comes in.
        settled = (np.abs(height) <= 1e-14 * size) & (step <= 1e-14 * size)
        return distance, settled & (slope * side < 0.0)

    def _scan(
        self, start: FloatArray, heading: FloatArray, enter: FloatArray, leave: FloatArray
    ) -> FloatArray:
        share = np.linspace(0.0, 1.0, _SCAN + 1)
        places = enter[:, None] + (leave - enter)[:, None] * share
        side = np.sign(self._above(start[:, None], heading[:, None], places)[0])
        turns = side[:, :-1] * side[:, 1:] <= 0.0
        found = turns.any(axis=1)
        first = np.argmax(turns, axis=1)
        rows = np.arange(len(start))
        low, high = places[rows, first], places[rows, first + 1]
        before = side[rows, first]
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            same = np.sign(self._above(start, heading, middle)[0]) * before > 0.0
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return np.where(found, np.where(before == 0.0, low, high), np.nan)
