# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``efficiency``: lists, angles, sides, and numbers that read back to the last bit."""

import argparse
import csv
import json
import math
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.cli import main
from hoe_addon.cli.parser import numbers, orders
from hoe_addon.core import media
from hoe_addon.core.efficiency import kinoform

DOCUMENTS = Path(__file__).parents[1] / "documents"
REFERENCE = Path(__file__).parents[1] / "reference"
LENS = DOCUMENTS / "lens.json"
HALF_DIGIT = 0.51
"""Printed digits are rounded once, some of them twice: half a unit, and a little."""


def rows(folder: Path, hologram: Path, *arguments: str) -> list[dict[str, str]]:
    out = folder / "out.csv"
    assert main(["efficiency", str(hologram), *arguments, "--out", str(out)]) == 0
    with out.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def shares(table: list[dict[str, str]]) -> dict[tuple[str, ...], float]:
    keys = ("wavelength_nm", "theta_deg", "phi_deg", "order", "side")
    return {tuple(row[key] for key in keys): float(row["efficiency"]) for row in table}


def element(folder: Path, **parts: Any) -> Path:
    path = folder / "hologram.json"
    path.write_text(json.dumps(json.loads(LENS.read_text()) | parts), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("400:401:0.25", [400.0, 400.25, 400.5, 400.75, 401.0]),
        ("400:400.5:0.1", [400.0, 400.1, 400.2, 400.3, 400.4, 400.5]),
        ("0:1:0.3", [0.0, 0.3, 0.6, 0.9]),
        ("0:1:0.3333333333333333", [0.0, 0.3333333333333333, 0.6666666666666666, 1.0]),
        ("2:-2:-2", [2.0, 0.0, -2.0]),
        ("5:5:1", [5.0]),
        ("532", [532.0]),
        ("1e-999999999:1:1", [0.0, 1.0]),
        ("1e3,.5,-7.", [1000.0, 0.5, -7.0]),
    ],
)
def test_lists(text: str, expected: list[float]) -> None:
    assert numbers(text) == pytest.approx(expected, rel=1e-15, abs=0.0)


def test_steps_are_the_floats_that_people_mean() -> None:
    assert numbers("380:780:0.1") == [tenths / 10 for tenths in range(3800, 7801)]


@pytest.mark.parametrize(
    "text",
    ["", "a", "1:2", "1:2:0", "1:2:-1", "1:2:3:4", "1,,2", "nan", "inf", "1e999", "1_0", "0:1:1e-9",
     "0:1:1e-29", "9" * 5000],
)  # fmt: skip
def test_bad_lists(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="got"):
        numbers(text)


@pytest.mark.parametrize(
    ("text", "expected"), [("-1:2", [-1, 0, 1, 2]), ("3", [3]), ("2,-1", [2, -1]), ("0:0", [0])]
)
def test_orders(text: str, expected: list[int]) -> None:
    assert orders(text) == expected


@pytest.mark.parametrize("text", ["", "a", "2:1", "1:2:3", "1,1", "0.5", "-101:0", "1e2"])
def test_bad_orders(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="got"):
        orders(text)


def test_table_is_complete_and_in_order(tmp_path: Path) -> None:
    table = rows(
        tmp_path, LENS, "--wavelengths", "450,532.1", "--orders", "-1:1", "--theta", "0:10:5"
    )
    assert list(table[0]) == [
        "wavelength_nm",
        "theta_deg",
        "phi_deg",
        "order",
        "side",
        "efficiency",
    ]
    assert len(table) == 2 * 3 * 3 * 2
    assert [row["side"] for row in table[:4]] == ["T", "R", "T", "R"]
    assert {row["wavelength_nm"] for row in table} == {"450.0", "532.1"}


def test_numbers_are_the_cores_to_the_last_bit(tmp_path: Path) -> None:
    found = shares(rows(tmp_path, LENS, "--wavelengths=430:700:30.1", "--orders=-3:3"))
    for (wavelength_nm, _, _, order, side), share in found.items():
        alpha = kinoform.phase_depth(float(wavelength_nm) / 1e9, 532e-9, media.constant(1.5))
        expected = float(kinoform.efficiency(int(order), alpha, 8)) if side == "T" else 0.0
        assert share == expected


