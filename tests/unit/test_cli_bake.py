# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``bake``: files, what is printed, limits, and Ctrl-C that leaves a part to go on from."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.cli import main
from hoe_addon.core.efficiency.node_source import NodeSource
from hoe_addon.model.tables.file import read_table

DOCUMENTS = Path(__file__).parents[1] / "documents"
LENS = DOCUMENTS / "lens.json"
CONSTANT = {"model": "constant", "table": {"T": {"0": 0.6, "1": 0.3}, "R": {"1": 0.05}}}
FEW = ("--wavelengths=450:650", "--angles=-15:15", "--across=0:0", "--from=back")
FLOAT32 = 1e-7


def hologram(folder: Path, **parts: Any) -> Path:
    document = json.loads(LENS.read_text(encoding="utf-8")) | {"orders": [0, 1]}
    path = folder / "hologram.json"
    path.write_text(json.dumps(document | parts), encoding="utf-8")
    return path


def test_table_and_exr(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, exr = tmp_path / "table.npz", tmp_path / "table.exr"
    assert main(["bake", str(hologram(tmp_path)), "--out", str(out), "--exr", str(exr), *FEW]) == 0
    table, same = read_table(str(out)), read_table(str(exr))
    assert table.values == pytest.approx(same.values, abs=FLOAT32)
    assert table.sides == ("back",)
    assert (table.wavelength[0], table.wavelength[-1]) == (450e-9, 650e-9)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(f"table: {table.size} numbers: {len(table.wavelength)} wavelength x")
    assert lines[1] == "collapsed: across, x, y"
    assert "tolerance 0.001 met" in lines[2]
    assert any(line.startswith("s against p: 0.0e+00 at most") for line in lines)
    assert not list(tmp_path.glob("*.part*"))


@pytest.mark.parametrize("suffix", [".csv", ".txt", ".bsdf"])
def test_other_formats(tmp_path: Path, suffix: str) -> None:
    out = tmp_path / f"table{suffix}"
    path = hologram(tmp_path, efficiency=CONSTANT)
    assert main(["bake", str(path), "--out", str(out)]) == 0
    assert read_table(str(out)).values.ravel().tolist() == [0.6, 0.3, 0.05] * 2


def test_a_table_that_is_too_small_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "table.npz"
    path = hologram(tmp_path)
    assert main(["bake", str(path), "--out", str(out), "--largest", "64", *FEW]) == 0
    assert "tolerance 0.001 NOT met" in capsys.readouterr().out
    assert read_table(str(out)).size <= 64


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--out", "t.json"], "--out: t.json: must end in .npz, .csv, .txt, .bsdf, .exr"),
        (["--out", "t.npz", "--tolerance", "0"], "--tolerance: must be from 1e-06 to 0.5, got 0"),
        (["--out", "t.npz", "--tolerance", "nan"], "--tolerance: must be from"),
        (["--out", "t.npz", "--largest", "3"], "--largest: must be from 64 to 4000000, got 3"),
        (["--out", "t.npz", "--angles=-95:20"], "--angles: must be between -90 and 90, got -95:20"),
        (["--out", "t.npz", "--angles", "20:10"], "--angles: must be A:B with A not above B"),
        (
            ["--out", "t.npz", "--wavelengths", "0.4:0.7"],
            "--wavelengths: must be from 200 to 20000 nm",
        ),
        (["--out", "none/t.npz"], "none/t.npz: cannot be written: its folder does not exist"),
        (["--out", "t.npz", "--polarization", "x"], "--polarization: invalid choice: 'x'"),
    ],
)
def test_mistakes(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    path = hologram(tmp_path)
    assert main(["bake", str(path), *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == [path]


def test_the_own_table_is_not_written_over(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "table.npz"
    assert main(["bake", str(hologram(tmp_path, efficiency=CONSTANT)), "--out", str(table)]) == 0
    path = hologram(tmp_path, efficiency={"model": "table", "file": "table.npz"})
    assert main(["bake", str(path), "--out", str(table)]) == 2
    assert "it is an input of the same command" in capsys.readouterr().err


def test_ctrl_c_leaves_a_part_to_go_on_from(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = hologram(tmp_path), tmp_path / "table.npz"
    command = ["bake", str(path), "--out", str(out), *FEW]
    assert main(command) == 0
    whole = read_table(str(out)).values
    out.unlink()
    evaluate = NodeSource._evaluated
    calls: list[int] = []

    def interrupted(self: NodeSource, nodes: Any) -> Any:
        calls.append(len(nodes))
        if len(calls) == 3:
            raise KeyboardInterrupt
        return evaluate(self, nodes)

    with monkeypatch.context() as patch:
        patch.setattr(NodeSource, "_evaluated", interrupted)
        assert main(command) == 130
    part = Path(f"{out}.part.npz")
    assert sorted(tmp_path.iterdir()) == [path, part]
    error = capsys.readouterr().err
    assert f"{part} holds what is done, the same call goes on from there" in error
    again: list[int] = []

    def counting(self: NodeSource, nodes: Any) -> Any:
        again.append(len(nodes))
        return evaluate(self, nodes)

    with monkeypatch.context() as patch:
        patch.setattr(NodeSource, "_evaluated", counting)
        assert main(command) == 0
    assert sorted(tmp_path.iterdir()) == [path, out]
    assert np.array_equal(read_table(str(out)).values, whole)
    assert again[0] != calls[0]


def test_polarisations_agree_for_a_scalar_model(tmp_path: Path) -> None:
    path = hologram(tmp_path)
    tables: list[Any] = []
    for polarization in "spu":
        out = tmp_path / f"{polarization}.npz"
        arguments = ["--polarization", polarization, "--out", str(out), *FEW]
        assert main(["bake", str(path), *arguments]) == 0
        tables.append(read_table(str(out)).values)
    assert np.array_equal(tables[0], tables[1])
    assert np.array_equal(tables[0], tables[2])
