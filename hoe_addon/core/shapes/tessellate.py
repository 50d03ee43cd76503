# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles on a shape that is given by a formula."""

import numpy as np

from ..arrays import FloatArray, IntArray
from .mesh import MeshShape
from .shape import Shape

_RIM_SIDES = 256
"""Least number of corners of a round rim: its chords miss the rim by 7.5e-5 of the radius."""


def rectangle_mesh(shape: Shape, width: float, height: float, columns: int, rows: int) -> MeshShape:
    """Lay a grid over a rectangle around the vertex.

    Args:
        shape: The shape, defined on the whole rectangle.
        width: Extent along x, metres.
        height: Extent along y, metres.
        columns: Cells along x, at least 1.
        rows: Cells along y, at least 1.

    Returns:
        Two triangles a cell, corners and normals exact, the front on the side of +z.
    """
    x = np.linspace(-0.5 * width, 0.5 * width, columns + 1)
    y = np.linspace(-0.5 * height, 0.5 * height, rows + 1)
    along_x, along_y = np.meshgrid(x, y)
    return _on_shape(shape, along_x.ravel(), along_y.ravel(), _cells(columns, rows))


def ellipse_mesh(shape: Shape, width: float, height: float, rings: int) -> MeshShape:
    """Lay rings over an ellipse around the vertex.

    Args:
        shape: The shape, defined on the whole ellipse.
        width: Diameter along x, metres.
        height: Diameter along y, metres.
        rings: Steps from the vertex to the rim, at least 1.

    Returns:
        Corners and normals exact, the outermost corners on the rim, the front on +z.
    """
    sides = max(_RIM_SIDES, 6 * rings)
    angle = np.arange(sides) * (2.0 * np.pi / sides)
    radius = np.arange(1, rings + 1)[:, None] / rings
    x = np.concatenate(([0.0], (0.5 * width * radius * np.cos(angle)).ravel()))
    y = np.concatenate(([0.0], (0.5 * height * radius * np.sin(angle)).ravel()))
    inner = np.arange(sides)
    after = (inner + 1) % sides
    faces = [np.stack((0 * inner, 1 + inner, 1 + after), axis=1)]
    for ring in range(1, rings):
        here, there = 1 + (ring - 1) * sides, 1 + ring * sides
        faces.append(np.stack((here + inner, there + inner, there + after), axis=1))
        faces.append(np.stack((here + inner, there + after, here + after), axis=1))
    return _on_shape(shape, x, y, np.concatenate(faces))


def _cells(columns: int, rows: int) -> IntArray:
    number = np.arange((columns + 1) * (rows + 1)).reshape(rows + 1, columns + 1)
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    c, d = number[1:, 1:].ravel(), number[1:, :-1].ravel()
    return np.concatenate((np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)))


def _on_shape(shape: Shape, x: FloatArray, y: FloatArray, faces: IntArray) -> MeshShape:
    corners = np.stack((x, y, shape.sag(x, y)), axis=1)
    return MeshShape(corners, faces, shape.normal(corners))


def departure_from(shape: Shape, mesh: MeshShape) -> float:
    """Measure how far the facets of a mesh are from a shape that its corners lie on.

    Args:
        shape: The shape.
        mesh: A mesh of it.

    Returns:
        The largest distance over the middles of all edges and triangles, metres.
    """
    corner = mesh.vertices[mesh.faces]
    weights = np.array([[1, 1, 1], [3, 3, 0], [0, 3, 3], [3, 0, 3]]) / [[3], [6], [6], [6]]
    places = np.einsum("kc,fcx->fkx", weights, corner)
    surface = places.copy()
    surface[..., 2] = shape.sag(places[..., 0], places[..., 1])
    # The height times the cosine of the slope is the distance, up to the square of it.
    height = np.abs(surface[..., 2] - places[..., 2]) * shape.normal(surface)[..., 2]
    return float(np.max(height))
