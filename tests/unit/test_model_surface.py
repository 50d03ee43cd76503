# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces in documents: what is valid, what is refused and how, and mesh files of strangers."""

import json
import struct
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.shapes import Conic, MeshShape
from hoe_addon.core.shapes.tessellate import rectangle_mesh
from hoe_addon.model.document import dump, hologram_from, to_document
from hoe_addon.model.element import DIRECTION_ERROR, MAX_TRIANGLES, element_mesh, element_shape
from hoe_addon.model.evaluate import centre_mm, efficiencies, incident_direction
from hoe_addon.model.schema import hologram_schema

SQUARE = {
    "shape": "mesh",
    "vertices_mm": [[-10, -10, 0], [10, -10, 0], [10, 10, 0], [-10, 10, 0]],
    "faces": [[0, 1, 2], [0, 2, 3]],
}
SURFACES: dict[str, dict[str, Any]] = {
    "plane": {"shape": "plane", "size_mm": [40, 30], "outline": "ellipse"},
    "sphere": {"shape": "sphere", "size_mm": [40, 30], "radius_mm": -60},
    "conic": {"shape": "conic", "size_mm": [40, 30], "radius_mm": 60, "conic": -1.2},
    "cylinder": {"shape": "cylinder", "size_mm": [40, 30], "radius_mm": 25, "axis": "x"},
    "asphere": {"shape": "asphere", "size_mm": [40, 30], "radius_mm": 60, "coefficients": [1e-6]},
    "mesh": SQUARE,
}


def document(surface: dict[str, Any], position_mm: Any = (10, 5, -100)) -> dict[str, Any]:
    return {
        "schema": 1,
        "name": "element",
        "surface": surface,
        "media": {"back": 1.0, "front": 1.5},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "point", "position_mm": list(position_mm)},
            "reference": {"kind": "plane", "direction": [0, 0, 1]},
        },
        "efficiency": {"model": "constant", "table": {"T": {"0": 0.5, "1": 0.5}}},
        "orders": [0, 1],
    }


def sphere_mesh(cells: int, radius_mm: float = 50.0) -> dict[str, Any]:
    """A sphere as a mesh in mm, with its exact normals."""
    mesh = rectangle_mesh(Conic(radius_mm), 40.0, 40.0, cells, cells)
    return {
        "shape": "mesh",
        "vertices_mm": mesh.vertices.tolist(),
        "faces": mesh.faces.tolist(),
        "normals": mesh.normals.tolist(),
    }


@pytest.mark.parametrize("name", SURFACES)
def test_written_and_read_again_it_is_the_same(name: str) -> None:
    spec = hologram_from(document(SURFACES[name]))
    assert hologram_from(json.loads(dump(spec))) == spec
    jsonschema.validate(to_document(spec), hologram_schema())


@pytest.mark.parametrize(
    ("surface", "message"),
    [
        (SURFACES["sphere"] | {"radius_mm": 0}, "surface.radius_mm: must not be 0, got 0"),
        (SURFACES["sphere"] | {"radius_mm": 24}, "surface.size_mm: must reach at most 23.76 mm"),
        (
            SURFACES["sphere"] | {"radius_mm": 20, "outline": "ellipse"},
            "surface.size_mm: must reach at most 19.8 mm from the axis, where it is steep, "
            "got [40, 30]",
        ),
        (SURFACES["conic"] | {"conic": 8}, "surface.size_mm: must reach at most 19.8 mm"),
        (SURFACES["cylinder"] | {"radius_mm": 15}, "surface.size_mm: must reach at most 14.85"),
        (SURFACES["cylinder"] | {"axis": "z"}, "surface.axis: must be one of x, y"),
        (
            SURFACES["plane"] | {"outline": "star"},
            "surface.outline: must be one of ellipse, rectangle",
        ),
        (SURFACES["plane"] | {"size_mm": [0, 1]}, "surface.size_mm[0]: must be above 0, got 0"),
        (SURFACES["plane"] | {"size_mm": [1, 1e7]}, "surface.size_mm[1]: must be at most 1e+06"),
        (SURFACES["asphere"] | {"coefficients": [0, 1]}, "surface.coefficients[1]: must change"),
        (SURFACES["asphere"] | {"coefficients": [0] * 13}, "surface.coefficients: must be at most"),
        (SQUARE | {"faces": []}, "surface.faces: must not be empty, got []"),
        (SQUARE | {"vertices_mm": []}, "surface.vertices_mm: must not be empty, got []"),
        (SQUARE | {"faces": [[0, 1, 4]]}, "surface.faces[0]: must be from 0 to 3, got [0, 1, 4]"),
        (SQUARE | {"faces": [[0, 1, 1]]}, "surface.faces[0]: must have an area, got [0, 1, 1]"),
        (SQUARE | {"normals": [[0, 0, 1]] * 3}, "surface.normals: must be as many as the vert"),
        (
            SQUARE | {"normals": [[0, 0, 0]] * 4},
            "surface.normals[0]: must have a length, got [0, 0, 0]",
        ),
        (SQUARE | {"normals": [[0, 0, -1]] * 4}, "surface.faces[0]: must be seen from the side"),
        (SQUARE | {"file": "x.stl"}, "surface.vertices_mm: must not be given beside file"),
        ({"shape": "mesh"}, "surface.file: must be given, or vertices_mm and faces instead"),
        ({"shape": "mesh", "file": "/no/such.stl"}, "surface.file: cannot be read: No such file"),
        ({"shape": "mesh", "file": "/etc/hosts"}, "surface.file: must be an .stl or .obj file"),
        ({"shape": "mesh", "file": "a\x00b.stl"}, "surface.file: cannot be read"),
    ],
)
def test_what_is_wrong_is_named(surface: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError) as caught:
        hologram_from(document(surface))
    text = str(caught.value)
    assert text.startswith(message)
    assert "\n" not in text


