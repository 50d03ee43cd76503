# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of studies: shown, kept in the file, and called old when the device has changed."""

from pathlib import Path
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document.held import document_of
from hoe_addon.blender.ids import DeviceKind
from hoe_addon.blender.job_files import JobKind
from hoe_addon.model.document import load_device
from hoe_addon.ui.facts import study
from hoe_addon.ui.facts.device import plan_digest
from hoe_addon.ui.facts.scenes import DEVICE_FACTS
from hoe_addon.ui.facts.study import accuracy_of, eyebox_of, keep_result
from hoe_addon.ui.ids import Op
from tests.ui.layouts import Drawn, draw

REPORT: dict[str, Any] = {
    "grid": [2, 2],
    "eyebox_uniformity": 0.25,
    "field_samples": 512,
    "positions": [
        {
            "row": row,
            "column": column,
            "mean_cd_m2": 100.0 * (1 + column + 2 * row),
            "standard_error_cd_m2": 1.0 + column + 2 * row,
            "uniformity": 0.5 - 0.1 * row,
            "u_prime": 0.2 + 0.03 * row,
            "v_prime": 0.4 + 0.04 * row,
        }
        for row in (1, 0)
        for column in (0, 1)
    ],
}

OLD = "The device has changed since the last result"


@pytest.fixture
def guide(registered: Any) -> Any:
    """A light guide, without its room, in the window."""
    spec = load_device("two_hologram_ar")
    scene = add_scene(replace(spec, room=replace(spec.room, kind="none")))
    bpy.context.window.scene = scene
    DEVICE_FACTS.update_now(scene)
    return scene


def drawn(name: str) -> Drawn:
    found = draw(getattr(bpy.types, f"HOE_PT_{name}_sidebar"))
    assert found is not None
    return found


def keep(scene: Any, report: dict[str, Any] = REPORT) -> None:
    result = {"report": report, "folder": "renders/eyebox"}
    keep_result(scene, JobKind.EYEBOX, result, plan_digest(document_of(scene)))


def test_last_eyebox_study_is_shown(guide: Any) -> None:
    assert "Last result" not in drawn("study_eyebox").words()
    keep(guide)
    words = drawn("study_eyebox").words()
    assert "400 ± 4 cd/m²" in words
    assert "100 ± 1 cd/m²" in words
    assert "25 % min/max" in words
    assert "40 %, worst pupil" in words
    assert "0.050 largest delta u'v'" in words
    assert "100 200 300 400" in words
    assert "renders/eyebox" in words
    assert OLD not in words


def test_errors_of_uniformities_are_shown(guide: Any) -> None:
    """Results of older versions, as above, are read without them."""
    positions = [{**each, "uniformity_standard_error": 0.03} for each in REPORT["positions"]]
    keep(guide, {**REPORT, "eyebox_uniformity_standard_error": 0.01, "positions": positions})
    words = drawn("study_eyebox").words()
    assert "25 ± 1 % min/max" in words
    assert "40 ± 3 %, worst pupil" in words


def test_accuracy_is_shown(guide: Any) -> None:
    result = {"words": "5 settings measured", "page": "renders/accuracy.html"}
    keep_result(guide, JobKind.ACCURACY, result, plan_digest(document_of(guide)))
    words = drawn("study_accuracy").words()
    assert "5 settings measured" in words
    assert "renders/accuracy.html" in words
    assert OLD not in words


def test_result_of_another_device_is_called_so(guide: Any) -> None:
    keep(guide)
    guide.cycles.samples += 10
    DEVICE_FACTS.update_now(guide)
    assert OLD not in drawn("study_eyebox").words(), "samples do not change the device"
    guide.hologram.guide.thickness_mm += 0.1
    DEVICE_FACTS.update_now(guide)
    assert OLD in drawn("study_eyebox").words()


def test_results_are_saved_with_the_file(guide: Any, tmp_path: Path) -> None:
    keep(guide)
    name, shown = guide.name, eyebox_of(guide)
    path = str(tmp_path / "kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert eyebox_of(bpy.data.scenes[name]) == shown is not None


@pytest.mark.parametrize("text", ["[", "{}", "7", '{"report": 3}', "[" * 5000, "\x00"])
def test_text_of_a_stranger_is_no_result(guide: Any, text: str) -> None:
    guide.hologram.eyebox_result = guide.hologram.accuracy_result = text
    assert eyebox_of(guide) is None
    assert accuracy_of(guide) is None
    drawn("study_eyebox")


def test_wide_grid_stays_out_of_the_panel(guide: Any) -> None:
    keep(guide, {**REPORT, "grid": [40, 1]})
    facts = eyebox_of(guide)
    assert facts is not None
    assert facts.rows == ()


def test_black_display_has_no_colour(guide: Any) -> None:
    black = [{**each, "u_prime": None, "v_prime": None} for each in REPORT["positions"]]
    keep(guide, {**REPORT, "positions": black})
    facts = eyebox_of(guide)
    assert facts is not None
    assert not any(line.label == "Colour" for line in facts.lines)


def test_eyebox_is_for_light_guides(guide: Any) -> None:
    guide.hologram.kind = DeviceKind.SCENE
    assert draw(bpy.types.HOE_PT_study_eyebox_sidebar) is None
    assert Op.ACCURACY in drawn("study_accuracy").operators()


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (187.04, 0.21, "187.0 ± 0.2"),
        (19.871, 0.0387, "19.87 ± 0.04"),
        (400.0, 4.0, "400 ± 4"),
        (1234.5, 37.0, "1234 ± 37"),
        (9.99, 0.0961, "10.0 ± 0.1"),
        (10.66, None, "10.7"),
        (0.0, 0.0, "0"),
    ],
)
def test_number_and_error_have_the_same_digits(
    value: float, error: float | None, words: str
) -> None:
    assert study._with_error(value, error) == words
