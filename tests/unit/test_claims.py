# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the examples: compared, reported, and written as expected ones."""

import json
import math
import sys
from pathlib import Path

import pytest

from hoe_addon.cli.claims import Claim, compare, report, row
from hoe_addon.cli.example import Example, read_arguments

NUMBERS = [row("length", "mm", 2.0, 0.1), row("angle", "deg", -1.0, 0.0)]


@pytest.fixture
def example(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Example:
    folder = tmp_path / "10_lens"
    folder.mkdir()
    monkeypatch.chdir(tmp_path)
    return Example(folder, "point_lens", "a formula", "rounding", dict, lambda: NUMBERS)


@pytest.mark.parametrize(
    ("found", "holds"), [(2.0, True), (2.09, True), (1.91, True), (2.11, False), (1.89, False)]
)
def test_a_number_holds_within_what_is_allowed(found: float, holds: bool) -> None:
    assert Claim("length", "mm", 2.0, found, 0.1).holds is holds


def test_no_number_is_never_as_expected() -> None:
    assert not Claim("length", "mm", 2.0, math.nan, 0.1).holds
    assert not Claim("length", "mm", 2.0, math.nan, math.inf).holds


def test_every_expected_number_must_be_found() -> None:
    (first, second) = compare({"numbers": NUMBERS}, {"angle": -1.0, "length": 2.05, "more": 0.0})
    assert first == Claim("length", "mm", 2.0, 2.05, 0.1)
    assert second == Claim("angle", "deg", -1.0, -1.0, 0.0)
    with pytest.raises(KeyError, match="length"):
        compare({"numbers": NUMBERS}, {"angle": -1.0})


@pytest.mark.parametrize(("found", "code"), [(2.05, 0), (2.2, 1)])
def test_report_prints_writes_and_tells(
    found: float, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    claims = compare({"numbers": NUMBERS}, {"length": found, "angle": -1.0})
    assert report(claims, tmp_path / "numbers.json") == code
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[1:]] == ["length", "angle"]
    assert lines[1].endswith("NOT AS EXPECTED") == bool(code)
    written = json.loads((tmp_path / "numbers.json").read_text(encoding="utf-8"))
    assert [number["as_expected"] for number in written] == [not code, True]


def test_renew_writes_the_expected_numbers(
    example: Example, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["run.py", "--renew"])
    assert example.run("An example.") == 0
    path = example.folder / "expected.json"
    assert capsys.readouterr().out == f"{path}: written\n"
    document = json.loads(path.read_text(encoding="utf-8"))
    assert document["numbers"] == NUMBERS
    assert document["tolerance"] == {"reason": "rounding"}
    assert document["provenance"] == {
        "source": "a formula",
        "generated_by": "python examples/10_lens/run.py --renew",
        "device": "point_lens",
    }


def test_results_go_to_a_folder_of_the_examples_name(
    example: Example, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["run.py"])
    arguments = read_arguments(example.folder, None)
    assert arguments.out == Path("out/10_lens")
    assert not arguments.renew
    assert not hasattr(arguments, "samples")
    assert read_arguments(example.folder, None, 96).samples == 96
