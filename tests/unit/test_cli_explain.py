# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``explain``: a table of 100 columns, JSON for scripts, and changes of the plan."""

import argparse
import json
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.cli import main
from hoe_addon.cli.picture_options import add_picture_options, assignments

LENS = Path(__file__).resolve().parents[1] / "documents" / "lens.json"


def lines_of(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    assert main(["explain", *arguments]) == 0
    return capsys.readouterr().out.splitlines()


def json_of(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    return json.loads("\n".join(lines_of(capsys, *arguments, "--json")))


def test_table(capsys: pytest.CaptureFixture[str]) -> None:
    lines = lines_of(capsys, "grating_rainbow")
    assert lines[0].split() == ["effect", "hologram", "is", "error", "cost", "why"]
    assert max(map(len, lines)) <= 100
    rows = {line.split()[0]: line.split() for line in lines[1:] if not line.startswith(" ")}
    assert rows["dispersion"][1:3] == ["(scene)", "on"]
    assert rows["position"][1:4] == ["grating", "none", "0"]
    assert "300 lines/mm" in " ".join(" ".join(lines).split())
    assert lines[-1] == "promise: all that is left out costs 0, at most 0.001 is allowed"


def test_json(capsys: pytest.CaptureFixture[str]) -> None:
    found = json_of(capsys, "grating_rainbow")
    assert found["document"] == "grating_rainbow"
    assert found["allowed_relative_error"] == 1e-3
    (dispersion,) = [each for each in found["decisions"] if each["effect"] == "dispersion"]
    assert dispersion["on"] is True
    assert dispersion["hologram"] == ""
    assert dispersion["relative_error_without"] > 0.1
    orders = {each["part"] for each in found["decisions"] if each["effect"] == "orders"}
    assert orders == {"T-2", "T-1", "T0", "T+1", "T+2"}


@pytest.mark.parametrize("option", [["--effects", "-dispersion"], ["--effects=-dispersion"]])
def test_changes(capsys: pytest.CaptureFixture[str], option: list[str]) -> None:
    lines = lines_of(capsys, "grating_rainbow", *option)
    (row,) = [line for line in lines if line.startswith("dispersion")]
    assert row.split()[2] == "off!"
    assert lines[-1].endswith("at most 0.001 of what is not marked is allowed")


def test_everything_on_is_still_looked_at(capsys: pytest.CaptureFixture[str]) -> None:
    lines = lines_of(capsys, "grating_rainbow", "--effects", "all")
    (row,) = [line for line in lines if line.startswith("dispersion")]
    assert row.split()[2] == "on!"
    assert float(row.split()[3]) > 0.1
    assert lines[-2] == "everything is simulated"


def test_dark_scene_has_an_empty_table(capsys: pytest.CaptureFixture[str]) -> None:
    dark = ["--set", "room.kind=none", "--set", "elements.lamp.luminance_cd_m2=0"]
    lines = lines_of(capsys, "grating_rainbow", *dark)
    assert lines[1] == "everything is simulated"


def test_what_stays_in_a_part_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    text = " ".join(" ".join(lines_of(capsys, "grating_rainbow", "--effects=-orders")).split())
    assert "off!" in text
    assert "kept, one order has to stay; cannot be left out" in text


def test_fields_are_changed_first(capsys: pytest.CaptureFixture[str]) -> None:
    change = "elements.grating.hologram.characteristic.lines_per_mm=5000"
    found = json_of(capsys, "grating_rainbow", "--set", change)
    kept = [
        each["part"] for each in found["decisions"] if each["effect"] == "orders" and each["on"]
    ]
    assert kept == ["T0"]


def test_hologram_alone(capsys: pytest.CaptureFixture[str]) -> None:
    found = json_of(capsys, str(LENS))
    assert found["document"] == "lens"
    effects = {each["effect"]: each for each in found["decisions"] if not each["part"]}
    assert effects["levels"]["on"]
    assert "8 levels" in effects["levels"]["why"]
    assert effects["angle"]["on"]
    changed = json_of(capsys, str(LENS), "--effects", "-levels")
    (levels,) = [each for each in changed["decisions"] if each["effect"] == "levels"]
    assert levels["on"] is False
    assert levels["overridden"] is True


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["point_lens", "--effects", "-hazy"], "render.effects[0]: must name an effect"),
        (["point_lens", "--effects", "+haze,,"], "--effects: must be changes with a comma"),
        (["point_lens", "--promise", "2"], "--promise: must be at least 0 and below 1, got 2.0"),
        (["point_lens", "--promise", "nan"], "--promise: must be at least 0 and below 1, got nan"),
        ([str(LENS), "--set", "name=x"], "--set: must be left out for a hologram"),
        (
            ["diffractive_achromat", "--effects=-position"],
            "render.effects: must not leave out what no simpler document can do without (the "
            'pattern changes over the hologram and has no plain form), got "-position"',
        ),
        (
            ["two_hologram_ar", "--effects=in_coupler:-orders"],
            'kept, total reflection takes its share), got "in_coupler:-orders"',
        ),
        (["no_such"], "no_such: is neither a preset"),
    ],
)
def test_mistakes(capsys: pytest.CaptureFixture[str], arguments: list[str], message: str) -> None:
    assert main(["explain", *arguments]) == 2
    complaint = capsys.readouterr().err
    assert message in complaint
    assert len(complaint.splitlines()) == 1


def test_pictures_take_the_same_changes() -> None:
    parser = argparse.ArgumentParser()
    add_picture_options(parser)
    given = parser.parse_args(["sight", "--out", "x", "--effects", "+haze,window:-levels"])
    assert assignments(given) == ['render.effects=["+haze", "window:-levels"]']
    assert assignments(parser.parse_args(["sight", "--out", "x"])) == []
