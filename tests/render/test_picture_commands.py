# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands with pictures: what they refuse, and how they stop."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from hoe_addon.cli import main

pytestmark = pytest.mark.render

PRESET = "two_hologram_ar"
ROOT = Path(__file__).resolve().parents[2]

PNG_START = b"\x89PNG\r\n\x1a\n" + bytes(64)


def _refused(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("hoe: error: ")
    assert said.err.count("\n") == 1
    return said.err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--size", "0x0"], "--size"),
        (["--size", "640"], "--size: must be two whole numbers"),
        (["--samples", "0"], "render.samples: must be from 1 to 1000000, got 0"),
        (["--seed", "-1"], "render.seed: must be from 0 to 2147483647, got -1"),
        (["--set", "guide.colour=1"], "guide.colour: no such field"),
        (["--set", "display.image=none.png"], "display.image: must be chart, white, dots,"),
        (["--set", f"display.image={'x' * 300}"], "display.image: must be chart, white, dots,"),
        (["--set", "eye.position_mm=[0,0,-100]"], "eye.position_mm[2]: must lie before the guide"),
        (["--set", "guide.thickness_mm=1e300"], "guide.thickness_mm: must be at most"),
    ],
)
def test_bad_options_leave_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    out = tmp_path / "out"
    assert message in _refused(["render", PRESET, "--out", str(out), *options], capsys)
    assert not out.exists()


@pytest.mark.parametrize("content", [b"", b"no picture", PNG_START], ids=["empty", "text", "cut"])
def test_display_image_that_is_no_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes
) -> None:
    picture, out = tmp_path / "photo.png", tmp_path / "out"
    picture.write_bytes(content)
    arguments = ["render", PRESET, "--out", str(out), "--set", f"display.image={picture}"]
    assert "display.image: must be a picture that can be read" in _refused(arguments, capsys)
    assert not out.exists()


@pytest.mark.parametrize("command", ["render", "eyebox"])
def test_folder_that_cannot_be_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str
) -> None:
    (tmp_path / "file").touch()
    arguments = [command, PRESET, "--out", str(tmp_path / "file" / "out")]
    assert "cannot be written" in _refused(arguments, capsys)


@pytest.mark.parametrize(("command", "name"), [("render", "view.png"), ("eyebox", "eyebox.json")])
def test_results_whose_name_is_taken_by_a_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str, name: str
) -> None:
    (tmp_path / name).mkdir()
    error = _refused([command, PRESET, "--out", str(tmp_path)], capsys)
    assert f"{name}: cannot be written: not a regular file" in error
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("samples", ["3", "99999999999"])
def test_field_samples_out_of_range(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], samples: str
) -> None:
    arguments = ["eyebox", PRESET, "--out", str(tmp_path / "out"), "--field-samples", samples]
    assert "--field-samples: must be from 4" in _refused(arguments, capsys)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("seconds", [0.6, 8.0], ids=["while loading", "while rendering"])
def test_ctrl_c_is_heard_at_once(tmp_path: Path, seconds: float) -> None:
    """A real signal in a real process, in the middle of Blender's C code."""
    command = [sys.executable, "-m", "hoe_addon", "render", PRESET, "--out", str(tmp_path / "out")]
    process = subprocess.Popen(
        [*command, "--samples", "4096"],
        cwd=ROOT,
        # This test's own Blender has set OCIO, which another one would speak of.
        env={name: value for name, value in os.environ.items() if name != "OCIO"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(seconds)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=20)
    assert process.returncode == 130
    assert out == ""
    assert err == "hoe: error: stopped by the user; no unfinished file is left\n"
    assert not (tmp_path / "out").exists() or list((tmp_path / "out").iterdir()) == []
