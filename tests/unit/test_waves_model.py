# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves of documents: round trip, conversion, clearance of the element, bad values."""

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema
import msgspec
import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.waves import Disc, ExtendedSource, Line, Rectangle, TriangleMesh
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.model.motion import moved
from hoe_addon.model.schema import hologram_schema
from hoe_addon.model.source_shapes import MAX_TRIANGLES, DiscShape, MeshShape
from hoe_addon.model.waves import AstigmaticSpec, ExtendedSourceSpec, WaveSpec

FOLDER = Path(__file__).parents[1] / "documents"
LENS = json.loads((FOLDER / "lens.json").read_text(encoding="utf-8"))
WAVES = json.loads((FOLDER / "waves.json").read_text(encoding="utf-8"))
ROUNDING = 1e-15
CARRIED = 1e-13
"""Places of 0.1 m are rounded to 1e-17 m, three times, and seen from 0.05 m."""


def document(wave: dict[str, Any], role: str = "object") -> dict[str, Any]:
    whole = copy.deepcopy(LENS)
    whole["recording"][role] = copy.deepcopy(wave)
    return whole


@pytest.mark.parametrize("name", WAVES)
def test_documents_come_back_and_fit_the_schema(name: str) -> None:
    written = to_document(hologram_from(document(WAVES[name])))
    jsonschema.Draft202012Validator(hologram_schema()).validate(written)
    assert to_document(hologram_from(written)) == written
    assert WAVES[name].items() <= written["recording"]["object"].items() or "window" in WAVES[name]


@pytest.mark.parametrize("name", WAVES)
def test_a_wave_carried_along_with_its_frame_is_the_same_wave(
    name: str, rng: np.random.Generator
) -> None:
    """Places and directions are told apart by the names of their fields."""
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    rotation *= np.linalg.det(rotation)
    origin_mm = rng.normal(size=3)
    spec = msgspec.convert(WAVES[name], WaveSpec)
    wave, carried = wave_from(spec), wave_from(moved(spec, rotation, origin_mm))
    points = np.column_stack([rng.uniform(-0.01, 0.01, (50, 2)), np.full(50, 1e-4)])
    draws = rng.random((50, wave.draws))
    there = points @ rotation.T + origin_mm / 1000.0
    np.testing.assert_allclose(
        carried.gradient(there, draws), wave.gradient(points, draws) @ rotation.T, atol=CARRIED
    )


def test_axes_of_a_source() -> None:
    wave = ExtendedSourceSpec(
        shape=DiscShape(diameter_mm=1),
        position_mm=(0, 0, -1),
        normal=(0, 0, -2),
        x_axis=(3, 0, 5),
    )
    np.testing.assert_array_equal(wave.axes(), [[1, 0, 0], [0, -1, 0], [0, 0, -1]])


def test_shapes_are_converted_to_metres_in_their_place() -> None:
    disc, rectangle, line, mesh = (
        wave_from(msgspec.convert(WAVES[name], WaveSpec))
        for name in ("disc", "rectangle", "line", "mesh")
    )
    for wave in (disc, rectangle, line, mesh):
        assert isinstance(wave, ExtendedSource)
    assert isinstance(disc.shape, Disc)
    assert disc.shape.centre == (0.005, -0.002, -0.06)
    normal = np.array([0.2, 0.1, 1.0]) / np.linalg.norm([0.2, 0.1, 1.0])
    for radius in (disc.shape.x, disc.shape.y):
        assert np.linalg.norm(radius) == pytest.approx(0.002, abs=ROUNDING)
        assert np.dot(radius, normal) == pytest.approx(0.0, abs=ROUNDING)
    assert np.dot(disc.shape.x, disc.shape.y) == pytest.approx(0.0, abs=ROUNDING)
    assert isinstance(rectangle.shape, Rectangle)
    assert np.linalg.norm(rectangle.shape.x) == pytest.approx(0.003, abs=ROUNDING)
    assert np.linalg.norm(rectangle.shape.y) == pytest.approx(0.001, abs=ROUNDING)
    assert isinstance(line.shape, Line)
    along = np.array([1.0, -0.4, 0.0]) / np.linalg.norm([1.0, -0.4, 0.0])
    np.testing.assert_allclose(line.shape.x, 0.004 * along, atol=ROUNDING)
    assert isinstance(mesh.shape, TriangleMesh)
    local = wave_mesh_corners()
    placed = mesh.shape.triangles - np.array([-0.002, 0.0, -0.065])
    np.testing.assert_allclose(
        np.linalg.norm(placed, axis=-1), np.linalg.norm(local, axis=-1), atol=ROUNDING
    )