def test_published_values(tmp_path: Path) -> None:
    reference = json.loads((REFERENCE / "kinoform.json").read_text(encoding="utf-8"))
    away = reference["away_from_design"]
    tolerance = HALF_DIGIT * 10.0 ** -away["digits"]
    for row in away["rows"]:
        relief = {
            "model": "kinoform",
            "levels": row["levels"],
            "design_wavelength_nm": away["design_wavelength_nm"],
            "relief": 1.5,
        }
        path = element(tmp_path, efficiency=relief)
        found = shares(
            rows(tmp_path, path, f"--wavelengths={row['wavelength_nm']}", "--orders=0:2")
        )
        transmitted = [share for key, share in found.items() if key[-1] == "T"]
        assert transmitted == pytest.approx(row["efficiency"], abs=tolerance)


def grating(folder: Path, **parts: Any) -> Path:
    """600 lines per mm along x, in the glass of index 1.5 behind the surface."""
    sine = 532e-6 * 600
    plane = {"kind": "plane", "index": 1}
    recording = {
        "wavelength_nm": 532,
        "object": plane | {"direction": [sine, 0, math.sqrt(1 - sine**2)]},
        "reference": plane | {"direction": [0, 0, 1]},
    }
    given = {"media": {"back": 1.5, "front": 1.0}, "recording": recording, "orders": [0, 1]}
    return element(folder, **(given | parts))


CONSTANT = {"model": "constant", "table": {"T": {"0": 0.6, "1": 0.3}, "R": {"1": 0.05}}}


def test_evanescent_is_exactly_zero_and_angles_are_in_their_own_medium(tmp_path: Path) -> None:
    path = grating(tmp_path, efficiency=CONSTANT, orders=[0, 1])
    # From the back: 1.5 sin(theta) + 0.3192 leaves the air at theta = 26.99 degrees.
    arguments = ("--wavelengths=532", "--orders=0:1", "--theta=26.9,27.1")
    found = shares(rows(tmp_path, path, *arguments))
    assert found["532.0", "26.9", "0.0", "1", "T"] == 0.3
    assert found["532.0", "27.1", "0.0", "1", "T"] == 0.0
    assert found["532.0", "27.1", "0.0", "1", "R"] == 0.05
    # From the front: into glass, transmitted goes on; reflected in air ends at 42.9 degrees.
    arguments = ("--wavelengths=532", "--orders=0:1", "--theta=42.8,43", "--from=front")
    found = shares(rows(tmp_path, path, *arguments))
    assert [found["532.0", theta, "0.0", "1", "T"] for theta in ("42.8", "43.0")] == [0.3, 0.3]
    assert [found["532.0", theta, "0.0", "1", "R"] for theta in ("42.8", "43.0")] == [0.05, 0.0]


def test_azimuth_turns_from_x_to_y(tmp_path: Path) -> None:
    path = grating(tmp_path, efficiency=CONSTANT, orders=[0, 1])
    arguments = ("--wavelengths=532", "--orders=1", "--theta=30", "--phi=0,90,180,-90")
    found = shares(rows(tmp_path, path, *arguments))
    of_azimuth = {key[2]: share for key, share in found.items() if key[-1] == "T"}
    assert of_azimuth == {"0.0": 0.0, "90.0": 0.3, "180.0": 0.3, "-90.0": 0.3}


def test_total_internal_reflection_is_seen_without_asking_for_both(tmp_path: Path) -> None:
    path = grating(tmp_path, efficiency=CONSTANT | {"total_internal_reflection": True})
    arguments = ("--wavelengths=532", "--theta=41,42", "--orders=0")
    found = shares(rows(tmp_path, path, *arguments))
    assert [found["532.0", "41.0", "0.0", "0", side] for side in "TR"] == [0.6, 0.0]
    assert [found["532.0", "42.0", "0.0", "0", side] for side in "TR"] == [0.0, 0.6]