@pytest.mark.parametrize(
    "surface",
    [
        SURFACES["sphere"] | {"radius_mm": 0},
        SURFACES["plane"] | {"outline": "star"},
        SURFACES["cylinder"] | {"axis": "z"},
        SURFACES["asphere"] | {"coefficients": [0] * 13},
        {"shape": "mesh", "files": "x"},
    ],
)
def test_the_schema_refuses_it_too(surface: dict[str, Any]) -> None:
    check = jsonschema.Draft202012Validator(hologram_schema())
    assert not check.is_valid(document(surface))


@pytest.mark.parametrize("name", ["sphere", "conic", "cylinder", "asphere", "mesh"])
def test_a_source_on_the_surface_is_refused(name: str) -> None:
    surface = SURFACES[name]
    shape = hologram_from(document(surface)).surface.core_shape()
    x, y = 3.0, -4.0
    z = float(shape.sag(x / 1e3, y / 1e3)) * 1e3
    with pytest.raises(SpecError, match=r"recording.object.position_mm: must not lie on"):
        hologram_from(document(surface, (x, y, z)))
    hologram_from(document(surface, (x, y, z + 1e-6)))
    hologram_from(document(surface, (x + 100.0, y, z)))


def test_a_round_plane_leaves_its_corners_free() -> None:
    hologram_from(document(SURFACES["plane"], (19.0, 14.0, 0.0)))
    with pytest.raises(SpecError, match="must not lie on the surface"):
        hologram_from(document(SURFACES["plane"], (13.0, 9.0, 0.0)))


def test_efficiencies_are_those_of_the_middle_of_a_mesh() -> None:
    """A frame around a hole has no middle at x = y = 0."""
    aside = SQUARE | {"vertices_mm": [[x + 30, y, 2] for x, y, _ in SQUARE["vertices_mm"]]}
    spec = hologram_from(document(aside))
    np.testing.assert_allclose(centre_mm(spec)[0], 20.0)
    np.testing.assert_allclose(centre_mm(hologram_from(document(SQUARE))), 0.0, atol=1e-12)
    shares = efficiencies(spec, incident_direction(0.0, 0.0, from_front=False), 532.0, [0])
    np.testing.assert_allclose(shares, [[0.5, 0.0]])


def stl(corners: Any, count: int | None = None) -> bytes:
    records = b"".join(
        struct.pack("<12fH", 0, 0, 0, *np.asarray(face, np.float32).ravel(), 0) for face in corners
    )
    return b"\x00" * 80 + struct.pack("<I", len(corners) if count is None else count) + records


def stl_text(corners: Any) -> bytes:
    lines = ["solid shield"]
    for face in corners:
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += [f"  vertex {x:g} {y:g} {z:g}" for x, y, z in face]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid shield"]).encode()


FOUR = np.array(SQUARE["vertices_mm"], float)
CORNERS = FOUR[np.array(SQUARE["faces"])]
OBJ = "# square\nv -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\n"
WITH_NORMALS = OBJ + "vn 0 0 2\nvn 0.1 0 1\nf 1//1 2//2 3//1 4//-2\n"
FILES = {
    "binary.stl": stl(CORNERS),
    "text.stl": stl_text(CORNERS),
    "quad.obj": (OBJ + "f 1 2 3 4\n").encode(),
    "back.obj": (OBJ + "f -4/1/ -3 -2\nf -4 -2 -1\n").encode(),
    "normals.obj": WITH_NORMALS.encode(),
    "slivers.stl": stl([*CORNERS, [FOUR[0], FOUR[0], FOUR[1]]]),
}


def from_file(path: Path, data: bytes) -> Any:
    path.write_bytes(data)
    return hologram_from(document({"shape": "mesh", "file": str(path), "refine": False}))