def wave_mesh_corners() -> np.ndarray:
    vertices = np.array(WAVES["mesh"]["shape"]["vertices_mm"]) / 1000.0
    # The first face has four corners and is cut into two triangles.
    return vertices[np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4], [2, 5, 4]])]


FRAME = {"position_mm": [0, 0, -50]}
DISC = {"kind": "extended", "shape": {"shape": "disc", "diameter_mm": 4}, **FRAME}
MESH = {"shape": "mesh", "vertices_mm": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]}

TOUCHING = {
    "point on it": ({"kind": "point", "position_mm": [1, 2, 0]}, "position_mm"),
    "window's point on it": (
        {
            "kind": "window",
            "position_mm": [1, 2, 0],
            "window": {"position_mm": [0, 0, 5], "normal": [1, 0, 1], "thickness_mm": 1},
        },
        "position_mm",
    ),
    "straight line's place on it": (
        {
            "kind": "astigmatic",
            "first_mm": [1, 2, 0],
            "second_mm": [1, 2, -9],
            "line_direction": [1, 0, 0],
        },
        "first_mm",
    ),
    "arc's place on it": (
        {
            "kind": "astigmatic",
            "first_mm": [1, 2, -9],
            "second_mm": [1, 2, 0],
            "line_direction": [1, 0, 0],
        },
        "second_mm",
    ),
    "disc in its plane": (DISC | {"position_mm": [1, 2, 0]}, "shape"),
    "disc through it": (
        DISC | {"position_mm": [1, 2, 1], "normal": [1, 0, 0.1], "x_axis": [0, 1, 0]},
        "shape",
    ),
    "disc reaches in from outside": (DISC | {"position_mm": [21.5, 0, 0]}, "shape"),
    "rectangle through it": (
        DISC
        | {
            "shape": {"shape": "rectangle", "size_mm": [1, 9]},
            "position_mm": [1, 2, 4],
            "normal": [1, 0, 0],
            "x_axis": [0, 1, 0],
        },
        "shape",
    ),
    "line that touches it": (
        DISC
        | {
            "shape": {"shape": "line", "length_mm": 8},
            "position_mm": [3, 0, -4],
            "normal": [1, 0, 0],
            "x_axis": [0, 0, 1],
        },
        "shape",
    ),
    "mesh through it": (
        DISC
        | {
            "shape": MESH | {"faces": [[0, 1, 2, 3]]},
            "position_mm": [0, 0, 2],
            "normal": [1, 0, 0],
            "x_axis": [0, 0, 1],
        }
        | {"position_mm": [0, 0, -2]},
        "shape",
    ),
}


@pytest.mark.parametrize("role", ["object", "reference"])
@pytest.mark.parametrize("name", TOUCHING)
def test_a_source_on_the_element_is_refused(name: str, role: str) -> None:
    wave, field = TOUCHING[name]
    rule = "must not touch the surface with its source" if field == "shape" else "must not lie on"
    with pytest.raises(SpecError, match=rf"^recording\.{role}\.{field}: {rule}.*, got \["):
        hologram_from(document(wave, role))


@pytest.mark.parametrize(
    "wave",
    [
        DISC | {"position_mm": [22.5, 0, 0]},
        DISC | {"position_mm": [0, 0, 1e-3]},
        DISC | {"position_mm": [0, 0, 2.5], "normal": [1, 0, 0], "x_axis": [0, 0, 1]},
        DISC | {"position_mm": [25, 0, 1], "normal": [1, 0, 0], "x_axis": [0, 0, 1]},
    ],
)
def test_a_source_close_to_the_element_or_beside_it_is_fine(wave: dict[str, Any]) -> None:
    spec = hologram_from(document(wave))
    assert to_document(spec)["recording"]["object"]["position_mm"] == wave["position_mm"]


