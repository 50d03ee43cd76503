# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin reliefs in documents: shapes, errors of making, files, and their text in the shader."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency.profiles import Binary, Sawtooth, Sinusoid
from hoe_addon.core.efficiency.segments import Segments, Steps
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from, load_hologram, to_document
from hoe_addon.model.efficiency import KinoformSpec
from hoe_addon.shading.efficiency.kinoform import kinoform_part

LENS = Path(__file__).parents[1] / "documents" / "lens.json"
PLAIN: dict[str, Any] = {
    "model": "kinoform",
    "levels": 0,
    "design_wavelength_nm": 532,
    "relief": 1.5,
}


def document(**changes: Any) -> dict[str, Any]:
    return json.loads(LENS.read_text(encoding="utf-8")) | {"efficiency": PLAIN | changes}


def spec(**changes: Any) -> KinoformSpec:
    found = hologram_from(document(**changes)).efficiency
    assert isinstance(found, KinoformSpec)
    return found


def shape(name: str, **fields: Any) -> dict[str, Any]:
    return {"profile": {"shape": name, **fields}}


def test_defaults_are_the_ideal_sawtooth_that_knows_directions() -> None:
    found = spec(levels=8)
    assert found.made_profile() == Sawtooth(8)
    assert found.model().depth == 1.0
    assert found.model().angle_dependent


@pytest.mark.parametrize(
    ("changes", "kind"),
    [
        ({}, Sawtooth),
        ({"levels": 6, "errors": {"edge_width": 0.1}}, Sawtooth),
        ({"levels": 8, "errors": {"etch_errors": [0.1, 0, 0]}}, Steps),
        ({"levels": 8, "errors": {"duty_error": 0.1}}, Segments),
        ({"levels": 8, "errors": {"etch_errors": [0, 0.1, 0], "edge_width": 0.01}}, Segments),
        (shape("sinusoid"), Sinusoid),
        (shape("binary", duty=0.3), Binary),
        (shape("binary") | {"errors": {"duty_error": -0.2}}, Binary),
        (shape("binary") | {"errors": {"edge_width": 0.2}}, Segments),
        (shape("triangle", peak=0.2), Segments),
        (shape("sampled", heights=[0, 1, 0.5]), Segments),
        (shape("sampled", heights=[0, 1], between="steps"), Steps),
        (
            shape("sampled", heights=[0, 1], between="steps") | {"errors": {"edge_width": 0.1}},
            Segments,
        ),
    ],
)
def test_documents_make_profiles(changes: dict[str, Any], kind: type) -> None:
    found = spec(**changes)
    assert isinstance(found.made_profile(), kind)
    written = to_document(hologram_from(document(**changes)))
    assert hologram_from(written).efficiency == found
    # What is made carries all light.
    shares = found.made_profile().efficiency(np.arange(-3000, 3001), 0.8)
    assert np.sum(shares) == pytest.approx(1.0, abs=2e-3)


def test_numbers_of_the_document_arrive() -> None:
    found = spec(
        depth_waves=2.0,
        angle_dependent=False,
        profile={"shape": "binary", "duty": 0.4},
        errors={"depth_error": 0.1, "duty_error": 0.05},
    )
    assert found.made_profile() == Binary(pytest.approx(0.45))
    assert found.model().depth == pytest.approx(2.2)
    assert not found.model().angle_dependent


BAD = [
    ({"depth_waves": 0}, "depth_waves: must be above 0, got 0"),
    ({"angle_dependent": 1}, "angle_dependent: must be true or false, got 1"),
    (shape("round"), "profile.shape: must be one of sawtooth, sinusoid, binary, triangle, sampled"),
    (shape("binary", duty=1), "profile.duty: must be below 1, got 1"),
    (shape("binary", duty=0), "profile.duty: must be above 0, got 0"),
    (shape("triangle", peak=1.5), "profile.peak: must be at most 1, got 1.5"),
    (
        shape("triangle") | {"levels": 4},
        "levels: must be 0 unless the profile is a sawtooth, got 4",
    ),
    (shape("sampled"), "profile.heights: must be given, or else a file, got"),
    (shape("sampled", heights=[1]), "profile.heights: must have from 2 to 4096 items, got 1"),
    (shape("sampled", heights=[0, 101]), "profile.heights[1]: must be at most 100, got 101"),
    (
        shape("sampled", heights=[0, 1], between="x"),
        "profile.between: must be one of linear, steps",
    ),
    (shape("sampled", file="none.npy"), "profile.file: must be a file that exists"),
    ({"errors": {"depth_error": -1}}, "errors.depth_error: must be above -1, got -1"),
    ({"errors": {"edge_width": 0.6}}, "errors.edge_width: must be at most 0.5, got 0.6"),
    (
        {"levels": 8, "errors": {"edge_width": 0.2}},
        "errors.edge_width: must be at most 0.125, one step, got 0.2",
    ),
    (
        shape("sinusoid") | {"errors": {"edge_width": 0.1}},
        "errors.edge_width: needs a profile with upright walls, got 0.1",
    ),
    (
        {"levels": 8, "errors": {"etch_errors": [0.1]}},
        "errors.etch_errors: must be one for each of 3 masks, got [0.1]",
    ),
    (
        {"levels": 6, "errors": {"etch_errors": [0.1, 0.1]}},
        "errors.etch_errors: needs a sawtooth in levels whose number is a power of 2",
    ),
    (
        {"levels": 4, "errors": {"etch_errors": [0.1, 2]}},
        "errors.etch_errors[1]: must be above -1 and at most 1, got 2",
    ),
    (
        {"levels": 4, "errors": {"duty_error": 0.25}},
        "errors.duty_error: must be below 0.25 in size, got 0.25",
    ),
    (
        {"errors": {"duty_error": 0.1}},
        "errors.duty_error: needs a binary profile, or a sawtooth in 2, 4, 8, ... at most 4096",
    ),
    (
        shape("binary", duty=0.9) | {"errors": {"duty_error": 0.1}},
        "errors.duty_error: must leave a ridge and a gap, got 0.1",
    ),
    ({"errors": {"rounding": 0.1}}, "errors.rounding: "),
]


