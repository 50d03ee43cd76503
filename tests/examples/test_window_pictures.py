# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of the window pictures run as far as they go without a window."""

import os
import re
import subprocess
import sys
from collections.abc import Collection, Iterable
from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
import pytest

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "13_window"
SHARED = {"make_blends", "shrink", "window"}
SCRIPTS = sorted({path.stem for path in FOLDER.glob("*.py")} - SHARED)
OF_THE_LENS = ("add_menu", "material", "overlay_lens")
PICTURES = sorted(FOLDER.glob("*.png"))
MOST_BYTES = 300_000
LEAST_CONTRAST = 128
"""Between the darkest and the brightest byte of a picture that shows something."""

RUN = """
import runpy
import sys
folder, blends, presets, *scripts = sys.argv[1:]
make_blends = runpy.run_path(f"{folder}/make_blends.py")
make_blends["main"](["--out", blends, *presets.split()])
for name in scripts:
    runpy.run_path(f"{folder}/{name}.py", run_name="__main__")
    print("done:", name)
"""


def run(folder: Path, presets: Iterable[str], scripts: Collection[str], scale: int = 1) -> None:
    done = subprocess.run(
        [sys.executable, "-c", RUN, str(FOLDER), str(folder), " ".join(presets), *scripts],
        env={
            **os.environ,
            "HOE_WINDOW": str(folder),
            "HOE_SCALE": str(scale),
            "HOE_THEME": "light",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "Traceback" not in said, said
    assert done.stdout.count("done:") == len(scripts)


def test_scripts_of_the_lens_run(tmp_path: Path) -> None:
    run(tmp_path, ["point_lens"], OF_THE_LENS)


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1, 2])
def test_all_scripts_run(tmp_path: Path, scale: int) -> None:
    run(tmp_path, [], SCRIPTS, scale)


def test_every_script_has_its_picture_and_its_words() -> None:
    readme = (FOLDER / "README.md").read_text(encoding="utf-8")
    for name in SCRIPTS:
        assert any(path.stem.startswith(f"{name}_") for path in PICTURES), name
    shown = set(re.findall(r"\]\((\w+\.png)\)", readme))
    assert shown == {path.name for path in PICTURES}


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.name)
def test_pictures_are_whole_windows_and_small_files(path: Path) -> None:
    assert path.stat().st_size < MOST_BYTES
    picture = oiio.ImageBuf(str(path))
    assert (picture.spec().width, picture.spec().height) == (1600, 1000)
    assert np.ptp(picture.get_pixels(oiio.UINT8)) > LEAST_CONTRAST, "it is empty"
