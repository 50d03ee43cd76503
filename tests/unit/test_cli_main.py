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
    assert printed.out.startswith("usage: hoe")
    assert printed.err == ""


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