@pytest.mark.parametrize(("changes", "message"), BAD, ids=[message for _changes, message in BAD])
def test_each_rule_names_field_and_value(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError, match="^" + re.escape(f"efficiency.{message}")) as caught:
        hologram_from(document(**changes))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("suffix", [".npy", ".csv", ".txt"])
def test_heights_of_a_file_beside_the_document(tmp_path: Path, suffix: str) -> None:
    heights = np.array([0.0, 0.25, 1.0, 0.5])
    file = tmp_path / f"heights{suffix}"
    if suffix == ".npy":
        np.save(file, heights)
    else:
        file.write_text((", " if suffix == ".csv" else "\n").join(map(str, heights)) + "\n")
    whole = tmp_path / "relief.json"
    whole.write_text(json.dumps(document(**shape("sampled", file=file.name, between="steps"))))
    profile = load_hologram(whole).efficiency.made_profile()
    np.testing.assert_array_equal(profile.heights, heights)


def npy(values: np.ndarray) -> bytes:
    import io

    stream = io.BytesIO()
    np.save(stream, values)
    return stream.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("h.json", b"[0, 1]", "must end in .csv, .npy, .txt"),
        ("h.csv", b"0\n1\nx\n", "must hold numbers, not 'x' at number 3"),
        ("h.csv", b"0, nan\n", "must hold finite heights up to 100, not nan at number 2"),
        ("h.csv", b"5\n", "must hold 2 to 4096 heights, not 1"),
        ("h.csv", b"1\n" * 5000, "must hold 2 to 4096 heights, not 5000"),
        ("h.csv", b"\xff\xfe\x00", "cannot be read"),
        ("h.npy", b"\x93NUMPY", "is no readable .npy file"),
        ("h.npy", npy(np.zeros((4, 4))), "must have one dimension, not the shape (4, 4)"),
        ("h.npy", npy(np.zeros(4, dtype=complex)), "must hold real numbers, not complex128"),
        ("h.npy", npy(np.array([0.0, np.inf])), "must hold finite heights up to 100, not inf"),
        ("h.npy", npy(np.zeros(9000)), "must hold 2 to 4096 heights, not 9000"),
    ],
)
def test_bad_files_get_one_line(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(SpecError, match=re.escape(f"efficiency.profile.file: {message}")) as caught:
        spec(**shape("sampled", file=str(file)))
    assert "\n" not in str(caught.value)


def test_a_changed_file_is_read_again(tmp_path: Path) -> None:
    file = tmp_path / "h.csv"
    file.write_text("0\n1\n")
    found = spec(**shape("sampled", file=str(file), between="steps"))
    file.write_text("0\n1\n0.5\n")
    assert found.model().profile.pieces == 3
    file.unlink()
    with pytest.raises(SpecError, match="must be a file that exists"):
        found.model()


@pytest.mark.parametrize(
    ("count", "between", "has"),
    [(64, "steps", True), (65, "steps", False), (64, "linear", True), (65, "linear", False)],
)
def test_long_profiles_have_no_formula_in_the_shader(count: int, between: str, has: bool) -> None:
    heights = np.linspace(0.0, 1.0, count).tolist()
    found = spec(**shape("sampled", heights=heights, between=between))
    assert found.has_formula == has
    if has:
        assert kinoform_part(found, (Branch(1),)).functions
    else:
        with pytest.raises(SpecError, match=r"^efficiency\.profile: must have at most 64 pieces"):
            kinoform_part(found, (Branch(1),))


def test_numbers_of_closed_forms_travel_in_sockets() -> None:
    branches = (Branch(0), Branch(1), Branch(1, reflected=True))

    def texts(**changes: Any) -> tuple[object, ...]:
        part = kinoform_part(spec(**changes), branches)
        return dict(part.shares), part.functions, part.parameters, part.prepare

    walls = {"errors": {"edge_width": 0.1}}
    assert texts(levels=8, depth_waves=2, errors={"depth_error": 0.1}) == texts()
    assert texts(levels=8, **walls) == texts(errors={"edge_width": 0.3})
    assert texts(**shape("binary", duty=0.2)) == texts(**shape("binary"))
    distinct = (
        *({}, {"angle_dependent": False}, walls, shape("binary"), shape("sinusoid")),
        *(shape("triangle"), shape("triangle", peak=0.3)),
    )
    assert len({str(texts(**changes)) for changes in distinct}) == len(distinct)
    part = kinoform_part(spec(levels=8, errors={"depth_error": 0.1, "edge_width": 0.05}), branches)
    assert set(part.shares) == {Branch(0), Branch(1)}
    assert part.sockets["depth_waves"] == pytest.approx(1.1)
    assert part.sockets["edge_width"] == 0.05
    assert part.sockets["levels"] == 8.0
