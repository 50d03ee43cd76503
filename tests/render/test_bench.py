# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark runs and its report is whole; speed itself is not judged on a busy machine."""

import json
from pathlib import Path

import bpy
import pytest

from hoe_addon.blender.bench.surfaces import CASES, STOCK, run_benchmark
from hoe_addon.cli import main

pytestmark = pytest.mark.render

QUICK = ("bench", "--seconds", "2", "--size", "48x32", "--only", "surfaces")


def test_json_names_every_case_and_its_ratio(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "speed.json"
    assert main([*QUICK, "--json", str(path)]) == 0
    assert capsys.readouterr().out == ""
    result = json.loads(path.read_text(encoding="utf-8"))
    assert result["size"] == [48, 32]
    speeds = {speed["name"]: speed for speed in result["speeds"]}
    assert tuple(speeds) == CASES
    assert speeds[STOCK]["ratio"] == 1.0
    assert all(speed["ratio"] > 0.0 for speed in speeds.values())
    assert all(speed["samples_per_second"] > 1e3 for speed in speeds.values())


LONGEST_S = {"1 layer": 15.0, "20 slices, slanted": 90.0}
"""What a rigorous table may take on two cores, in plane of incidence."""


@pytest.mark.slow
def test_rigorous_tables_are_ready_in_time(tmp_path: Path) -> None:
    path = tmp_path / "speed.json"
    assert main(["bench", "--only", "rigorous", "--json", str(path)]) == 0
    speeds = {each["name"]: each for each in json.loads(path.read_text("utf-8"))["rigorous"]}
    for name, longest in LONGEST_S.items():
        assert speeds[f"{name}, in plane"]["seconds"] < longest
        assert speeds[f"{name}, in plane"]["ratio"] > 1.0


def test_nothing_stays_behind() -> None:
    kinds = ("scenes", "objects", "meshes", "materials", "worlds", "texts", "node_groups")
    before = {kind: len(getattr(bpy.data, kind)) for kind in kinds}
    done: list[float] = []
    run_benchmark(2.0, (32, 32), done.append)
    assert {kind: len(getattr(bpy.data, kind)) for kind in kinds} == before
    assert done == sorted(done)
    assert done[-1] == 1.0


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("--size=0x4", "--size: must be WxH, each from 4 to 4096 pixels, got '0x4'"),
        ("--size=64", "--size: must be WxH, each from 4 to 4096 pixels, got '64'"),
        ("--only=glass", "--only: must be some of surfaces,rigorous,lookups,effects, got 'glass'"),
        ("--seconds=nan", "--seconds: must be from 1 to 3600, got 'nan'"),
        ("--json=/none/x.json", "/none/x.json: cannot be written: No such file or directory"),
    ],
)
def test_bad_options(option: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", option]) == 2
    assert capsys.readouterr().err.startswith(f"hoe: error: {message}")
