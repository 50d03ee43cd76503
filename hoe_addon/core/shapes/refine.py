# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Curved triangles over flat ones: how far facets depart from them, and a finer mesh on them.

A curved point-normal triangle goes through the corners of the flat one, at a right angle to their
normals: a cubic for the points, a quadratic for the normals. Its edges depend on their two ends
alone, so neighbours always join.

References:
    Vlachos, Peters, Boyd, Mitchell (2001), "Curved PN triangles", Proc. ACM Symposium on
    Interactive 3D Graphics, 159-166, doi:10.1145/364338.364387.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, dot, unit
from .mesh import MeshShape


@dataclass(frozen=True)
class Departure:
    """The largest differences between flat triangles and the smooth surface that they stand for.

    Attributes:
        displacement: Between the surfaces, metres.
        angle: Between interpolated and true normals at the same place, radians.
    """

    displacement: float
    angle: float

    def of_finer(self, parts: int) -> "Departure":
        """Return the departure of facets whose edges are so many times shorter.

        Linear interpolation over a k-th of the length departs by a k^2-th.
        """
        return Departure(self.displacement / parts**2, self.angle / parts**2)

    def on_top_of(self, other: "Departure") -> "Departure":
        """Return the sum of both differences."""
        return Departure(self.displacement + other.displacement, self.angle + other.angle)


@dataclass(frozen=True, eq=False)
class _Patches:
    """Control points of the curved triangles of a mesh; F faces.

    Attributes:
        corner: b300, b030, b003, shape ``(F, 3, 3)``.
        near: For edge e from corner e to e + 1 the points near both ends, shape ``(F, 3, 2, 3)``.
        centre: b111, shape ``(F, 3)``.
        normal: n200, n020, n002, shape ``(F, 3, 3)``.
        bent: n110, n011, n101, shape ``(F, 3, 3)``.
    """

    corner: FloatArray
    near: FloatArray
    centre: FloatArray
    normal: FloatArray
    bent: FloatArray


def facet_departure(mesh: MeshShape) -> Departure:
    """Estimate how far the facets of a mesh depart from its curved triangles.

    Args:
        mesh: The mesh.

    Returns:
        The largest departure on edges and in the middles of triangles; on an edge from the
        largest second derivative of the curve, so that an S-bend counts, too.
    """
    patches = _patches(mesh)
    start, end = patches.corner, np.roll(patches.corner, -1, axis=1)
    first = patches.near[:, :, 0] - (2.0 * start + end) / 3.0
    second = patches.near[:, :, 1] - (start + 2.0 * end) / 3.0
    bends = np.stack((2.0 * first - second, 2.0 * second - first))
    middle = patches.near.sum(axis=(1, 2)) / 6.0 - start.sum(axis=1) / 3.0
    n_start, n_end = patches.normal, np.roll(patches.normal, -1, axis=1)
    curved = unit(0.25 * (n_start + n_end) + 0.5 * patches.bent)
    centre = unit(patches.normal.sum(axis=1) / 9.0 + 2.0 * patches.bent.sum(axis=1) / 9.0)
    return Departure(
        max(0.75 * _longest(bends), _longest(middle)),
        max(
            _longest(curved - unit(n_start + n_end)),
            _longest(centre - unit(patches.normal.sum(axis=1))),
        ),
    )


def patch_departure(mesh: MeshShape) -> Departure:
    """Estimate how far the curved triangles themselves are from the surface meant.

    A curved edge between two points of a circle, half the angle a apart, misses it by 3/8 a^4
    of the radius: three quarters of a^2 times what the chord misses. And where the normal in
    the middle is not at a right angle to the curve, one of the two is wrong.

    Args:
        mesh: The mesh, its corners and normals being exact.

    Returns:
        The estimate, doubled for surfaces that are no circles.
    """
    patches = _patches(mesh)
    start, end = patches.corner, np.roll(patches.corner, -1, axis=1)
    n_start, n_end = patches.normal, np.roll(patches.normal, -1, axis=1)
    chord = np.linalg.norm(3.0 * (patches.near.sum(axis=2) - start - end) / 8.0, axis=-1)
    opening = 2.0 - np.linalg.norm(n_start + n_end, axis=-1)  # a^2
    tangent = unit(end - start + patches.near[:, :, 1] - patches.near[:, :, 0])
    skew = np.abs(dot(tangent, unit(0.25 * (n_start + n_end) + 0.5 * patches.bent)))
    return Departure(float(1.5 * np.max(opening * chord)), float(2.0 * np.max(skew)))


def largest_curvature(mesh: MeshShape) -> float:
    """Return the largest change of the normal along an edge over its length, per metre."""
    start, n_start = mesh.vertices[mesh.faces], mesh.normals[mesh.faces]
    along = np.roll(start, -1, axis=1) - start
    turn = np.roll(n_start, -1, axis=1) - n_start
    return float(np.max(np.linalg.norm(turn, axis=-1) / np.linalg.norm(along, axis=-1)))


