# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading of mesh files that may come from strangers: STL (binary and text) and OBJ.

Only corners, faces and normals are taken; sizes are limited, and nothing in a file is run.
"""

import stat
from itertools import pairwise
from pathlib import Path

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import SpecError

MAX_BYTES = 64 * 2**20
MAX_TRIANGLES = 500_000
FARTHEST_MM = 1e6
"""Largest coordinate of a mesh, and largest size of any surface: a kilometre."""

_MOST_CORNERS = 64
"""Corners of one polygon of an OBJ file."""

type RawMesh = tuple[FloatArray, IntArray, FloatArray | None]
"""Vertices (V, 3), faces (F, 3), and normals (V, 3) where the file has them."""

_STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")])
_STL_HEAD = 84


def read_mesh(path: str | Path) -> RawMesh:
    """Read a mesh file.

    Args:
        path: An ``.stl`` or ``.obj`` file.

    Returns:
        Vertices, faces, and normals or None. Triangles without area are left out, and equal
        corners of an STL file are one vertex.

    Raises:
        SpecError: If the file cannot be read or is no mesh; the message says where.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in (".stl", ".obj"):
        raise SpecError("must be an .stl or .obj file")
    try:
        mode = Path(path).stat().st_mode
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            # Opening a pipe could wait for ever.
            raise SpecError("cannot be read: not a regular file")
        with Path(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise SpecError(f"cannot be read: {reason}") from error
    if len(data) > MAX_BYTES:
        raise SpecError(f"must be at most {MAX_BYTES // 2**20} MB")
    vertices, faces, normals = _stl(data) if suffix == ".stl" else _obj(_text(data))
    if len(faces) > MAX_TRIANGLES:
        raise SpecError(f"must have at most {MAX_TRIANGLES} triangles, not {len(faces)}")
    # A comparison with NaN is false.
    bad = ~(np.abs(vertices) <= FARTHEST_MM).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        rule = f"must hold finite numbers up to {FARTHEST_MM:g} mm"
        raise SpecError(f"{rule}, but vertex {row} is {vertices[row].tolist()}")
    corner = vertices[faces]
    area = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    faces = faces[np.any(area != 0.0, axis=1)]
    if len(faces) == 0:
        raise SpecError("must have faces; it is a mesh without any")
    return vertices, faces, normals


def _text(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SpecError(f"must be text in UTF-8, but byte {error.start} is not") from error


def _stl(data: bytes) -> RawMesh:
    count = int.from_bytes(data[80:_STL_HEAD], "little")
    if len(data) == _STL_HEAD + count * _STL_RECORD.itemsize:
        records = np.frombuffer(data, _STL_RECORD, count, _STL_HEAD)
        corners = records["corners"].astype(np.float64).reshape(-1, 3)
    elif data.lstrip()[:5].lower() == b"solid":
        corners = _stl_text(_text(data))
    elif len(data) < _STL_HEAD:
        raise SpecError("must be a whole STL file, but ends within its header")
    else:
        raise SpecError(f"must be a whole STL file; its header says {count} triangles")
    # -0.0 and 0.0 are one place.
    vertices, numbers = np.unique(corners + 0.0, axis=0, return_inverse=True)
    return vertices, np.asarray(numbers, dtype=np.int64).reshape(-1, 3), None


def _stl_text(text: str) -> FloatArray:
    corners: list[float] = []
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split()
        if words and words[0].lower() == "vertex":
            corners.extend(_numbers(words[1:], 3, number))
        elif words and words[0].lower() == "endfacet" and len(corners) % 9:
            raise SpecError(f"must have three corners a facet, but not before line {number}")
    if len(corners) % 9:
        raise SpecError("must have three corners a facet, but ends within one")
    return np.array(corners, dtype=np.float64).reshape(-1, 3)


def _numbers(words: list[str], least: int, line: int) -> list[float]:
    try:
        values = [float(word) for word in words[:least]]
    except ValueError:
        values = []
    if len(values) < least:
        raise SpecError(f"must have {least} numbers in line {line}, not {' '.join(words)[:60]!r}")
    return values


class _Obj:
    """What has been read of an OBJ file so far."""

    def __init__(self) -> None:
        self.vertices: list[list[float]] = []
        self.normals: list[list[float]] = []
        self.faces: list[tuple[int, int, int]] = []
        self.pairs: set[tuple[int, int]] = set()

    def add_face(self, words: list[str], line: int) -> None:
        """Take a polygon as a fan of triangles."""
        if not 3 <= len(words) <= _MOST_CORNERS:
            rule = f"must have faces of 3 to {_MOST_CORNERS} corners"
            raise SpecError(f"{rule}, but line {line} has {len(words)}")
        corners: list[int] = []
        for word in words:
            parts = word.split("/")
            corners.append(_index(parts[0], len(self.vertices), "vertex", line))
            if len(parts) == 3 and parts[2]:
                self.pairs.add((corners[-1], _index(parts[2], len(self.normals), "normal", line)))
        for second, third in pairwise(corners[1:]):
            self.faces.append((corners[0], second, third))
        if len(self.faces) > MAX_TRIANGLES:
            raise SpecError(f"must have at most {MAX_TRIANGLES} triangles")

    def corner_normals(self) -> FloatArray | None:
        """The mean normal of each vertex, or None where one has none."""
        total = np.zeros((len(self.vertices), 3))
        listed = np.array(self.normals, dtype=np.float64).reshape(-1, 3)
        lengths = np.linalg.norm(listed, axis=1)
        if not np.isfinite(lengths).all() or np.any(lengths == 0.0):
            raise SpecError("must have normals with a length")
        for vertex, normal in self.pairs:
            total[vertex] += listed[normal] / lengths[normal]
        used = np.unique(np.array(self.faces, dtype=np.int64).reshape(-1))
        known = np.zeros(len(total), dtype=np.bool_)
        known[[vertex for vertex, _ in self.pairs]] = True
        if not known[used].all():
            return None
        return np.where(known[:, None], total, (0.0, 0.0, 1.0))


def _obj(text: str) -> RawMesh:
    found = _Obj()
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        if words[0] == "v":
            found.vertices.append(_numbers(words[1:], 3, number))
        elif words[0] == "vn":
            found.normals.append(_numbers(words[1:], 3, number))
        elif words[0] == "f":
            found.add_face(words[1:], number)
    return (
        np.array(found.vertices, dtype=np.float64).reshape(-1, 3),
        np.array(found.faces, dtype=np.int64).reshape(-1, 3),
        found.corner_normals(),
    )


def _index(word: str, count: int, what: str, line: int) -> int:
    """Turn a number of an OBJ file, from 1 or back from the end, into one from 0."""
    try:
        number = int(word)
    except ValueError:
        number = 0
    index = number - 1 if number > 0 else count + number
    if number == 0 or not 0 <= index < count:
        rule = f"must name one of the {count} {what} lines above"
        raise SpecError(f"{rule} in line {line}, not {word[:20]!r}")
    return index
