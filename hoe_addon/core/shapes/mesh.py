# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A triangle mesh with smooth normals."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import BoolArray, FloatArray, IntArray, as_float, dot, unit
from ..errors import SpecError
from .box_tree import BoxTree

_BLOCK = 1 << 14
"""Rays that walk the tree together; bounds the memory."""

_EDGE = 1e-12
"""A share this little below 0 still hits: no ray slips between two triangles by rounding."""

_BOX_SLACK = 1e-9
"""Boxes grow by this share of the mesh, so that rounding never leaves a flat one."""


class MeshError(SpecError):
    """Arrays make no mesh.

    Attributes:
        place: Array, and row of it.
        rule: What it breaks.
        value: What stands there.
    """

    def __init__(self, place: str, rule: str, value: object) -> None:
        """Make the message ``place: rule, got value``."""
        self.place, self.rule, self.value = place, rule, value
        super().__init__(f"{place}: {rule}, got {value}")


@dataclass(frozen=True, eq=False)
class MeshHit:
    """Where rays meet a mesh.

    Attributes:
        distance: Along each ray, shape ``(...)``, NaN for a miss.
        triangle: Number of the triangle, shape ``(...)``, -1 for a miss.
        shares: Share of each of its corners in the hit point, shape ``(..., 3)``.
    """

    distance: FloatArray
    triangle: IntArray
    shares: FloatArray