@pytest.mark.parametrize("place", [[0, 0, 0.01], [0, 0, -1.99]])
def test_a_window_that_the_element_is_not_behind_is_refused(place: list[float]) -> None:
    wave = WINDOW | {"window": WINDOW["window"] | {"position_mm": place}}
    message = r"^recording\.object\.window: must lie before the surface, .*, got \[0, 0, "
    with pytest.raises(SpecError, match=message):
        hologram_from(document(wave))
    hologram_from(document(wave | {"window": wave["window"] | {"normal": [0.5, 0, 1]}}))


def test_an_element_on_the_far_face_is_behind_the_window() -> None:
    place = WINDOW["window"] | {"position_mm": [0, 0, -2]}
    spec = hologram_from(document(WINDOW | {"window": place}))
    assert to_document(spec)["recording"]["object"]["window"] == place


WINDOW = {
    "kind": "window",
    "position_mm": [0, 0, -50],
    "window": {"position_mm": [0, 0, -10], "normal": [0, 0, 1], "thickness_mm": 2, "index": 1.5},
    "index": 1.2,
    "source_index": 1.3,
}
LINES = {
    "kind": "astigmatic",
    "first_mm": [0, 0, -50],
    "second_mm": [0, 0, -80],
    "line_direction": [1, 0, 0],
}
QUAD = MESH | {"faces": [[0, 1, 2, 3]]}

