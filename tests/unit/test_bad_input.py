# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input through the command line: one clear line, exit code 2, nothing written."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from hoe_addon import files as output
from hoe_addon.cli import COMMANDS, main
from hoe_addon.files import OutputError, replacing, writable_folder

LENS = Path(__file__).parents[1] / "documents" / "lens.json"
HEADER = "x_mm,y_mm,z_mm,l,m,n,wavelength_nm,order,side"
GOOD = "0,0,-1,0,0,1,532,1,T"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a good hologram and good rays."""
    (tmp_path / "a.json").write_bytes(LENS.read_bytes())
    (tmp_path / "rays.csv").write_text(f"{HEADER}\n{GOOD}\n", encoding="utf-8")
    return tmp_path


def refused(folder: Path, capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """Run a command that must fail, and return its one line; nothing may have been written."""
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(arguments) == 2
    after = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert after == before
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("hoe: error: ")
    assert printed.err.count("\n") == 1
    assert printed.err.endswith("\n")
    return printed.err.removeprefix("hoe: error: ").rstrip("\n")


def efficiency(folder: Path, hologram: str = "a.json") -> list[str]:
    out = str(folder / "out.csv")
    return ["efficiency", str(folder / hologram), "--wavelengths=532", "--orders=0:1", "--out", out]


def trace(folder: Path, rays: str = "rays.csv") -> list[str]:
    out = str(folder / "out.csv")
    return ["trace", str(folder / "a.json"), str(folder / rays), "--out", out]


def edit(folder: Path, path: str, value: Any) -> None:
    document = json.loads(LENS.read_text(encoding="utf-8"))
    here = document
    *parents, last = path.split(".")
    for step in parents:
        here = here[step]
    here[last] = value
    (folder / "a.json").write_text(json.dumps(document), encoding="utf-8")


TOO_MUCH = {"model": "constant", "table": {"T": {"0": 0.8, "1": 0.3}}}

HOLOGRAMS = {
    "unknown field": ("recording.colour", 1, r"recording\.colour: is not a field here \(known: w"),
    "wrong type": (
        "efficiency.levels",
        "8",
        r'efficiency\.levels: must be a whole number, got "8"',
    ),
    "not a number": ("media.back", float("nan"), r"media\.back: must be a finite number, got NaN"),
    "infinite": ("media.back", float("inf"), r"media\.back: must be a finite number, got Infinity"),
    "short wavelength": (
        "recording.wavelength_nm",
        199,
        r"recording\.wavelength_nm: must be from 200 to 20000 nm, got 199",
    ),
    "long wavelength": (
        "efficiency.design_wavelength_nm",
        20001,
        r"efficiency\.design_wavelength_nm: must be from 200 to 20000 nm, got 20001",
    ),
    "zero-length direction": (
        "recording.reference.direction",
        [0, 0, 0],
        r"recording\.reference\.direction: must not have zero length, got \[0, 0, 0\]",
    ),
    "source on the surface": (
        "recording.object.position_mm",
        [10, 5, 0],
        r"recording\.object\.position_mm: must not lie on the surface, got \[10, 5, 0\]",
    ),
    "index below 1": ("media.back", 0.99, r"media\.back: must be at least 1, got 0\.99"),
    "wave's index below 1": (
        "recording.object.index",
        0,
        r"recording\.object\.index: must be at least 1, got 0",
    ),
    "levels 1": ("efficiency.levels", 1, r"efficiency\.levels: must be 0 .* at least 2, got 1"),
    "negative levels": ("efficiency.levels", -2, r"efficiency\.levels: must be from 0 .*, got -2"),
    "sum above 1": ("efficiency", TOO_MUCH, r"efficiency\.table: .* sum to at most 1, got 1\.1"),
}


@pytest.mark.parametrize("case", HOLOGRAMS)
@pytest.mark.parametrize("command", [efficiency, trace])
def test_bad_hologram(
    folder: Path, capsys: pytest.CaptureFixture[str], case: str, command: Any
) -> None:
    path, value, message = HOLOGRAMS[case]
    edit(folder, path, value)
    line = refused(folder, capsys, *command(folder))
    assert re.fullmatch(f"{re.escape(str(folder / 'a.json'))}: {message}.*", line)


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("none.json", None, "cannot be read: No such file or directory"),
        ("empty.json", b"", "line 1 column 1: is not valid JSON: Expecting value"),
        ("binary.json", bytes(range(256)), "cannot be read: not UTF-8 text at byte 128"),
        ("deep.json", b"[" * 100_000, "is nested deeper than 64 levels"),
        ("lines.json", b'{"schema": 1, "a\\nb": 1}', "a b: is not a field here"),
    ],
)
def test_unreadable_hologram(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    name: str,
    data: bytes | None,
    message: str,
) -> None:
    if data is not None:
        (folder / name).write_bytes(data)
    line = refused(folder, capsys, *efficiency(folder, name))
    assert line.startswith(f"{folder / name}: {message}")


def test_a_folder_is_no_hologram(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "sub").mkdir()
    line = refused(folder, capsys, *efficiency(folder, "sub"))
    assert line == f"{folder / 'sub'}: cannot be read: Is a directory"


RAYS = {
    "missing": (None, "cannot be read: No such file or directory"),
    "empty": (b"", "line 1: must name the columns x_mm,y_mm,"),
    "binary": (b"\xff\xfe\x00", "cannot be read: not UTF-8 text at byte 0"),
    "lost column": (b"x_mm,y_mm\n1,2\n", "line 1: column z_mm is missing, got"),
    "double column": (f"{HEADER},l\n".encode(), "line 1: column l stands twice, got"),
    "unknown column": (f"{HEADER},id\n".encode(), "line 1: must name only x_mm,"),
    "short row": (f"{HEADER}\n{GOOD}\n1,2,3\n".encode(), "line 3: must have 9 values, got 3"),
    "long row": (f"{HEADER}\n{GOOD},1\n".encode(), "line 2: must have 9 values, got 10"),
    "no number": (
        f"{HEADER}\n0,0,x,0,0,1,532,1,T\n".encode(),
        'line 2, column z_mm: must be a finite number, got "x"',
    ),
    "not finite": (
        f"{HEADER}\n0,0,0,0,nan,1,532,1,T\n".encode(),
        'line 2, column m: must be a finite number, got "nan"',
    ),
    "underscore": (
        f"{HEADER}\n0,0,0,0,0,1_0,532,1,T\n".encode(),
        'line 2, column n: must be a finite number, got "1_0"',
    ),
    "zero-length direction": (
        f"{HEADER}\n0,0,-1,0,0,-0.0,532,1,T\n".encode(),
        "line 2, columns l,m,n: must not have zero length, got [0, 0, -0.0]",
    ),
    "wavelength": (
        f"{HEADER}\n{GOOD}\n0,0,-1,0,0,1,100,1,T\n".encode(),
        "line 3, column wavelength_nm: must be from 200 to 20000 nm, got 100",
    ),
    "order": (
        f"{HEADER}\n0,0,-1,0,0,1,532,1.5,T\n".encode(),
        'line 2, column order: must be a whole number from -100 to 100, got "1.5"',
    ),
    "side": (f"{HEADER}\n0,0,-1,0,0,1,532,1,X\n".encode(), "line 2, column side: must be T or R,"),
    "quote": (f'{HEADER}\n0,"0,-1,0,0,1,532,1,T\n'.encode(), "line 2: is not valid CSV: "),
}


@pytest.mark.parametrize("case", RAYS)
def test_bad_rays(folder: Path, capsys: pytest.CaptureFixture[str], case: str) -> None:
    data, message = RAYS[case]
    if data is not None:
        (folder / "bad.csv").write_bytes(data)
    line = refused(folder, capsys, *trace(folder, "bad.csv"))
    assert line.startswith(f"{folder / 'bad.csv'}: {message}")


@pytest.mark.parametrize("command", [efficiency, trace])
def test_unwritable_place(folder: Path, capsys: pytest.CaptureFixture[str], command: Any) -> None:
    for out, why in (
        (folder / "lost" / "out.csv", "No such file or directory"),
        (folder / "a.json" / "out.csv", "Not a directory"),
        (folder, "not a regular file"),
    ):
        line = refused(folder, capsys, *command(folder), "--out", str(out))
        assert line == f"{out}: cannot be written: {why}"


def test_a_folder_without_permission_is_refused(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def forbidden(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    # An administrator may write anywhere, so the refusal is played.
    monkeypatch.setattr(output.Path, "open", forbidden)
    with pytest.raises(OutputError, match="cannot be written: Permission denied"):
        writable_folder(folder)
    with (
        pytest.raises(OutputError, match="cannot be written: Permission denied"),
        replacing(folder / "out.csv"),
    ):
        pass


def test_output_folders_are_made_or_refused(folder: Path) -> None:
    assert writable_folder(folder / "new" / "deep").is_dir()
    with pytest.raises(OutputError, match="cannot be written"):
        writable_folder(folder / "a.json")


def test_a_failure_on_the_way_keeps_the_old_file(folder: Path) -> None:
    out = folder / "out.csv"
    out.write_text("old", encoding="utf-8")
    before = sorted(folder.iterdir())
    with pytest.raises(RuntimeError), replacing(out) as temporary:
        temporary.write_text("half", encoding="utf-8")
        raise RuntimeError
    assert out.read_text(encoding="utf-8") == "old"
    assert sorted(folder.iterdir()) == before


OPTIONS = {
    "no command": (
        [],
        f"COMMAND: is missing, must be one of {', '.join(COMMANDS)}",
    ),
    "unknown command": (["paint"], "COMMAND: invalid choice: 'paint'"),
    "no list": (
        ["efficiency", "a.json", "--out", "b", "--orders=0"],
        "the following arguments are",
    ),
    "bad list": (["efficiency", "a.json", "--wavelengths=1:2"], "--wavelengths: must be A:B:STEP"),
    "bad orders": (["efficiency", "a.json", "--orders=2:1"], "--orders: must be A:B with A not ab"),
    "bad engine": (
        ["trace", "a", "b", "--out=c", "--engine=gpu"],
        "--engine: invalid choice: 'gpu'",
    ),
    "unknown option": (["presets", "--all"], "unrecognized arguments: --all"),
    "line break": (["paint\nred"], "COMMAND: invalid choice: 'paint"),
}


@pytest.mark.parametrize("case", OPTIONS)
def test_bad_options(folder: Path, capsys: pytest.CaptureFixture[str], case: str) -> None:
    arguments, message = OPTIONS[case]
    assert refused(folder, capsys, *arguments).startswith(message)


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("--wavelengths=100", "--wavelengths: must be from 200 to 20000 nm, got 100"),
        ("--theta=90", "--theta: must be between -90 and 90, got 90.0"),
        ("--from=side", "--from: invalid choice: 'side'"),
    ],
)
def test_bad_values_of_options(
    folder: Path, capsys: pytest.CaptureFixture[str], option: str, message: str
) -> None:
    assert refused(folder, capsys, *efficiency(folder), option).startswith(message)


def test_ctrl_c_leaves_one_line_and_no_file(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("hoe_addon.model.evaluate.trace", stop)
    before = sorted(folder.iterdir())
    assert main(trace(folder)) == 130
    assert sorted(folder.iterdir()) == before
    assert (
        capsys.readouterr().err == "hoe: error: stopped by the user; no unfinished file is left\n"
    )
