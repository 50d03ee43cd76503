# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line as a whole: help, version, presets, and how light it is to start."""

import subprocess
import sys
from pathlib import Path

import pytest

from hoe_addon.cli import COMMANDS, main
from hoe_addon.resources import preset_paths, version

ROOT = Path(__file__).parents[2]
HEAVY = ("numpy", "msgspec", "bpy", "tqdm")


@pytest.mark.parametrize("arguments", [[], *([name] for name in COMMANDS)])
def test_help(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*arguments, "--help"]) == 0
    printed = capsys.readouterr()
    assert printed.out.startswith("usage: python -m hoe_addon")
    assert printed.err == ""


@pytest.mark.parametrize(
    ("command", "texts"),
    [
        ("render", ["pixels of a picture (default: of the document)", "at most this: 0.1 is 10 %"]),
        ("render", ["per pixel (default: of the document)", "so long by the wall clock"]),
        ("render", ["same picture (default: of the document)", "less time (default: of the"]),
        ("eyebox", ["positions along x and y (default: of", "y in mm (default: of"]),
        ("demo", ["(default: out/demo)"]),
        ("bake", ["nm, two ends without a step, default 380:780"]),
        ("efficiency", ["nm, A:B:STEP (B included) or a,b,c"]),
    ],
)
def test_help_tells_units_and_defaults(
    command: str, texts: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert [text for text in texts if text not in printed] == []


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"{version()}\n"


def test_presets_have_one_line_each(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["presets"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(preset_paths())
    assert all(len(line.split()) > 1 for line in lines)


def test_start_imports_nothing_heavy() -> None:
    code = (
        "import sys; from hoe_addon.cli import main; main(['--help']); "
        f"print([name for name in {HEAVY} if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == "[]"