@pytest.mark.parametrize("name", FILES)
def test_mesh_files_are_read(name: str, tmp_path: Path) -> None:
    shape = element_shape(from_file(tmp_path / name, FILES[name]))
    assert isinstance(shape, MeshShape)
    assert len(shape.vertices) == 4
    assert len(shape.faces) == 2
    np.testing.assert_allclose(sorted(shape.vertices.tolist()), sorted((FOUR / 1e3).tolist()))
    turned = 0.0995 if name == "normals.obj" else 0.0
    assert shape.normals[:, 0].max() == pytest.approx(turned, abs=1e-4)
    assert shape.normals[:, 2].min() > 0.99


def test_a_file_that_changes_is_read_anew(tmp_path: Path) -> None:
    path = tmp_path / "shield.stl"
    first = element_shape(from_file(path, stl(CORNERS)))
    second = element_shape(from_file(path, stl([*CORNERS, CORNERS[0] + (0, 0, 5)])))
    assert isinstance(first, MeshShape)
    assert isinstance(second, MeshShape)
    assert (len(first.faces), len(second.faces)) == (2, 3)


BROKEN = {
    "empty.stl": (b"", "must be a whole STL file, but ends within its header"),
    "cut.stl": (stl(CORNERS)[:-1], "must be a whole STL file; its header says 2 triangles"),
    "lies.stl": (stl(CORNERS, 4_000_000_000), "must be a whole STL file"),
    "none.stl": (stl([]), "must have faces"),
    "nan.stl": (stl(CORNERS * np.nan), "must hold finite numbers up to 1e+06 mm, but vertex 0 is"),
    "slivers.stl": (stl([[FOUR[0]] * 3]), "must have faces"),
    "cut_text.stl": (
        b"solid\nvertex 1 2 3\nvertex 2 3 4\nendfacet\n",
        "must have three corners a facet",
    ),
    "word.stl": (b"solid x\nvertex 1 two 3\n", "must have 3 numbers in line 2, not '1 two 3'"),
    "latin.stl": (b"solid \xff\xfe\n", "must be text in UTF-8, but byte 6 is not"),
    "no_faces.obj": (OBJ.encode(), "must have faces"),
    "far.obj": ((OBJ + "f 1 2 9").encode(), "must name one of the 4 vertex lines above in line 6"),
    "zero.obj": ((OBJ + "f 0 1 2").encode(), "must name one of the 4 vertex lines above"),
    "two.obj": ((OBJ + "f 1 2").encode(), "must have faces of 3 to 64 corners, but line 6 has 2"),
    "nan.obj": (b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "must hold finite numbers"),
    "huge.obj": (b"v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "must hold finite numbers"),
    "flat.obj": ((OBJ + "vn 0 0 0\nf 1//1 2//1 3//1").encode(), "must have normals with a length"),
    "turned.obj": (
        (OBJ + "vn 0 0 -1\nf 1//1 2//1 3//1").encode(),
        "faces[0] must be seen from the side of its corners' normals "
        "(no fold sharper than that), not [0, 1, 2]",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_refused_with_a_reason(name: str, tmp_path: Path) -> None:
    data, message = BROKEN[name]
    with pytest.raises(SpecError) as caught:
        from_file(tmp_path / name, data)
    text = str(caught.value)
    assert text.startswith(f"surface.file: {message}")
    assert text.count(", got ") == 1
    assert "\n" not in text


def test_random_damage_never_crashes(rng: np.random.Generator, tmp_path: Path) -> None:
    """Each damaged file is a mesh or a clear error."""
    for name, data in FILES.items():
        for _ in range(30):
            damaged = bytearray(data)
            for place in rng.integers(0, len(data), rng.integers(1, 6)):
                damaged[place] = rng.integers(0, 256)
            try:
                from_file(tmp_path / name, bytes(damaged))
            except SpecError as error:
                assert str(error).startswith("surface.file: ")


def test_refinement_goes_on_until_the_stated_error_is_small() -> None:
    coarse = hologram_from(document(sphere_mesh(24) | {"refine": False}))
    fine = hologram_from(document(sphere_mesh(24)))
    stated, reached = element_mesh(coarse), element_mesh(fine)
    assert stated.direction_error > 5 * DIRECTION_ERROR
    assert reached.direction_error < DIRECTION_ERROR
    assert len(reached.mesh.faces) == reached.parts**2 * len(stated.mesh.faces)
    assert element_mesh(fine) is reached, "made once"


def test_a_mesh_too_coarse_says_so() -> None:
    reached = element_mesh(hologram_from(document(sphere_mesh(4))))
    assert reached.direction_error > DIRECTION_ERROR
    assert len(reached.mesh.faces) <= MAX_TRIANGLES
    flat = element_mesh(hologram_from(document(SQUARE)))
    assert flat.direction_error == 0.0
    assert flat.parts == 1


@pytest.mark.parametrize("name", SURFACES)
def test_facets_of_every_surface_are_good_to_the_stated_error(name: str) -> None:
    made = element_mesh(hologram_from(document(SURFACES[name])))
    assert made.direction_error <= DIRECTION_ERROR
    assert len(made.mesh.faces) < 20_000
