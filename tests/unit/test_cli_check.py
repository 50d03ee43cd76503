# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``check``: what is printed, what is written, and what is refused."""

import json
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.cli import main
from hoe_addon.model.document import load_hologram
from hoe_addon.model.evaluate import efficiencies, incident_direction

LENS = Path(__file__).parents[1] / "documents" / "lens.json"

SAME = 1e-12
"""The same number on two ways."""

GRATING: dict[str, Any] = {
    "schema": 1,
    "name": "known",
    "surface": {"shape": "plane", "size_mm": [10, 10]},
    "media": {"back": 1.5, "front": 1.5},
    "characteristic": {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 500},
    "efficiency": {"model": "kogelnik", "thickness_um": 5, "index": 1.5, "modulation": 0.05},
    "orders": [-1, 0, 1],
}
RCWA = {
    "model": "rcwa",
    "profile": {"shape": "binary", "depth_um": 0.3},
    "ridge": 1.5,
    "groove": 1.2,
    "harmonics": 21,
}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return written(tmp_path)


def written(folder: Path, **parts: Any) -> Path:
    path = folder / "a.json"
    path.write_text(json.dumps(GRATING | parts), encoding="utf-8")
    return path


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    assert main(["check", *arguments]) == 0
    return capsys.readouterr().out.splitlines()


def test_the_known_case_is_shown_and_warned_of(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = printed(capsys, str(path))
    assert lines[0] == "light: 532 nm, theta -5.087 deg, phi 0 deg, from the back (on Bragg)"
    assert lines[1].split() == [
        "order",
        *(word for model in ("kogelnik", "rcwa") for letter in "usp" for word in (model, letter)),
    ]
    [first] = [line.split() for line in lines if line.startswith("T +1")]
    assert float(first[2]) == pytest.approx(0.99, abs=0.005)
    assert float(first[5]) == pytest.approx(0.36, abs=0.005)
    [rest] = [line.split() for line in lines if line.startswith("A ")]
    assert rest[1:] == ["0.000000"] * 6
    assert "warning: kogelnik does not hold here: Q' = 2.8 < 10" in lines
    assert any(line.startswith("largest difference: rcwa 0.36") for line in lines)
    assert lines[-1].startswith("shader: formula, error")


def test_json_holds_the_printed_numbers(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.json"
    options = ("--theta=0:10:5", "--phi=0,30", "--wavelengths=500,532", "--orders=0:1")
    lines = printed(capsys, str(path), *options, "--from=front", f"--json={out}")
    document = json.loads(out.read_text(encoding="utf-8"))
    assert len(document["light"]) == 2 * 3 * 2
    assert sum(line.startswith("light: ") for line in lines) == 2 * 3 * 2
    spec = load_hologram(path)
    for light in document["light"]:
        assert light["from"] == "front"
        angles = (light["theta_deg"], light["phi_deg"])
        direction = incident_direction(*angles, from_front=True)
        own = efficiencies(spec, direction, light["wavelength_nm"], [0, 1])
        rows = light["models"]["kogelnik"]["orders"]
        found = {(row["order"], row["side"]): row["u"] for row in rows}
        for place, order in enumerate((0, 1)):
            assert found[order, "T"] == pytest.approx(float(own[place, 0]), abs=SAME)
    assert document["warnings"]
    assert document["shader"]["form"] == "formula"


def test_a_table_that_nobody_asked_for_is_not_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = printed(capsys, str(written(tmp_path, efficiency=RCWA)))
    assert lines[-1].startswith("shader: a table; --table")


def test_no_column_is_doubled_where_s_and_p_are_alike(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = {"model": "constant", "table": {"T": {"1": 0.5, "0": 0.25}}}
    lines = printed(capsys, str(written(tmp_path, efficiency=document)))
    assert lines[1].split() == ["order", "constant"]
    assert "T +1        0.500000" in lines
    assert "A           0.250000" in lines
    assert "all rules hold" in lines


REFUSED = {
    "angle": (["--theta=90"], r"--theta: must be between -90 and 90, got 90.0"),
    "wavelength": (["--wavelengths=0.5"], r"--wavelengths: must be from 200 to 20000 nm, got 0.5"),
    "rays": (
        ["--theta=0:50:0.1"],
        "--theta: all lists together must be at most 500 rays",
    ),
    "side": (["--from=front"], r"--from: needs --theta, since on Bragg comes from the other side"),
    "orders": (["--orders=1:0"], r"--orders: must be A:B"),
}


@pytest.mark.parametrize(("options", "message"), REFUSED.values(), ids=REFUSED)
def test_bad_options_are_one_line(
    path: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    assert main(["check", str(path), *options]) == 2
    found = capsys.readouterr()
    assert found.out == ""
    assert found.err.count("\n") == 1
    assert message in found.err


def test_the_input_is_not_overwritten(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = path.read_bytes()
    assert main(["check", str(path), f"--json={path}"]) == 2
    assert path.read_bytes() == before


def test_a_material_without_an_index_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = {"table": [[500, 1.5, 0], [540, 1.5, 0]]}
    path = written(tmp_path, efficiency=RCWA | {"ridge": table})
    assert main(["check", str(path), "--wavelengths=532,600"]) == 2
    expected = f"hoe: error: {path}: efficiency.ridge: table holds no index at 600 nm"
    assert capsys.readouterr().err.startswith(expected)


def test_light_that_a_scalar_model_loses_is_no_gain(capsys: pytest.CaptureFixture[str]) -> None:
    [line] = [line for line in printed(capsys, str(LENS)) if "kinoform: R + T - 1" in line]
    number, rest = line.removeprefix("  holds kinoform: R + T - 1 = ").split(
        " (<= 1e-08): at most "
    )
    share, _, words = rest.partition(" % ")
    assert float(share) == pytest.approx(100.0 * (1.0 + float(number)), rel=1e-4)
    assert words == "of the light goes out, s or p, and no more than 100 % may"
