# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hologram on any mesh: a windshield, a visor, an eyeglass lens."""

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import cast

import numpy as np
from msgspec import Struct
from msgspec.structs import force_setattr
from numpy.typing import ArrayLike

from ..core.arrays import BoolArray, FloatArray, IntArray, as_float, dot, unit
from ..core.errors import SpecError
from ..core.shapes import MeshShape
from ..core.shapes.mesh import MeshError, check_triangles, smooth_normals
from ..core.units import m_to_mm, mm_to_m
from . import field_kinds
from .field_error import FieldError
from .mesh_file import FARTHEST_MM, MAX_TRIANGLES, read_mesh

type Triple = tuple[float, float, float]
type Corners = tuple[int, int, int]


class MeshSurface(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="mesh"):
    """Triangles with smooth normals, in the mesh's own frame.

    The front is the side from which the corners of the faces run counter-clockwise. Lengths of a
    file are taken as mm. Where no normals are given they are made from the faces around.

    Attributes:
        file: An .stl or .obj file, or
        vertices_mm: the corners in mm, with
        faces: three corner numbers a face, from 0, and, if known,
        normals: the normal at each corner, of any length but zero.
        refine: Whether facets are refined until directions are right to 1e-4 rad.
    """

    file: str | None = None
    vertices_mm: tuple[Triple, ...] | None = None
    faces: tuple[Corners, ...] | None = None
    normals: tuple[Triple, ...] | None = None
    refine: bool = True

    def __post_init__(self) -> None:
        """Check all fields, and the file."""
        field_kinds.flag(self, "refine")
        if self.file is not None:
            self._check_file()
        else:
            self._check_inline()

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height of the smallest rectangle around the origin that covers it."""
        reach = np.abs(m_to_mm(self.core_shape().vertices)).max(axis=0)
        return (2.0 * float(reach[0]), 2.0 * float(reach[1]))

    def core_shape(self) -> MeshShape:
        """The mesh for the core, in metres, its facets as they are given."""
        if self.file is not None:
            return _from_file(*_stamped(self.file))
        assert self.vertices_mm is not None, "a checked mesh has a file or vertices"
        return _from_lists(self.vertices_mm, self.faces or (), self.normals)

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points, in mm, shape ``(..., 3)``, are finite: a mesh ends where it ends."""
        return np.asarray(np.isfinite(points_mm).all(axis=-1))

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the mesh."""
        return bool(np.isfinite(self.core_shape().normal(mm_to_m(as_float(position_mm)))).all())

    def _check_file(self) -> None:
        path = field_kinds.text(self, "file")
        for other in ("vertices_mm", "faces", "normals"):
            if getattr(self, other) is not None:
                raise FieldError(other, "must not be given beside file", path)
        try:
            self.core_shape()
        except MeshError as error:
            rule = f"{error.place} {error.rule}, not {error.value}"
            raise FieldError("file", rule, path) from error
        except SpecError as error:
            raise FieldError("file", str(error), path) from error

    def _check_inline(self) -> None:
        if self.vertices_mm is None:
            raise FieldError("file", "must be given, or vertices_mm and faces instead", None)
        for field, kind, most in (
            ("vertices_mm", float, 3 * MAX_TRIANGLES),
            ("faces", int, MAX_TRIANGLES),
            ("normals", float, 3 * MAX_TRIANGLES),
        ):
            value = getattr(self, field)
            if value is not None:
                force_setattr(self, field, _rows(field, value, kind, most))
        if self.normals is not None and len(self.normals) != len(self.vertices_mm):
            rule = f"must be as many as the vertices, {len(self.vertices_mm)}"
            raise FieldError("normals", rule, len(self.normals))
        try:
            self.core_shape()
        except MeshError as error:
            field = error.place.replace("vertices", "vertices_mm")
            raise FieldError(field, error.rule, error.value) from error


def _rows(
    field: str, value: object, kind: type, most: int
) -> tuple[tuple[float, ...] | tuple[int, ...], ...]:
    """Check a list of rows of three finite numbers, and make plain tuples of it."""
    rows = list(cast("Sequence[Sequence[object]]", value))
    if len(rows) > most:
        raise FieldError(field, f"must be at most {most}", len(rows))
    try:
        numbers = np.array(rows, dtype=np.float64).reshape(len(rows), -1 if rows else 3)
    except (TypeError, ValueError):
        raise FieldError(field, "must be rows of three numbers", rows[:1]) from None
    if rows and numbers.shape[1] != 3:
        raise FieldError(field, "must be rows of three numbers", rows[0])
    bad = ~(np.abs(numbers) <= FARTHEST_MM).all(axis=1)
    if kind is int:
        bad |= (numbers != np.round(numbers)).any(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        what = "whole numbers" if kind is int else f"numbers up to {FARTHEST_MM:g}"
        raise FieldError(f"{field}[{row}]", f"must be three {what}", rows[row])
    return tuple(tuple(kind(number) for number in row) for row in numbers.tolist())


@lru_cache(maxsize=8)
def _from_lists(
    vertices_mm: tuple[Triple, ...],
    faces: tuple[Corners, ...],
    normals: tuple[Triple, ...] | None,
) -> MeshShape:
    return made_mesh(
        np.array(vertices_mm, dtype=np.float64).reshape(-1, 3),
        np.array(faces, dtype=np.int64).reshape(-1, 3),
        normals,
    )


def _stamped(file: str) -> tuple[str, int, int]:
    """Return a file with its time and size, so that a changed one is read anew."""
    try:
        status = Path(file).stat()
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise SpecError(f"cannot be read: {reason}") from error
    return file, status.st_mtime_ns, status.st_size


@lru_cache(maxsize=8)
def _from_file(file: str, _time: int, _size: int) -> MeshShape:
    return made_mesh(*read_mesh(file))


def made_mesh(vertices_mm: FloatArray, faces: IntArray, normals: ArrayLike | None) -> MeshShape:
    """Make a mesh of the core.

    Args:
        vertices_mm: Corners in mm, shape ``(V, 3)``.
        faces: Corner numbers, shape ``(F, 3)``.
        normals: Normals at the corners, shape ``(V, 3)``, or None.

    Returns:
        The mesh in metres, without corners that no face has.

    Raises:
        MeshError: If the arrays make no mesh, or a normal points to the back of a face.
    """
    check_triangles(vertices_mm, faces)
    given = smooth_normals(vertices_mm, faces) if normals is None else as_float(normals)
    upright = unit(given)
    bad = ~np.isfinite(upright).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        raise MeshError(f"normals[{row}]", "must have a length", given[row].tolist())
    corner = vertices_mm[faces]
    across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    turned = np.min(dot(upright[faces], across[:, None, :]), axis=1) <= 0.0
    if turned.any():
        row = int(np.argmax(turned))
        rule = "must be seen from the side of its corners' normals (no fold sharper than that)"
        raise MeshError(f"faces[{row}]", rule, faces[row].tolist())
    used, numbers = np.unique(faces, return_inverse=True)
    return MeshShape(mm_to_m(vertices_mm[used]), numbers.reshape(-1, 3), upright[used])
