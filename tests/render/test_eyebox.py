# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nine luminances: backward in Cycles and forward from the display in numpy."""

import json
from pathlib import Path

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.pictures.eyebox import fields_at
from hoe_addon.cli import main
from hoe_addon.core.photometry import measure
from hoe_addon.model.device_walk import eyebox_luminance
from hoe_addon.model.document import find_device, load_device
from hoe_addon.model.eyebox import pupil_positions

pytestmark = [pytest.mark.render]

PRESET = "two_hologram_ar"

AGREEMENT = 0.05
"""What is promised; both engines' standard errors are below a fifth of it, as is checked."""


@pytest.mark.slow
def test_nine_luminances_agree_with_a_forward_walk(clean_scene: bpy.types.Scene) -> None:
    spec = load_device(PRESET)
    device = build_device(clean_scene, spec, find_device(PRESET).parent)
    positions = list(pupil_positions(spec))
    cycles = fields_at(device, positions, 512)
    walk = eyebox_luminance(spec, [place.centre_mm for place in positions], rays=400_000)
    found = np.array([field.mean_cd_m2 for field in cycles])
    errors = np.array([field.standard_error_cd_m2 for field in cycles])
    assert np.all(errors < AGREEMENT / 5 * found)
    assert np.all(walk.error_cd_m2 < AGREEMENT / 5 * walk.mean_cd_m2)
    np.testing.assert_allclose(found, walk.mean_cd_m2, rtol=AGREEMENT)
    colours = np.array([(field.u_prime, field.v_prime) for field in cycles])
    np.testing.assert_allclose(colours, walk.uv_prime, atol=5e-3)
    # The far end is darker: one nearer pupil is brighter in every row.
    rows = found.reshape(3, 3)
    assert np.all(np.diff(rows, axis=1) > 0.0)
    assert np.all(rows[:, 0] < 0.2 * rows[:, 2])


def test_command_writes_sheet_numbers_and_views(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--size", "32x24", "--samples", "2", "--field-samples", "8", "--no-denoise"]
    changes = ["--grid", "2x1", "--pitch-mm", "8,2", "--set", "room.kind=none"]
    assert main(["eyebox", PRESET, "--out", str(tmp_path), *options, *changes]) == 0
    report = json.loads((tmp_path / "eyebox.json").read_text())
    assert report["grid"] == [2, 1]
    assert [position["pupil_mm"] for position in report["positions"]] == [[-4, 0, 0], [4, 0, 0]]
    for position in report["positions"]:
        for name in ("standard_error_cd_m2", "min_standard_error_cd_m2"):
            assert position[name] > 0.0
        assert position["uniformity_standard_error"] > 0.0
        assert position["min_cd_m2"] + 1e-9 > 0.0
        assert position["min_cd_m2"] <= position["mean_cd_m2"] <= position["max_cd_m2"]
    assert report["eyebox_uniformity_standard_error"] > 0.0
    said = capsys.readouterr().out
    assert f"{report['eyebox_uniformity']:.3f} +- " in said
    assert "noisy, use more field samples" in said
    names = {path.name for path in (tmp_path / "views").iterdir()}
    assert names == {f"row1_column{n}.{kind}" for n in (1, 2) for kind in ("exr", "png")}
    assert (tmp_path / "eyebox.png").stat().st_size > 1000
    assert {path.name for path in tmp_path.iterdir()} == {"eyebox.json", "eyebox.png", "views"}


def test_measure_of_a_known_picture() -> None:
    pixels = np.zeros((2, 2, 3), dtype=np.float32)
    pixels[0] = 1.0
    found = measure(pixels, 100.0)
    assert found.mean_cd_m2 == pytest.approx(50.0)
    assert (found.min_cd_m2, found.peak_cd_m2) == pytest.approx((0.0, 100.0))
    assert (found.u_prime, found.v_prime) == pytest.approx((0.1978, 0.4683), abs=2e-4)  # D65
