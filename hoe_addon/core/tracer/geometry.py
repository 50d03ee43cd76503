# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames, apertures and bundles of rays."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import BoolArray, FloatArray, as_float, unit
from ..errors import SpecError

_ORTHONORMAL_TOLERANCE = 1e-9
"""Far above float64 rounding, far below any angle that a scene means."""


@dataclass(frozen=True, eq=False)
class Frame:
    """The place of a surface: its plane is z = 0, its front is +z.

    Attributes:
        origin: World position of the local origin, metres, shape ``(3,)``.
        rotation: Rotation whose columns are the local axes in the world, shape ``(3, 3)``.
    """

    origin: FloatArray
    rotation: FloatArray

    def __post_init__(self) -> None:
        """Check that the axes are orthonormal and right-handed."""
        origin = np.array(self.origin, dtype=np.float64)
        rotation = np.array(self.rotation, dtype=np.float64)
        object.__setattr__(self, "origin", origin)
        object.__setattr__(self, "rotation", rotation)
        error = np.max(np.abs(rotation.T @ rotation - np.eye(3)))
        if not (error < _ORTHONORMAL_TOLERANCE and np.linalg.det(rotation) > 0.0):
            raise SpecError(f"rotation: must be a rotation matrix, got {rotation.tolist()}")

    @classmethod
    def at(
        cls,
        origin: ArrayLike,
        normal: ArrayLike = (0.0, 0.0, 1.0),
        x_axis: ArrayLike | None = None,
    ) -> Self:
        """Return the frame with the given origin and front normal.

        Args:
            origin: World position, metres, shape ``(3,)``.
            normal: Direction of the front, any length but zero, shape ``(3,)``.
            x_axis: Direction near which local x shall lie; without it, world x, or world y
                where the normal is closer to x.
        """
        z_local = unit(normal)
        if x_axis is None:
            x_axis = (0.0, 1.0, 0.0) if abs(z_local[0]) > abs(z_local[1:]).max() else (1.0, 0, 0)
        wanted = as_float(x_axis)
        x_local = unit(wanted - np.dot(wanted, z_local) * z_local)
        axes = np.stack([x_local, np.cross(z_local, x_local), z_local], axis=1)
        return cls(as_float(origin), axes)

    def point_to_local(self, points: FloatArray) -> FloatArray:
        """Return world points, shape ``(..., 3)``, in this frame."""
        return (points - self.origin) @ self.rotation

    def point_to_world(self, points: FloatArray) -> FloatArray:
        """Return local points, shape ``(..., 3)``, in the world."""
        return points @ self.rotation.T + self.origin

    def vector_to_local(self, vectors: FloatArray) -> FloatArray:
        """Return world vectors, shape ``(..., 3)``, in this frame."""
        return vectors @ self.rotation

    def vector_to_world(self, vectors: FloatArray) -> FloatArray:
        """Return local vectors, shape ``(..., 3)``, in the world."""
        return vectors @ self.rotation.T


@dataclass(frozen=True)
class Rectangle:
    """A rectangle with its sides along local x and y, the rim included.

    Attributes:
        width: Length along x, metres; may be infinite.
        height: Length along y, metres; may be infinite.
        centre: Local position of the middle, metres.
    """

    width: float
    height: float
    centre: tuple[float, float] = (0.0, 0.0)

    def contains(self, points: FloatArray) -> BoolArray:
        """Return which local points, shape ``(..., 3)``, lie inside, shape ``(...)``."""
        along_x = np.abs(points[..., 0] - self.centre[0]) <= 0.5 * self.width
        return along_x & (np.abs(points[..., 1] - self.centre[1]) <= 0.5 * self.height)


@dataclass(frozen=True)
class Circle:
    """A circular disc, the rim included.

    Attributes:
        diameter: Metres; may be infinite.
        centre: Local position of the middle, metres.
    """

    diameter: float
    centre: tuple[float, float] = (0.0, 0.0)

    def contains(self, points: FloatArray) -> BoolArray:
        """Return which local points, shape ``(..., 3)``, lie inside, shape ``(...)``."""
        offset_x = points[..., 0] - self.centre[0]
        return np.hypot(offset_x, points[..., 1] - self.centre[1]) <= 0.5 * self.diameter


@dataclass(frozen=True)
class Aperture:
    """The extent of a surface, with holes where other surfaces take its place.

    A point on the rim of a hole belongs to the hole, so a patch of the same shape fills it
    with neither gap nor overlap.

    Attributes:
        shape: The outer shape.
        holes: Shapes that are left out.
    """

    shape: Rectangle | Circle
    holes: tuple[Rectangle | Circle, ...] = ()

    def contains(self, points: FloatArray) -> BoolArray:
        """Return which local points, shape ``(..., 3)``, are on the surface, shape ``(...)``."""
        inside = self.shape.contains(points)
        for hole in self.holes:
            inside &= ~hole.contains(points)
        return inside


@dataclass(frozen=True, eq=False)
class Rays:
    """A bundle of R rays in the world.

    Attributes:
        position: Points on the rays, metres, shape ``(R, 3)``.
        direction: Unit directions of travel, shape ``(R, 3)``.
        wavelength: Vacuum wavelengths, metres, shape ``(R,)``.
        weight: Power of each ray, any unit, shape ``(R,)``.
    """

    position: FloatArray
    direction: FloatArray
    wavelength: FloatArray
    weight: FloatArray

    @classmethod
    def of(
        cls,
        position: ArrayLike,
        direction: ArrayLike,
        wavelength: ArrayLike,
        weight: ArrayLike = 1.0,
    ) -> Self:
        """Return a bundle from arguments that broadcast; directions may have any length."""
        place, heading = as_float(position), unit(direction)
        length, power = as_float(wavelength), as_float(weight)
        shape = np.broadcast_shapes(
            place.shape[:-1], heading.shape[:-1], length.shape, power.shape, (1,)
        )
        count = int(np.prod(shape))
        return cls(
            np.broadcast_to(place, (*shape, 3)).reshape(count, 3),
            np.broadcast_to(heading, (*shape, 3)).reshape(count, 3),
            np.broadcast_to(length, shape).reshape(count),
            np.broadcast_to(power, shape).reshape(count),
        )

    def reversed(self) -> Self:
        """Return the same rays travelling the other way."""
        return type(self)(self.position, -self.direction, self.wavelength, self.weight)
