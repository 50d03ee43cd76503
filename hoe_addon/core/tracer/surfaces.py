# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar surfaces and what they do to light. All methods work in the frame of the surface."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import override

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..efficiency import EfficiencyModel, meet
from ..fresnel import reflectance_unpolarised
from ..media import Medium
from ..orders import Branch, order_weights
from ..pattern import Pattern
from ..ray_law import Status, diffract
from .geometry import Aperture, Frame

NORMAL = np.array([0.0, 0.0, 1.0])
"""The front normal of each surface in its own frame."""

_MIRROR_IMAGE = np.array([1.0, 1.0, -1.0])


@dataclass(frozen=True, eq=False)
class LocalRays:
    """Incident rays at their hits, in the frame of a surface.

    Attributes:
        points: Hit points with z = 0, metres, shape ``(R, 3)``.
        directions: Unit directions of travel, shape ``(R, 3)``.
        wavelengths: Vacuum wavelengths, metres, shape ``(R,)``.
    """

    points: FloatArray
    directions: FloatArray
    wavelengths: FloatArray

    @property
    def from_front(self) -> BoolArray:
        """Mask of the rays that come from the front, shape ``(R,)``."""
        return self.directions[:, 2] < 0.0


@dataclass(frozen=True, eq=False, kw_only=True)
class PlanarSurface(ABC):
    """A part of a plane that acts on light.

    Attributes:
        frame: Where the surface is.
        aperture: Which part of the plane it covers.
    """

    frame: Frame
    aperture: Aperture

    @abstractmethod
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        """Return directions ``(R, K, 3)`` and weights ``(R, K)`` of all ways out."""

    @abstractmethod
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        """Return the direction ``(R, 3)`` of one way out and its `Status` ``(R,)``."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Grating(PlanarSurface):
    """A hologram or grating between two media.

    Attributes:
        pattern: What is recorded in it, in the frame of the surface.
        index_back: Medium on the side z < 0.
        index_front: Medium on the side z > 0.
        branches: The ways out that carry light.
        efficiency: Their efficiencies, before evanescent orders are taken away.
        total_internal_reflection: See `order_weights`.
    """

    pattern: Pattern
    index_back: Medium
    index_front: Medium
    branches: tuple[Branch, ...]
    efficiency: EfficiencyModel
    total_internal_reflection: bool = False

    @override
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        back, front = (
            medium.index(rays.wavelengths) for medium in (self.index_back, self.index_front)
        )
        gradient, light = meet(
            self.pattern,
            rays.points,
            None,
            NORMAL,
            rays.directions,
            rays.wavelengths,
            (back, front),
        )
        fan = order_weights(
            self.branches,
            self.efficiency.shares(self.branches, light),
            rays.directions,
            NORMAL,
            gradient,
            rays.wavelengths / self.pattern.wavelength,
            light.index_in,
            light.index_out,
            total_internal_reflection=self.total_internal_reflection,
        )
        return fan.directions, fan.weights

    @override
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        index_in, index_out = _indices(rays, self.index_back, self.index_front)
        return diffract(
            rays.directions,
            NORMAL,
            self.pattern.gradient(rays.points),
            branch.steps,
            rays.wavelengths / self.pattern.wavelength,
            index_in,
            index_out,
            branch.reflected,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Dielectric(PlanarSurface):
    """A bare boundary of two media with unpolarised Fresnel reflection.

    Attributes:
        index_back: Medium on the side z < 0.
        index_front: Medium on the side z > 0.
    """

    index_back: Medium
    index_front: Medium

    @override
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        index_in, index_out = _indices(rays, self.index_back, self.index_front)
        reflectance = reflectance_unpolarised(rays.directions[:, 2], index_in, index_out)
        refracted, status = self.follow(rays, Branch(0))
        # Beyond the critical angle Fresnel says 1; the status settles rounding at the limit.
        reflectance = np.where(status == Status.OK, reflectance, 1.0)
        directions = np.stack([refracted, rays.directions * _MIRROR_IMAGE], axis=1)
        return directions, np.stack([1.0 - reflectance, reflectance], axis=1)

    @override
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        index_in, index_out = _indices(rays, self.index_back, self.index_front)
        return diffract(
            rays.directions, NORMAL, NORMAL, 0, 1.0, index_in, index_out, branch.reflected
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Mirror(PlanarSurface):
    """A mirror on both sides.

    Attributes:
        reflectance: Reflected power over incident power, in [0, 1].
    """

    reflectance: float = 1.0

    @override
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        directions, _status = self.follow(rays, Branch(0, reflected=True))
        return directions[:, None, :], np.full((len(directions), 1), self.reflectance)

    @override
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        return rays.directions * _MIRROR_IMAGE, _all_ok(rays)


@dataclass(frozen=True, eq=False, kw_only=True)
class IdealLens(PlanarSurface):
    """A thin lens without aberrations, the same from both sides.

    The slope across the axis changes by -h / f. All rays from a point of the focal plane
    leave exactly parallel, at any field angle.

    Attributes:
        focal_length: Metres, above 0 for a collecting lens.
    """

    focal_length: float

    @override
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        directions, _status = self.follow(rays, Branch(0))
        return directions[:, None, :], np.ones((len(directions), 1))

    @override
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        along = rays.directions[:, 2]
        slope = rays.directions[:, :2] / np.abs(along)[:, None]
        slope = slope - rays.points[:, :2] / self.focal_length
        length = np.sqrt(1.0 + np.sum(slope * slope, axis=1))
        onward = np.where(along < 0.0, -1.0, 1.0)
        return np.column_stack([slope, onward]) / length[:, None], _all_ok(rays)


@dataclass(frozen=True, eq=False, kw_only=True)
class Absorber(PlanarSurface):
    """A black surface on both sides. In a sequence it only marks where rays pass."""

    @override
    def scatter(self, rays: LocalRays) -> tuple[FloatArray, FloatArray]:
        count = len(rays.points)
        return np.empty((count, 0, 3)), np.empty((count, 0))

    @override
    def follow(self, rays: LocalRays, branch: Branch) -> tuple[FloatArray, IntArray]:
        return rays.directions, _all_ok(rays)


@dataclass(frozen=True, eq=False, kw_only=True)
class Receiver(Absorber):
    """A black surface that records the rays it takes from either side."""


def _indices(
    rays: LocalRays, index_back: Medium, index_front: Medium
) -> tuple[FloatArray, FloatArray]:
    """Return the index on the side the rays come from, and that of the other side."""
    back, front = index_back.index(rays.wavelengths), index_front.index(rays.wavelengths)
    from_front = rays.from_front
    return np.where(from_front, front, back), np.where(from_front, back, front)


def _all_ok(rays: LocalRays) -> IntArray:
    """Return the status OK for each ray."""
    return np.full(len(rays.points), int(Status.OK), dtype=np.int64)
