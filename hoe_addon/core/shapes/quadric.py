# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes, spheres, conics and cylinders: one closed form for all surfaces of second degree.

The surface is ``c (wx x^2 + wy y^2 + wz z^2) = 2 z`` with the curvature c = 1 / radius. No step
divides by c, so a plane (c = 0) and a radius of a million kilometres keep all digits.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal, override

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, dot, unit
from ..errors import SpecError
from .shape import check_conic, check_radius

type _Weights = tuple[float, float, float]


class Quadric(ABC):
    """Common part of all surfaces of second degree; see `Shape`."""

    @property
    @abstractmethod
    def curvature(self) -> float:
        """One over the radius at the vertex, per metre; 0 for a plane."""

    @property
    @abstractmethod
    def weights(self) -> _Weights:
        """The weights wx, wy, wz of the squares."""

    def intersect(self, origin: ArrayLike, direction: ArrayLike) -> FloatArray:
        """Return the distance to the first crossing of the vertex sheet; see `Shape`."""
        heading = as_float(direction)
        start, ahead = _near_vertex(as_float(origin), heading)
        first, second = self._roots(start, heading)
        with np.errstate(invalid="ignore"):
            distances = np.sort(
                [self._on_sheet(start, heading, root, ahead) for root in (first, second)], axis=0
            )
        # NaN sorts last, so the first row has the nearest crossing there is.
        return distances[0]

    def normal(self, points: ArrayLike) -> FloatArray:
        """Return the unit normal on the side of +z; see `Shape`."""
        places = as_float(points)
        return unit(_Z - self.curvature * as_float(self.weights) * places)

    def sag(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the height of the surface; see `Shape`."""
        wx, wy, wz = self.weights
        across, along = as_float(x), as_float(y)
        # The curvature goes into the squares, so that the rim of a sphere belongs to it.
        bend = wx * (self.curvature * across) ** 2 + wy * (self.curvature * along) ** 2
        squares = wx * across**2 + wy * along**2
        with np.errstate(invalid="ignore"):
            return np.asarray(self.curvature * squares / (1.0 + np.sqrt(1.0 - wz * bend)))

    def _roots(self, start: FloatArray, heading: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return both solutions of ``a t^2 + 2 b t + k = 0`` without cancellation."""
        weighted = self.curvature * as_float(self.weights) * start
        a = dot(self.curvature * as_float(self.weights) * heading, heading)
        b = dot(weighted, heading) - heading[..., 2]
        k = dot(weighted, start) - 2.0 * start[..., 2]
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            q = -b - np.copysign(np.sqrt(b * b - a * k), b)
            return k / q, q / a

    def _on_sheet(
        self, start: FloatArray, heading: FloatArray, root: FloatArray, ahead: FloatArray
    ) -> FloatArray:
        """Return the distance of a root from the ray's own start; NaN where it does not count."""
        z = start[..., 2] + root * heading[..., 2]
        distance = root + ahead
        counts = np.isfinite(root) & (distance >= 0.0)
        counts &= 1.0 - self.curvature * self.weights[2] * z >= 0.0
        return np.where(counts, distance, np.nan)


_Z = np.array([0.0, 0.0, 1.0])


def _near_vertex(origin: FloatArray, heading: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the point of each ray nearest to the vertex, and its distance from the start.

    Solving from there keeps the squares of a far start out of the discriminant.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        ahead = -dot(origin, heading) / dot(heading, heading)
        return origin + ahead[..., None] * heading, ahead


@dataclass(frozen=True)
class Plane(Quadric):
    """The plane z = 0; see `Shape`."""

    @property
    @override
    def curvature(self) -> float:
        return 0.0

    @property
    @override
    def weights(self) -> _Weights:
        return (0.0, 0.0, 0.0)

    @override
    def intersect(self, origin: ArrayLike, direction: ArrayLike) -> FloatArray:
        # Straight from the start: a start on the plane stays at the distance 0 exactly.
        height, slope = as_float(origin)[..., 2], as_float(direction)[..., 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = -height / slope
            return np.where((slope != 0.0) & (distance >= 0.0), np.abs(distance), np.nan)

    @override
    def sag(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))


@dataclass(frozen=True)
class Conic(Quadric):
    """A conic of revolution about z; see `Shape`.

    Attributes:
        radius: Radius at the vertex, metres, not 0; may be infinite.
        conic: Conic constant: 0 is a sphere, -1 a paraboloid, below that a hyperboloid.
    """

    radius: float
    conic: float = 0.0

    def __post_init__(self) -> None:
        """Check the fields."""
        check_radius(self.radius)
        check_conic(self.conic)

    @property
    @override
    def curvature(self) -> float:
        return 1.0 / self.radius

    @property
    @override
    def weights(self) -> _Weights:
        return (1.0, 1.0, 1.0 + self.conic)


@dataclass(frozen=True)
class Cylinder(Quadric):
    """A circular cylinder; see `Shape`.

    Attributes:
        radius: Metres, not 0; may be infinite.
        axis: Direction of its axis: ``x`` or ``y``.
    """

    radius: float
    axis: Literal["x", "y"] = "y"

    def __post_init__(self) -> None:
        """Check the fields."""
        check_radius(self.radius)
        if self.axis not in ("x", "y"):
            raise SpecError(f"axis: must be x or y, got {self.axis}")

    @property
    @override
    def curvature(self) -> float:
        return 1.0 / self.radius

    @property
    @override
    def weights(self) -> _Weights:
        return (0.0, 1.0, 1.0) if self.axis == "x" else (1.0, 0.0, 1.0)
