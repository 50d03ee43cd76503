# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that furniture is made of: plain numpy until they become one mesh."""

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..build import meshes

_ROUND = 4
"""Decimals (of a scene unit) below which two corners are one."""

_CUBE_CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
_CUBE_FACES = [
    (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
]  # fmt: skip


@dataclass(frozen=True, eq=False)
class Shape:
    """Four-sided faces over corners.

    Attributes:
        corners: Points in scene units, shape ``(n, 3)``.
        faces: Corner numbers, counter-clockwise seen from outside, shape ``(m, 4)``.
    """

    corners: NDArray[np.float64]
    faces: NDArray[np.int64]

    def moved(self, *offset: float) -> "Shape":
        """The same shape elsewhere."""
        return Shape(self.corners + np.asarray(offset), self.faces)

    def turned(self, axis: str, degrees: float) -> "Shape":
        """The same shape, turned around an axis through the origin, right-handed."""
        angle = np.radians(degrees)
        first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        matrix = np.eye(3)
        matrix[first, first] = matrix[second, second] = np.cos(angle)
        matrix[second, first] = np.sin(angle)
        matrix[first, second] = -matrix[second, first]
        return Shape(self.corners @ matrix.T, self.faces)

    def welded(self) -> "Shape":
        """The same shape with one corner at each place, for smooth shading."""
        _, first, number = np.unique(
            np.round(self.corners, _ROUND), axis=0, return_index=True, return_inverse=True
        )
        return Shape(self.corners[first], number.reshape(-1)[self.faces])

    def mesh(self, name: str, *, smooth: bool = False) -> bpy.types.Mesh:
        """Make a mesh of it."""
        mesh = meshes.from_polygons(name, self.corners.tolist(), self.faces.tolist())
        if smooth:
            mesh.shade_smooth()
        return mesh


def joined(shapes: Sequence[Shape]) -> Shape:
    """Several shapes as one."""
    starts = np.cumsum([0, *(len(shape.corners) for shape in shapes[:-1])])
    return Shape(
        np.concatenate([shape.corners for shape in shapes]),
        np.concatenate([s.faces + start for s, start in zip(shapes, starts, strict=True)]),
    )


def box(low: ArrayLike, high: ArrayLike) -> Shape:
    """A box between two opposite corners."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    corners = np.asarray(_CUBE_CORNERS) * (high - low) + (low + high) / 2.0
    return Shape(corners, np.asarray(_CUBE_FACES))


def grid(points: NDArray[np.float64], *, wrapped: bool = False) -> Shape:
    """A sheet through rows of points.

    Args:
        points: Shape ``(rows, columns, 3)``; the normal is along (next column) x (next row).
        wrapped: Whether the last column meets the first one.

    Returns:
        The sheet.
    """
    rows, columns, _ = points.shape
    number = np.arange(rows * columns).reshape(rows, columns)
    if wrapped:
        number = np.concatenate((number, number[:, :1]), axis=1)
    ring = (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    return Shape(points.reshape(-1, 3), np.stack([side.ravel() for side in ring], axis=1))


def lathe(profile: Sequence[tuple[float, float]], sides: int = 40) -> Shape:
    """A body of revolution around z, from (radius, z), the lowest point first."""
    angle = np.arange(sides) * (2.0 * np.pi / sides)
    radius, z = np.asarray(profile, dtype=float).T[..., None]
    z = np.broadcast_to(z, (len(profile), sides))
    return grid(
        np.stack((radius * np.cos(angle), radius * np.sin(angle), z), axis=-1), wrapped=True
    )


def tube(path: NDArray[np.float64], radius: float, sides: int = 8) -> Shape:
    """A round rod along a path that is nowhere level; its cross sections stay level."""
    angle = np.arange(sides) * (2.0 * np.pi / sides)
    circle = radius * np.stack((np.cos(angle), np.sin(angle), 0.0 * angle), axis=1)
    return grid(path[:, None, :] + circle, wrapped=True)


def rounded_box(size: Sequence[float], radius: float, bulge: float = 0.0) -> Shape:
    """An upholstered box around the origin.

    Args:
        size: Its lengths, without the bulge.
        radius: Radius of edges and corners.
        bulge: How far the middle of each side stands out.

    Returns:
        The body, welded.
    """
    half = np.asarray(size, dtype=float) / 2.0
    cube = joined([_cube_side(axis, sign) for axis in range(3) for sign in (-1.0, 1.0)])
    # Even steps of the cube become dense near the edges, where the rounding is.
    corners = np.sin(cube.corners * np.pi / 2.0) * half
    core = np.clip(corners, radius - half, half - radius)
    outward = corners - core
    outward /= np.maximum(np.linalg.norm(outward, axis=1, keepdims=True), 1e-9)
    on_side = np.abs(corners) >= half * (1.0 - 1e-9)
    share = np.where(on_side, 1.0, 1.0 - (corners / half) ** 2)
    flat = on_side.sum(axis=1, keepdims=True) == 1
    crown = bulge * np.prod(share, axis=1, keepdims=True) * np.sign(corners) * (on_side & flat)
    return Shape(core + radius * outward + crown, cube.faces).welded()


def pillow(width: float, height: float, thickness: float) -> Shape:
    """A cushion around the origin, flat along y, with pulled-out corners."""
    u, v = np.meshgrid(*[np.sin(np.linspace(-1.0, 1.0, 17) * np.pi / 2.0)] * 2)
    depth = 0.5 * thickness * np.sqrt((1.0 - u**4) * (1.0 - v**4))
    x = 0.5 * width * u * (1.0 - 0.09 * (1.0 - v**2) * u**2)
    z = 0.5 * height * v * (1.0 - 0.09 * (1.0 - u**2) * v**2)
    front = grid(np.stack((x, -depth, z), axis=-1))
    back = grid(np.stack((x, depth, z), axis=-1))
    return joined([front, Shape(back.corners, back.faces[:, ::-1])]).welded()


def _cube_side(axis: int, sign: float) -> Shape:
    u, v = np.meshgrid(*[np.linspace(-1.0, 1.0, 13)] * 2)
    points = np.full((*u.shape, 3), sign)
    points[..., (axis + 1) % 3] = u
    points[..., (axis + 2) % 3] = v
    sheet = grid(points)
    return sheet if sign > 0.0 else Shape(sheet.corners, sheet.faces[:, ::-1])