@dataclass(frozen=True, eq=False)
class MeshShape:
    """Triangles whose normals are interpolated between their corners; a `Shape`.

    The front is the side that the normals point to, wherever +z is.

    Attributes:
        vertices: Corners, metres, shape ``(V, 3)``.
        faces: Corner numbers, counter-clockwise seen from the front, shape ``(F, 3)``.
        normals: Unit normals at the corners, shape ``(V, 3)``.
    """

    vertices: FloatArray
    faces: IntArray
    normals: FloatArray

    def __post_init__(self) -> None:
        """Check the fields."""
        vertices, normals = as_float(self.vertices), unit(self.normals)
        faces = np.asarray(self.faces, dtype=np.int64)
        check_triangles(vertices, faces)
        if normals.shape != vertices.shape or not np.isfinite(normals).all():
            rule = "must be one vector of a length above 0 for each vertex"
            raise MeshError("normals", rule, np.asarray(self.normals).tolist())
        for name, value in (("vertices", vertices), ("faces", faces), ("normals", normals)):
            object.__setattr__(self, name, value)

    def intersect(self, origin: ArrayLike, direction: ArrayLike) -> FloatArray:
        """Return the distance to the first triangle, from either side; see `Shape`."""
        return self.hit(origin, direction).distance

    def normal(self, points: ArrayLike) -> FloatArray:
        """Return the interpolated unit normal of the nearest triangle; see `Shape`.

        A point further from the mesh than rounding, 1e-9 of its size, gets NaN.
        """
        places = as_float(points)
        flat = places.reshape(-1, 3)
        triangle, shares = self._locate(flat)
        return self._smooth(triangle, shares).reshape(places.shape)

    def sag(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the height of the highest crossing of a vertical line; see `Shape`."""
        along_x, along_y = np.broadcast_arrays(as_float(x), as_float(y))
        top = self.vertices[:, 2].max() + self._extent
        start = np.stack((along_x, along_y, np.full(along_x.shape, top)), axis=-1)
        return top - self.intersect(start, np.broadcast_to((0.0, 0.0, -1.0), start.shape))

    def hit(self, origin: ArrayLike, direction: ArrayLike) -> MeshHit:
        """Find the first triangle of each ray.

        Args:
            origin: Start points, shape ``(..., 3)``.
            direction: Unit directions, broadcastable to ``(..., 3)``.

        Returns:
            The hits; a distance of 0 or more counts.
        """
        start, heading = np.broadcast_arrays(as_float(origin), as_float(direction))
        shape = start.shape[:-1]
        start, heading = start.reshape(-1, 3), heading.reshape(-1, 3)
        distance = np.full(len(start), np.nan)
        triangle = np.full(len(start), -1, dtype=np.int64)
        shares = np.full((len(start), 3), np.nan)
        for first in range(0, len(start), _BLOCK):
            part = slice(first, first + _BLOCK)
            self._hit_block(
                start[part], heading[part], distance[part], triangle[part], shares[part]
            )
        return MeshHit(
            distance.reshape(shape), triangle.reshape(shape), shares.reshape((*shape, 3))
        )

    def _smooth(self, triangle: IntArray, shares: FloatArray) -> FloatArray:
        corners = self.normals[self.faces[triangle]]
        found = unit(np.sum(shares[..., None] * corners, axis=-2))
        return np.where((triangle >= 0)[..., None], found, np.nan)

    @cached_property
    def _extent(self) -> float:
        return float(np.max(np.ptp(self.vertices, axis=0)))

    @cached_property
    def _tree(self) -> BoxTree:
        corners = self.vertices[self.faces]
        slack = _BOX_SLACK * self._extent
        return BoxTree(corners.min(axis=1) - slack, corners.max(axis=1) + slack)

    def _hit_block(
        self,
        origin: FloatArray,
        heading: FloatArray,
        distance: FloatArray,
        triangle: IntArray,
        shares: FloatArray,
    ) -> None:
        """Fill in the hits of a block of rays."""
        # From the point nearest to the middle, a ray from afar keeps its digits.
        middle = 0.5 * (self.vertices.min(axis=0) + self.vertices.max(axis=0))
        ahead = dot(middle - origin, heading)
        start = origin + ahead[:, None] * heading
        with np.errstate(divide="ignore"):
            inverse = 1.0 / heading

        def touches(rays: IntArray, low: FloatArray, high: FloatArray) -> BoolArray:
            with np.errstate(invalid="ignore"):
                to_low, to_high = ((end - start[rays]) * inverse[rays] for end in (low, high))
            near = np.nan_to_num(np.minimum(to_low, to_high), nan=-np.inf, posinf=np.inf)
            far = np.nan_to_num(np.maximum(to_low, to_high), nan=np.inf, neginf=-np.inf)
            leave = far.min(axis=1)
            return (near.max(axis=1) <= leave) & (leave + ahead[rays] >= -_EDGE * self._extent)

        rays, items = self._tree.pairs(len(start), touches)
        along, weights = self._cross(start[rays], heading[rays], items)
        total = along + ahead[rays]
        met = (weights.min(axis=1) >= -_EDGE) & (total >= 0.0)
        rays, items, total, weights = rays[met], items[met], total[met], weights[met]
        nearest = np.lexsort((total, rays))
        rays, first = np.unique(rays[nearest], return_index=True)
        chosen = nearest[first]
        distance[rays], triangle[rays], shares[rays] = total[chosen], items[chosen], weights[chosen]

    def _cross(
        self, start: FloatArray, heading: FloatArray, items: IntArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return where rays cross the planes of triangles, and the shares of the corners there.

        References:
            Moeller, Trumbore (1997), "Fast, minimum storage ray/triangle intersection",
            J. Graphics Tools 2(1), 21-28.
        """
        corner = self.vertices[self.faces[items]]
        first, second = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
        offset = start - corner[:, 0]
        across = np.cross(heading, second)
        around = np.cross(offset, first)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1.0 / dot(first, across)
            u, v = dot(offset, across) * scale, dot(heading, around) * scale
            weights = np.stack((1.0 - u - v, u, v), axis=1)
            return dot(second, around) * scale, np.nan_to_num(weights, nan=-1.0)

    def _locate(self, points: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the triangle that each point lies on, -1 for none, and the corners' shares."""
        slack = _BOX_SLACK * self._extent

        def touches(queries: IntArray, low: FloatArray, high: FloatArray) -> BoolArray:
            place = points[queries]
            return np.all((place >= low - slack) & (place <= high + slack), axis=1)

        queries, items = self._tree.pairs(len(points), touches)
        corner = self.vertices[self.faces[items]]
        across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        upright = unit(across)
        height = dot(points[queries] - corner[:, 0], upright)
        _, weights = self._cross(points[queries], upright, items)
        # How far outside a triangle a point is counts like its height over it.
        outside = np.maximum(-weights.min(axis=1), 0.0) * np.sqrt(np.abs(dot(across, upright)))
        apart = np.maximum(np.abs(height), outside)
        near = apart <= slack
        queries, items, weights, apart = queries[near], items[near], weights[near], apart[near]
        order = np.lexsort((apart, queries))
        queries, first = np.unique(queries[order], return_index=True)
        triangle = np.full(len(points), -1, dtype=np.int64)
        shares = np.full((len(points), 3), np.nan)
        triangle[queries], shares[queries] = items[order[first]], weights[order[first]]
        return triangle, shares


def check_triangles(vertices: FloatArray, faces: IntArray) -> None:
    """Raise MeshError unless the arrays make a mesh.

    Args:
        vertices: Corners, shape ``(V, 3)``.
        faces: Corner numbers, shape ``(F, 3)``.

    Raises:
        MeshError: On another shape, no vertices or faces, a number that is not finite, a corner
            that does not exist, or a triangle without area.
    """
    for name, array in (("vertices", vertices), ("faces", faces)):
        if array.size == 0:
            raise MeshError(name, "must not be empty", [])
    if vertices.ndim != 2 or vertices.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
        shapes = f"arrays of {list(vertices.shape)} and {list(faces.shape)}"
        raise MeshError("vertices, faces", "must be rows of three numbers", shapes)
    bad = ~np.isfinite(vertices).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        raise MeshError(f"vertices[{row}]", "must be finite", vertices[row].tolist())
    bad = ((faces < 0) | (faces >= len(vertices))).any(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        rule = f"must be from 0 to {len(vertices) - 1}"
        raise MeshError(f"faces[{row}]", rule, faces[row].tolist())
    corner = vertices[faces]
    area = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    bad = ~np.any(area != 0.0, axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        raise MeshError(f"faces[{row}]", "must have an area", faces[row].tolist())


def smooth_normals(vertices: FloatArray, faces: IntArray) -> FloatArray:
    """Return vertex normals: the mean of the faces around, each by its angle there.

    Args:
        vertices: Corners, shape ``(V, 3)``.
        faces: Corner numbers, shape ``(F, 3)``.

    Returns:
        Unit vectors, shape ``(V, 3)``; +z for a vertex that no face has.

    References:
        Thuermer, Wuethrich (1998), "Computing vertex normals from polygonal facets",
        J. Graphics Tools 3(1), 43-46.
    """
    corner = vertices[faces]
    face_normal = unit(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]))
    total = np.zeros_like(vertices)
    for place in range(3):
        here = corner[:, place]
        first = unit(corner[:, (place + 1) % 3] - here)
        second = unit(corner[:, (place + 2) % 3] - here)
        angle = np.arctan2(np.linalg.norm(np.cross(first, second), axis=1), dot(first, second))
        np.add.at(total, faces[:, place], angle[:, None] * face_normal)
    found = unit(total)
    return np.where(np.isfinite(found), found, (0.0, 0.0, 1.0))
