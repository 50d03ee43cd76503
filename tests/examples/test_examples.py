# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every example runs from a folder of its own, and its claim holds."""

import json
import re
import runpy
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from hoe_addon.cli.ray_files import read_rays
from hoe_addon.core.media import by_name
from hoe_addon.model.document import load_hologram

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(path.parent for path in ROOT.glob("examples/*/run.py"))
READ_OUT = ROOT / "examples" / "02_read_out_a_hologram"

OPTIONS = {
    "01_two_hologram_ar": ["--samples", "8"],
    "03_three_hologram_ar": ["--samples", "16"],
    "15_artist_tutorial": ["--samples", "8"],
}
"""What makes an example quick; the others are."""

SLOW = {
    "01_two_hologram_ar",
    "03_three_hologram_ar",
    "05_grating_rainbow",
    "06_compact_disc",
    "07_holographic_sight",
    "08_hud_combiner",
    "10_how_much_light",
    "11_accuracy",
    "12_laser_grating",
    "14_script",
    "15_artist_tutorial",
    "16_engineer_tutorial",
}
"""About five to ten seconds even so."""

FEW_RAYS = 64

RESULTS = {
    "01_two_hologram_ar": {
        "luminance.json",
        "metrics.json",
        "view.blend",
        "view.exr",
        "view.png",
    },
    "02_read_out_a_hologram": {"cycles.csv", "numpy.csv"},
    "03_three_hologram_ar": {"numbers.json"},
    "04_point_lens": {"numbers.json"},
    "05_grating_rainbow": {"numbers.json"},
    "06_compact_disc": {"numbers.json"},
    "07_holographic_sight": {"numbers.json"},
    "08_hud_combiner": {"numbers.json"},
    "09_diffractive_achromat": {"numbers.json"},
    "10_how_much_light": {"models.png", "numbers.json"},
    "11_accuracy": {"numbers.json"},
    "12_laser_grating": {"numbers.json"},
    "14_script": {"numbers.json"},
    "15_artist_tutorial": {"numbers.json", "pane.png", "sight.png"},
    "16_engineer_tutorial": {
        "accuracy",
        "check.json",
        "coupler.json",
        "coupler.npz",
        "directions.csv",
        "eyebox",
        "green.csv",
        "guide.json",
        "model.csv",
        "numbers.json",
        "rays.csv",
        "shares.csv",
        "table.csv",
        "table.json",
        "view",
    },
}


def run(folder: Path, out: Path) -> subprocess.CompletedProcess[str]:
    options = ["--out", str(out), *OPTIONS.get(folder.name, [])]
    command = [sys.executable, str(folder / "run.py"), *options]
    return subprocess.run(command, cwd=out.parent, capture_output=True, text=True, check=False)


@pytest.mark.render
@pytest.mark.parametrize(
    "folder",
    [
        pytest.param(
            folder, id=folder.name, marks=[pytest.mark.slow] if folder.name in SLOW else []
        )
        for folder in EXAMPLES
    ],
)
def test_example_runs_and_its_claim_holds(folder: Path, tmp_path: Path) -> None:
    done = run(folder, tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "NOT AS EXPECTED" not in done.stdout
    assert "Traceback" not in done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == RESULTS[folder.name]
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]


