# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of extended sources: uniform numbers to points, evenly by length or area."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float
from ..errors import SpecError
from .wave import check_vector


class SourceShape(Protocol):
    """A curve or surface that points are drawn on."""

    @property
    def draws(self) -> int:
        """Uniform numbers that one point takes."""
        ...

    def place(self, draws: FloatArray) -> FloatArray:
        """Turn uniform numbers into points that are uniform by length or area.

        Args:
            draws: Numbers in [0, 1), shape ``(..., self.draws)``; one half each is a middle.

        Returns:
            Points in metres, shape ``(..., 3)``.
        """
        ...


@dataclass(frozen=True)
class Line:
    """A straight piece of a line.

    Attributes:
        centre: Its middle, metres.
        x: Vector from the middle to an end, metres.
    """

    centre: tuple[float, float, float]
    x: tuple[float, float, float]
    draws = 1

    def __post_init__(self) -> None:
        """Check the fields."""
        check_vector("centre", self.centre)
        check_vector("x", self.x)

    def place(self, draws: FloatArray) -> FloatArray:
        """Return points on the line; see `SourceShape`."""
        return as_float(self.centre) + (2.0 * draws[..., :1] - 1.0) * as_float(self.x)


@dataclass(frozen=True)
class Rectangle:
    """A rectangle.

    Attributes:
        centre: Its middle, metres.
        x: Vector from the middle to the middle of an edge, metres.
        y: The same for the next edge.
    """

    centre: tuple[float, float, float]
    x: tuple[float, float, float]
    y: tuple[float, float, float]
    draws = 2

    def __post_init__(self) -> None:
        """Check the fields."""
        for field in ("centre", "x", "y"):
            check_vector(field, getattr(self, field))

    def place(self, draws: FloatArray) -> FloatArray:
        """Return points on the rectangle; see `SourceShape`."""
        across = 2.0 * draws - 1.0
        return _spanned(self, across[..., :1], across[..., 1:])


@dataclass(frozen=True)
class Disc:
    """A disc.

    Attributes:
        centre: Its middle, metres.
        x: A radius, metres.
        y: The radius at a right angle to it.
    """

    centre: tuple[float, float, float]
    x: tuple[float, float, float]
    y: tuple[float, float, float]
    draws = 2

    def __post_init__(self) -> None:
        """Check the fields."""
        for field in ("centre", "x", "y"):
            check_vector(field, getattr(self, field))

    def place(self, draws: FloatArray) -> FloatArray:
        """Return points on the disc by the concentric map; see `SourceShape`.

        References:
            Shirley, Chiu (1997), "A low distortion map between disk and square",
            doi:10.1080/10867651.1997.10487479
        """
        a, b = 2.0 * draws[..., :1] - 1.0, 2.0 * draws[..., 1:] - 1.0
        wide = np.abs(a) > np.abs(b)
        radius = np.where(wide, a, b)
        with np.errstate(invalid="ignore", divide="ignore"):
            angle = np.pi / 4.0 * np.where(wide, b / a, a / b)
        angle = np.where(radius == 0.0, 0.0, angle)
        near, far = radius * np.cos(angle), radius * np.sin(angle)
        return _spanned(self, np.where(wide, near, far), np.where(wide, far, near))


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """Triangles anywhere in space.

    Attributes:
        triangles: Corners, metres, shape ``(n, 3, 3)``: triangle, corner, component.
    """

    triangles: FloatArray
    draws = 3

    def __post_init__(self) -> None:
        """Check the fields."""
        corners = as_float(self.triangles)
        if corners.ndim != 3 or corners.shape[1:] != (3, 3) or not np.isfinite(corners).all():
            raise SpecError(f"triangles: must be finite, shape (n, 3, 3), got {corners.shape}")
        if not np.sum(self.areas) > 0.0:
            raise SpecError("triangles: must have an area above 0, got 0")

    @property
    def areas(self) -> FloatArray:
        """Area of each triangle, square metres, shape ``(n,)``."""
        corners = as_float(self.triangles)
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        return np.linalg.norm(np.cross(first, second), axis=-1) / 2.0

    def place(self, draws: FloatArray) -> FloatArray:
        """Return points on the triangles: the first number chooses by area; see `SourceShape`."""
        corners = as_float(self.triangles)
        chosen = choose(cumulative(self.areas), draws[..., 0])
        first, second = draws[..., 1:2], draws[..., 2:3]
        # The half of the square beyond the diagonal is folded back onto the triangle.
        folded = first + second > 1.0
        first, second = np.where(folded, 1.0 - first, first), np.where(folded, 1.0 - second, second)
        start = corners[chosen, 0]
        along, across = corners[chosen, 1] - start, corners[chosen, 2] - start
        return start + first * along + second * across


def cumulative(areas: ArrayLike) -> FloatArray:
    """Return the share of the area up to and with each triangle.

    Args:
        areas: Areas, at least one above 0, shape ``(n,)``.

    Returns:
        Rising shares, shape ``(n,)``; exactly 1 from the last triangle with an area on.
    """
    sums = np.cumsum(as_float(areas))
    return sums / sums[-1]


def choose(shares: FloatArray, draw: ArrayLike) -> np.ndarray[tuple[int, ...], np.dtype[np.intp]]:
    """Return the triangle that a uniform number falls on; never one without area.

    Args:
        shares: Result of `cumulative`, shape ``(n,)``.
        draw: Numbers in [0, 1), shape ``(...)``.

    Returns:
        Indices, shape ``(...)``.
    """
    return np.searchsorted(shares, as_float(draw), side="right")


def _spanned(shape: Rectangle | Disc, a: FloatArray, b: FloatArray) -> FloatArray:
    return as_float(shape.centre) + a * as_float(shape.x) + b * as_float(shape.y)