def test_orders_that_the_document_leaves_out_have_their_value(tmp_path: Path) -> None:
    found = shares(rows(tmp_path, LENS, "--wavelengths=450", "--orders=9"))
    assert found["450.0", "0.0", "0.0", "9", "T"] > 0.0


@pytest.mark.parametrize("spelling", [["--orders", "-3:3"], ["--orders=-3:3"]])
def test_a_leading_minus_is_a_number(tmp_path: Path, spelling: list[str]) -> None:
    assert len(rows(tmp_path, LENS, "--wavelengths", "532", *spelling)) == 14


def test_a_medium_without_an_index_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = element(tmp_path, media={"back": 1.0, "front": "fused silica"})
    out = tmp_path / "out.csv"
    arguments = [
        "efficiency",
        str(path),
        "--wavelengths=500,8500",
        "--orders=0",
        "--out",
        str(out),
    ]
    assert main(arguments) == 2
    expected = f"hoe: error: {path}: media.front: medium fused silica: has no index of at least 1"
    assert capsys.readouterr().err.startswith(expected)
    assert list(tmp_path.iterdir()) == [path]


RIGOROUS = {
    "model": "rcwa",
    "profile": {"shape": "binary", "depth_um": 0.4},
    "ridge": 1.5,
    "harmonics": 21,
}


def test_polarisations(tmp_path: Path) -> None:
    path = grating(tmp_path, efficiency=RIGOROUS)
    arguments = ("--wavelengths=532", "--orders=-1:1", "--theta=20", "--phi=0,40")
    found = {
        letter: shares(rows(tmp_path, path, *arguments, f"--polarization={letter}"))
        for letter in "spu"
    }
    assert found["u"] == shares(rows(tmp_path, path, *arguments))
    for key, share in found["u"].items():
        assert share == pytest.approx(0.5 * (found["s"][key] + found["p"][key]), abs=1e-15)
    assert any(abs(share - found["p"][key]) > 1e-3 for key, share in found["s"].items())


@pytest.mark.parametrize("letter", ["s", "p", "u"])
def test_scalar_models_know_no_polarisation(tmp_path: Path, letter: str) -> None:
    arguments = ("--wavelengths=450", "--orders=-1:1", "--theta=20")
    plain = rows(tmp_path, LENS, *arguments)
    assert rows(tmp_path, LENS, *arguments, f"--polarization={letter}") == plain


def test_exposures_of_a_multiplexed_hologram_are_summed(tmp_path: Path) -> None:
    """Far from each other, each peak is that of its own exposure alone."""
    beam = {"kind": "plane", "index": 1.5}
    recording = {
        "wavelength_nm": 532,
        "object": beam | {"direction": [0, 0, -1]},
        "reference": beam | {"direction": [0, 0, 1]},
    }
    single = {"model": "kogelnik", "thickness_um": 12, "index": 1.5, "modulation": 0.02}
    both = single | {"exposures": [{"wavelength_nm": 633, "modulation": 0.02}]}
    given = {"media": {"back": 1.5, "front": 1.5}, "recording": recording}
    arguments = ("--wavelengths=532,633", "--orders=1")
    alone = shares(rows(tmp_path, element(tmp_path, efficiency=single, orders=[0, 1], **given),
                        *arguments))  # fmt: skip
    together = shares(rows(tmp_path, element(tmp_path, efficiency=both, orders=[0, 1], **given),
                           *arguments))  # fmt: skip
    green, red = (
        sum(share for key, share in together.items() if key[0] == colour)
        for colour in ("532.0", "633.0")
    )
    first = math.tanh(math.pi * 0.02 * 12 / 0.532) ** 2
    assert sum(s for key, s in alone.items() if key[0] == "532.0") == pytest.approx(first, abs=5e-3)
    assert green == pytest.approx(first, abs=5e-3)
    assert red == pytest.approx(math.tanh(math.pi * 0.02 * 12 / 0.633) ** 2, abs=2e-2)