BAD = {
    "window position": (WINDOW, "position_mm", [0, 0], r"must be a list of length 3, got \[0, 0\]"),
    "position behind": (
        WINDOW,
        "position_mm",
        [0, 0, -5],
        r"must lie before the window, .*, got \[0.*, -5.*\]",
    ),
    "position on the face": (WINDOW, "position_mm", [3, 0, -10], "must lie before the window"),
    "window beam": (WINDOW, "beam", "both", "must be one of .*diverging"),
    "window index": (WINDOW, "index", 0.9, "must be at least 1, got 0.9"),
    "source index": (WINDOW, "source_index", 0, "must be at least 1, got 0"),
    "source index no number": (WINDOW, "source_index", "water", "must be a number"),
    "no window": (WINDOW, "window", None, "must be an object, got null"),
    "window place": (WINDOW, "window.position_mm", [0, 0, 1e13], r"must be at most 1e\+12 in size"),
    "window normal": (WINDOW, "window.normal", [0, 0, 0], "must not have zero length"),
    "thickness": (WINDOW, "window.thickness_mm", -1, "must be at least 0, got -1"),
    "window's own index": (WINDOW, "window.index", 0.5, "must be at least 1, got 0.5"),
    "unknown field": (WINDOW, "window.glass", "BK7", r"is not a field here \(known: position_mm"),
    "first": (LINES, "first_mm", [0, "a", 0], "must be a number"),
    "second": (LINES, "second_mm", [0, 0], "must be a list of length 3"),
    "one focus": (LINES, "second_mm", [0, 0, -50], "must not be the same place as first_mm"),
    "line": (LINES, "line_direction", [0, 0, 0], "must not have zero length"),
    "line along the ray": (LINES, "line_direction", [0, 0, 3], "must not run along the chief ray"),
    "line's beam": (LINES, "beam", 1, "must be"),
    "line's index": (LINES, "index", 0.5, "must be at least 1, got 0.5"),
    "disc's place": (DISC, "position_mm", [0, 0, None], "must be a number, got null"),
    "disc's normal": (DISC, "normal", [0, 0, 0], "must not have zero length"),
    "x axis": (DISC, "x_axis", [0, 0, 0], "must not have zero length"),
    "parallel axes": (DISC, "x_axis", [0, 0, -2], "must not be parallel to normal"),
    "disc's beam": (DISC, "beam", "", "must be one of"),
    "disc's index": (DISC, "index", 0, "must be at least 1, got 0"),
    "no shape": (DISC, "shape", None, "must be an object, got null"),
    "unknown shape": (
        DISC,
        "shape.shape",
        "star",
        'must be one of disc, rectangle, line, mesh, got "star"',
    ),
    "diameter": (DISC, "shape.diameter_mm", 0, "must be above 0, got 0"),
    "size": (
        DISC | {"shape": {"shape": "rectangle", "size_mm": [1, 1]}},
        "shape.size_mm",
        [1, -1],
        r"must be above 0, got -1",
    ),
    "length": (
        DISC | {"shape": {"shape": "line", "length_mm": 1}},
        "shape.length_mm",
        -1,
        "must be above 0, got -1",
    ),
    "no faces": (DISC | {"shape": QUAD}, "shape.faces", [], "must hold at least one face"),
    "too many faces": (
        DISC | {"shape": QUAD},
        "shape.faces",
        [[0, 1, 2]] * (MAX_TRIANGLES + 1),
        f"must be at most {MAX_TRIANGLES} faces, got {MAX_TRIANGLES + 1}",
    ),
    "too many triangles": (
        DISC | {"shape": QUAD},
        "shape.faces",
        [[0, 1, 2, 3]] * (MAX_TRIANGLES // 2 + 1),
        f"must make at most {MAX_TRIANGLES} triangles, got {MAX_TRIANGLES + 2}",
    ),
    "two corners": (
        DISC | {"shape": QUAD},
        "shape.faces",
        [[0, 1]],
        "must have at least three vertices",
    ),
    "a corner twice": (
        DISC | {"shape": QUAD},
        "shape.faces",
        [[0, 1, 1]],
        "must name each vertex once",
    ),
    "no such vertex": (DISC | {"shape": QUAD}, "shape.faces", [[0, 1, 4]], "must be from 0 to 3"),
    "negative vertex": (DISC | {"shape": QUAD}, "shape.faces", [[0, 1, -1]], "must be from 0 to 3"),
    "not convex": (
        DISC | {"shape": QUAD | {"vertices_mm": [[0, 0, 0], [4, 0, 0], [1, 1, 0], [0, 4, 0]]}},
        "shape.faces",
        [[1, 2, 3, 0]],
        "must be convex; cut it into triangles",
    ),
    "no area": (
        DISC | {"shape": QUAD},
        "shape.vertices_mm",
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]],
        "must have an area above 0",
    ),
    "vertex": (
        DISC | {"shape": QUAD},
        "shape.vertices_mm",
        [[0, 0, 0], [1, 0]],
        "must be a list of length",
    ),
    "huge vertex": (
        DISC | {"shape": QUAD},
        "shape.vertices_mm",
        [[0, 0, 0], [1, 0, 1e13]],
        "must be at most",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_values_are_named(name: str) -> None:
    wave, path, value, message = BAD[name]
    whole = document(wave)
    here = whole["recording"]["object"]
    *parents, last = path.split(".")
    for step in parents:
        here = here[step]
    here[last] = value
    field = "shape.faces" if name == "no area" else path
    with pytest.raises(SpecError) as caught:
        hologram_from(whole)
    line = str(caught.value)
    assert "\n" not in line
    assert line.startswith(f"recording.object.{field}")
    with pytest.raises(SpecError, match=rf"^recording\.object\.{field}(\[\d\])*: {message}"):
        hologram_from(whole)


def test_what_the_schema_refuses_the_reader_refuses() -> None:
    check = jsonschema.Draft202012Validator(hologram_schema())
    refused = 0
    for wave, path, value, _ in BAD.values():
        whole = document(wave)
        here = whole["recording"]["object"]
        *parents, last = path.split(".")
        for step in parents:
            here = here[step]
        here[last] = value
        refused += not check.is_valid(whole)
    assert refused >= len(BAD) // 2


def test_specs_made_in_python_are_checked_too() -> None:
    with pytest.raises(
        SpecError, match=r"^vertices_mm\[1\]\[2\]: must be a finite number, got NaN"
    ):
        MeshShape(vertices_mm=((0, 0, 0), (1, 0, np.nan), (0, 1, 0)), faces=((0, 1, 2),))
    with pytest.raises(SpecError, match=r"^faces\[0\]\[1\]: must be a whole number, got 1.5"):
        MeshShape(vertices_mm=((0, 0, 0), (1, 0, 0), (0, 1, 0)), faces=((0, 1.5, 2),))
    with pytest.raises(SpecError, match=r"^shape: must be a DiscShape or .*, got \"disc\""):
        ExtendedSourceSpec(shape="disc", position_mm=(0, 0, -1))
    lines = AstigmaticSpec(np.array([0, 0, -1]), [0, 0, -2], np.float32([1, 0, 0]))
    assert lines.first_mm == (0.0, 0.0, -1.0)