def refined(mesh: MeshShape, parts: int) -> MeshShape:
    """Split each edge into equal parts on the curved triangles.

    Args:
        mesh: The mesh.
        parts: Parts k of each edge, at least 1.

    Returns:
        The finer mesh; it keeps all vertices and their normals first, and has k^2 times the faces.
    """
    patches = _patches(mesh)
    steps = _steps(parts)
    shares = steps / parts
    points = _points(patches, shares)
    normals = _normals(patches, shares)
    numbers = _numbers(mesh, steps, parts)
    count = int(numbers.max()) + 1
    vertices, upright = np.empty((count, 3)), np.empty((count, 3))
    # What neighbours share is the same up to rounding; the last one written counts.
    vertices[numbers.ravel()], upright[numbers.ravel()] = (
        points.reshape(-1, 3),
        normals.reshape(-1, 3),
    )
    vertices[: len(mesh.vertices)], upright[: len(mesh.vertices)] = mesh.vertices, mesh.normals
    return MeshShape(vertices, numbers[:, _small_triangles(steps, parts)].reshape(-1, 3), upright)


def _patches(mesh: MeshShape) -> _Patches:
    corner, normal = mesh.vertices[mesh.faces], mesh.normals[mesh.faces]
    end, n_end = np.roll(corner, -1, axis=1), np.roll(normal, -1, axis=1)
    along = end - corner
    rise = dot(along, normal)[..., None] * normal
    fall = dot(-along, n_end)[..., None] * n_end
    near = np.stack(((2.0 * corner + end - rise) / 3.0, (corner + 2.0 * end - fall) / 3.0), axis=2)
    edge_mean = near.sum(axis=(1, 2)) / 6.0
    lean = 2.0 * dot(along, normal + n_end) / dot(along, along)
    return _Patches(
        corner,
        near,
        1.5 * edge_mean - 0.5 * corner.mean(axis=1),
        normal,
        unit(normal + n_end - lean[..., None] * along),
    )


def _points(patches: _Patches, shares: FloatArray) -> FloatArray:
    """Return the points at S shares of the corners, shape ``(F, S, 3)``."""
    after = np.roll(shares, -1, axis=1)
    edges = np.stack((3.0 * shares**2 * after, 3.0 * shares * after**2), axis=2)
    inner = 6.0 * np.prod(shares, axis=1)
    return (
        np.einsum("sc,fcx->fsx", shares**3, patches.corner)
        + np.einsum("sce,fcex->fsx", edges, patches.near)
        + inner[:, None] * patches.centre[:, None, :]
    )


def _normals(patches: _Patches, shares: FloatArray) -> FloatArray:
    """Return the unit normals at S shares of the corners, shape ``(F, S, 3)``."""
    between = 2.0 * shares * np.roll(shares, -1, axis=1)
    total = np.einsum("sc,fcx->fsx", shares**2, patches.normal)
    return unit(total + np.einsum("sc,fcx->fsx", between, patches.bent))


def _steps(parts: int) -> IntArray:
    """Return all triples of whole numbers, 0 or more, whose sum is the number of parts."""
    second, third = np.meshgrid(np.arange(parts + 1), np.arange(parts + 1), indexing="ij")
    inside = second + third <= parts
    second, third = second[inside], third[inside]
    return np.stack((parts - second - third, second, third), axis=1)


def _numbers(mesh: MeshShape, steps: IntArray, parts: int) -> IntArray:
    """Give each point of each face a number; points on a shared edge get one, shape ``(F, S)``."""
    faces, count = mesh.faces, len(mesh.vertices)
    ends = np.stack((faces, np.roll(faces, -1, axis=1)), axis=-1)
    edges, of_face = np.unique(np.sort(ends.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    of_face = of_face.reshape(-1, 3)
    inner = np.flatnonzero(np.all(steps > 0, axis=1))
    numbers = np.empty((len(faces), len(steps)), dtype=np.int64)
    first_inner = count + len(edges) * (parts - 1)
    within = np.arange(len(faces))[:, None] * len(inner) + np.arange(len(inner))
    numbers[:, inner] = first_inner + within
    for side in range(3):
        numbers[:, np.flatnonzero(steps[:, side] == parts)[0]] = faces[:, side]
        after = (side + 1) % 3
        along = (steps[:, (side + 2) % 3] == 0) & np.all(steps < parts, axis=1)
        on_edge: IntArray = np.flatnonzero(along)
        # Counted from the end with the smaller number, whichever way the face runs.
        forward: BoolArray = (faces[:, side] < faces[:, after])[:, None]
        ahead, behind = steps[on_edge, after], steps[on_edge, side]
        first = count - 1 + of_face[:, side, None] * (parts - 1)
        numbers[:, on_edge] = np.where(forward, first + ahead, first + behind)
    return numbers


def _small_triangles(steps: IntArray, parts: int) -> IntArray:
    """Return the corners of the small triangles as rows of `steps`, shape ``(k^2, 3)``."""
    rows: list[tuple[int, int, int]] = steps.tolist()
    row = {(second, third): place for place, (_, second, third) in enumerate(rows)}
    found: list[tuple[int, int, int]] = []
    for second, third in row:
        if second + third < parts:
            found.append((row[second, third], row[second + 1, third], row[second, third + 1]))
        if second + third < parts - 1:
            far = row[second + 1, third + 1]
            found.append((row[second + 1, third], far, row[second, third + 1]))
    return np.array(found, dtype=np.int64)


def _longest(vectors: FloatArray) -> float:
    return float(np.max(np.linalg.norm(vectors, axis=-1)))
