# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of extended sources as documents write them, told apart by ``shape``; lengths in mm.

A shape lies in the source's own frame: its middle at the origin, flat shapes in the plane z = 0.
"""

from typing import Any, cast

import numpy as np
from msgspec import Struct
from msgspec.structs import force_setattr

from ..core.arrays import FloatArray, as_float
from . import fields
from .field_error import FieldError

MAX_TRIANGLES = 8192
"""A mesh source is a table in the shader's text, of 140 bytes a triangle."""

MAX_VERTICES = 100_000
"""Vertices that a document may list."""

_LOOKED_AT = 256
"""Triangles of which the edges are compared with the hologram."""

type Point = tuple[float, float, float]


class DiscShape(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="disc"):
    """A disc.

    Attributes:
        diameter_mm: Its diameter.
    """

    diameter_mm: float

    def __post_init__(self) -> None:
        """Check the diameter."""
        fields.number(self, "diameter_mm", above=0.0)

    def edges_mm(self) -> FloatArray:
        """Return sixteen chords of its rim and its spokes, start and end, shape ``(n, 2, 3)``."""
        angles = np.arange(16) * np.pi / 8.0
        rim = as_float([(np.cos(angle), np.sin(angle), 0.0) for angle in angles])
        return _rim_and_spokes(rim * self.diameter_mm / 2.0)


class RectangleShape(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="rectangle"
):
    """A rectangle.

    Attributes:
        size_mm: Width along x and height along y.
    """

    size_mm: tuple[float, float]

    def __post_init__(self) -> None:
        """Check the size."""
        fields.vector(self, "size_mm", 2, above=0.0)

    def edges_mm(self) -> FloatArray:
        """Return its rim in eight pieces and the spokes to them, shape ``(n, 2, 3)``."""
        places = ((-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0))
        rim = [(a * self.size_mm[0] / 2.0, b * self.size_mm[1] / 2.0, 0.0) for a, b in places]
        return _rim_and_spokes(as_float(rim))


class LineShape(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="line"):
    """A straight line along x.

    Attributes:
        length_mm: Its length.
    """

    length_mm: float

    def __post_init__(self) -> None:
        """Check the length."""
        fields.number(self, "length_mm", above=0.0)

    def edges_mm(self) -> FloatArray:
        """Return its halves, from the middle to an end, shape ``(2, 2, 3)``."""
        half = self.length_mm / 2.0
        return as_float([[(0.0, 0.0, 0.0), (end, 0.0, 0.0)] for end in (-half, half)])


class MeshShape(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="mesh"):
    """The surface of a mesh; points are drawn evenly by area, on whichever side.

    Attributes:
        vertices_mm: Its vertices.
        faces: Vertex numbers of each face, from 0, in order around it. Faces with more than three
            are cut into triangles, so they must be convex.
    """

    vertices_mm: tuple[tuple[float, float, float], ...]
    faces: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        """Check vertices and faces, and that there is an area."""
        force_setattr(self, "vertices_mm", _vertices(self.vertices_mm))
        if len(self.faces) == 0:
            raise FieldError("faces", "must hold at least one face", [])
        if len(self.faces) > MAX_TRIANGLES:
            raise FieldError("faces", f"must be at most {MAX_TRIANGLES} faces", len(self.faces))
        count = len(self.vertices_mm)
        faces = tuple(_face(place, face, count) for place, face in enumerate(self.faces))
        force_setattr(self, "faces", faces)
        count = sum(len(face) - 2 for face in faces)
        if count > MAX_TRIANGLES:
            raise FieldError("faces", f"must make at most {MAX_TRIANGLES} triangles", count)
        self._check_areas()

    def triangles_mm(self) -> FloatArray:
        """Cut all faces into triangles.

        Returns:
            Corners in mm, shape ``(n, 3, 3)``: triangle, corner, component.
        """
        corners = [
            (face[0], face[place], face[place + 1])
            for face in self.faces
            for place in range(1, len(face) - 1)
        ]
        return as_float(self.vertices_mm)[np.asarray(corners)]

    def edges_mm(self) -> FloatArray:
        """Return edges and spokes of its triangles, of a large mesh some, shape ``(n, 2, 3)``."""
        corners = self.triangles_mm()
        corners = corners[:: -(-len(corners) // _LOOKED_AT)]
        rims = np.stack((corners, np.roll(corners, -1, axis=1)), axis=2)
        middles = np.broadcast_to(corners.mean(axis=1)[:, None], corners.shape)
        spokes = np.stack((middles, corners), axis=2)
        return np.concatenate((rims, spokes)).reshape(-1, 2, 3)

    def _check_areas(self) -> None:
        corners = self.triangles_mm()
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        first = 0
        for place, face in enumerate(self.faces):
            mine = normals[first : first + len(face) - 2]
            first += len(mine)
            if np.any(mine @ np.sum(mine, axis=0) < 0.0):
                raise FieldError(f"faces[{place}]", "must be convex; cut it into triangles", face)
        if not float(np.sum(np.linalg.norm(normals, axis=1))) > 0.0:
            raise FieldError("faces", "must have an area above 0", self.faces)


type SourceShapeSpec = DiscShape | RectangleShape | LineShape | MeshShape

SOURCE_SHAPES = (DiscShape, RectangleShape, LineShape, MeshShape)
"""Every shape of an extended source."""


class _Row(Struct):
    """One row of a list, so that the rules for fields serve it too."""

    row: Any


def _vertices(values: Any) -> tuple[Point, ...]:
    """Check that vertices are triples of finite numbers."""
    if len(values) > MAX_VERTICES:
        raise FieldError("vertices_mm", f"must be at most {MAX_VERTICES} vertices", len(values))
    checked: list[Point] = []
    for place, vertex in enumerate(values):
        try:
            checked.append(cast("Point", fields.vector(_Row(vertex), "row", 3)))
        except FieldError as error:
            raise _in_list(error, "vertices_mm", place) from error
    return tuple(checked)


def _face(place: int, face: Any, count: int) -> tuple[int, ...]:
    """Check one face of a mesh with ``count`` vertices."""
    try:
        corners = fields.integers(_Row(face), "row", 0, count - 1)
    except FieldError as error:
        raise _in_list(error, "faces", place) from error
    if len(corners) < 3:
        raise FieldError(f"faces[{place}]", "must have at least three vertices", corners)
    if len(set(corners)) != len(corners):
        raise FieldError(f"faces[{place}]", "must name each vertex once", corners)
    return corners


def _in_list(error: FieldError, field: str, place: int) -> FieldError:
    return error.moved(f"{field}[{place}]{error.field.removeprefix('row')}")


def _rim_and_spokes(rim: FloatArray) -> FloatArray:
    """Return the edges of a closed line, and from the origin to each of its points."""
    edges = np.stack((rim, np.roll(rim, -1, axis=0)), axis=1)
    spokes = np.stack((np.zeros_like(rim), rim), axis=1)
    return np.concatenate((edges, spokes))