@pytest.mark.render
@pytest.mark.slow
def test_pictures_of_the_gallery_are_made_by_its_script(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of them, small."""
    monkeypatch.setattr(sys, "path", list(sys.path))
    gallery = runpy.run_path(str(ROOT / "examples" / "gallery.py"), run_name="gallery")
    for entry in gallery["ENTRIES"]:
        times = gallery["render"](
            entry, tmp_path / entry.preset, ("--size", "32x24", "--samples", "1")
        )
        assert (tmp_path / entry.preset / "view.png").is_file()
        assert times["processor_seconds"] > 0.0


@pytest.mark.render
def test_an_example_fails_where_a_number_is_wrong(tmp_path: Path) -> None:
    """A copy whose expectation is off by a millionth in one direction."""
    copy = tmp_path / "examples" / READ_OUT.name
    copy.mkdir(parents=True)
    for path in READ_OUT.iterdir():
        (copy / path.name).write_bytes(path.read_bytes())
    (tmp_path / "hoe_addon").symlink_to(ROOT / "hoe_addon")
    expected = json.loads((copy / "expected.json").read_text(encoding="utf-8"))
    expected["rays"][1]["index_times_direction"][0] += 1e-6
    (copy / "expected.json").write_text(json.dumps(expected), encoding="utf-8")
    done = run(copy, tmp_path / "out")
    assert done.returncode == 1, done.stdout + done.stderr
    assert done.stdout.count("NOT AS EXPECTED") == 1  # numpy; Cycles has float32


@pytest.mark.parametrize("folder", EXAMPLES, ids=lambda folder: folder.name)
def test_example_has_its_parts(folder: Path) -> None:
    assert re.fullmatch(r"\d\d_[a-z_]+", folder.name)
    readme = (folder / "README.md").read_text(encoding="utf-8")
    assert f"python examples/{folder.name}/run.py" in readme
    assert "## Expected" in readme
    assert "## Limits" in readme
    expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
    assert expected["provenance"]["source"]
    assert expected["tolerance"]


@pytest.mark.parametrize(
    "folder", [folder for folder in EXAMPLES if folder != READ_OUT], ids=lambda folder: folder.name
)
def test_expected_numbers_are_those_that_renew_writes(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of the rays that were published are not made here.

    Of a walk, only what does not depend on its rays: all of them take minutes.
    """
    monkeypatch.setattr(sys, "path", list(sys.path))
    made = runpy.run_path(str(folder / "run.py"), run_name=folder.name)
    expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
    if "EXAMPLE" in made:
        assert made["EXAMPLE"].document() == expected
        return
    document = replace(made["WALK"], rays=FEW_RAYS).document(folder)
    document["provenance"]["rays"] = made["WALK"].rays
    for name in ("provenance", "tolerance"):
        assert document[name] == expected[name]
    for row, wanted in zip(document["pupils"], expected["pupils"], strict=True):
        assert row.keys() == wanted.keys()
        assert row["position_mm"] == wanted["position_mm"]


def test_expected_luminances_stand_in_the_readme() -> None:
    folder = ROOT / "examples" / "01_two_hologram_ar"
    readme = (folder / "README.md").read_text(encoding="utf-8")
    expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
    for row in expected["pupils"]:
        assert f"| {row['position_mm'][0]} | {row['mean_cd_m2']} |" in readme


def test_expected_rays_are_the_published_ones() -> None:
    """The example is whole in itself; here its copies are held against the originals."""
    tests = ROOT / "tests"
    lens = json.loads((tests / "documents" / "lens.json").read_text(encoding="utf-8"))
    assert json.loads((READ_OUT / "lens.json").read_text(encoding="utf-8")) == lens
    published = json.loads((tests / "reference" / "grating_rays.json").read_text(encoding="utf-8"))
    rows = published["two_point"]["rows"]
    expected = json.loads((READ_OUT / "expected.json").read_text(encoding="utf-8"))
    rays = read_rays(READ_OUT / "rays.csv")
    assert load_hologram(READ_OUT / "lens.json").media.front == "N-BK7"
    for ray, wanted, row in zip(rays, expected["rays"], [*rows, *rows], strict=True):
        *start, along_x, along_y, along_z, wavelength_nm, order, side = ray
        assert wanted["index_times_direction"] == row["out"][:2]
        assert (wavelength_nm, order) == (row["wavelength_nm"], 1)
        steps = -start[2] / along_z
        hit = [start[0] + steps * along_x, start[1] + steps * along_y, 0.0]
        assert hit == pytest.approx(row["point_mm"], abs=1e-12)
        glass = float(by_name("N-BK7").index(wavelength_nm * 1e-9))
        assert wanted["index"] == pytest.approx(glass if side == "T" else 1.0, abs=1e-11)
