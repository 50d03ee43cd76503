# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The presets' numbers, by formulas and by rays in numpy."""

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.document import load_device
from hoe_addon.model.pattern import pattern_of
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_view import chief_ray, image_distance_mm, pass_hologram

EXAMPLES = Path(__file__).parents[2] / "examples"

CLOSED_FORMS = [
    "04_point_lens",
    "05_grating_rainbow",
    "06_compact_disc",
    "07_holographic_sight",
    "08_hud_combiner",
    "09_diffractive_achromat",
    "12_laser_grating",
]

ROUNDING = 1e-12


def program(folder: str) -> ModuleType:
    """The example's program, not run; it imports Blender."""
    pytest.importorskip("bpy")
    spec = importlib.util.spec_from_file_location(folder, EXAMPLES / folder / "run.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    kept = list(sys.path)
    spec.loader.exec_module(module)
    sys.path[:] = kept
    return module


def scene(name: str, *changes: str) -> SceneSpec:
    spec = load_device(name, changes)
    assert isinstance(spec, SceneSpec)
    return spec


@pytest.mark.parametrize("folder", CLOSED_FORMS)
def test_expected_numbers_are_those_of_the_formula(folder: str) -> None:
    expected = json.loads((EXAMPLES / folder / "expected.json").read_text(encoding="utf-8"))
    assert expected["numbers"] == program(folder).expected_numbers()


@pytest.mark.parametrize("folder", CLOSED_FORMS)
def test_expected_numbers_stand_in_the_readme(folder: str) -> None:
    expected = json.loads((EXAMPLES / folder / "expected.json").read_text(encoding="utf-8"))
    readme = (EXAMPLES / folder / "README.md").read_text(encoding="utf-8")
    for row in expected["numbers"]:
        assert f"| {row['value']} |" in readme


class TestThreeHolograms:
    """In-coupler, expander and out-coupler bring every direction and colour back."""

    CRITICAL, STEEPEST_DEG = 1.0, 75.0

    def guide(self) -> LightGuideSpec:
        spec = load_device("three_hologram_ar")
        assert isinstance(spec, LightGuideSpec)
        return spec

    def grating_vectors(self) -> np.ndarray:
        """In mm^-1 times 1e-3, x and y, shape (3, 2)."""
        rows = []
        for patch in self.guide().holograms:
            pattern = pattern_from(pattern_of(patch))
            rows.append(pattern.gradient(np.zeros(3))[:2] / pattern.wavelength)
        return np.array(rows)

    def test_grating_vectors_sum_to_zero(self) -> None:
        vectors = self.grating_vectors()
        scale = np.abs(vectors).max()
        np.testing.assert_allclose(vectors.sum(axis=0), 0.0, atol=ROUNDING * scale)

    def test_periods(self) -> None:
        periods_nm = 1e9 / np.linalg.norm(self.grating_vectors(), axis=1)
        np.testing.assert_allclose(periods_nm, (398.0, 398.0 / np.sqrt(2.0), 398.0), rtol=1e-6)

    @pytest.mark.parametrize("wavelength_nm", [465.0, 532.0, 625.0])
    def test_whole_field_is_guided(self, wavelength_nm: float) -> None:
        guide = self.guide()
        half = np.asarray(guide.display.size_mm) / (2.0 * guide.lens.focal_length_mm)
        x, y = np.meshgrid(np.linspace(-1, 1, 21) * half[0], np.linspace(-1, 1, 21) * half[1])
        field = np.stack((x, y), axis=-1) / np.sqrt(1.0 + x**2 + y**2)[..., None]
        first, turn, _ = wavelength_nm * 1e-9 * self.grating_vectors()
        assert isinstance(guide.guide.medium, float | int)
        steepest = guide.guide.medium * np.sin(np.radians(self.STEEPEST_DEG))
        for inside in (field + first, field + first + turn):
            size = np.linalg.norm(inside, axis=-1)
            assert size.min() > self.CRITICAL
            assert size.max() < steepest


@pytest.mark.parametrize("wavelength_nm", [460.0, 532.0, 630.0])
def test_focal_length_goes_as_one_over_wavelength(wavelength_nm: float) -> None:
    """Near the axis, where the closed form is exact."""
    height = 1e-3
    lens = scene("point_lens").hologram("lens")
    start = np.array([[height, 0.0, -400.0]])
    hit, onward = pass_hologram(lens, start, [[0.0, 0.0, 1.0]], wavelength_nm, 1)
    focal = -hit[0, 0] * onward[0, 2] / onward[0, 0]
    assert focal == pytest.approx(100.0 * 532.0 / wavelength_nm, rel=1e-8)


@pytest.mark.parametrize("up_mm", [-4.0, 0.0, 4.0])
def test_reticle_is_at_50_m_from_anywhere(up_mm: float) -> None:
    sight = scene("holographic_sight")
    pupils = [(-6.0, up_mm, 0.0), (6.0, up_mm, 0.0)]
    seen = [chief_ray(sight, "window", "reticle", pupil, 640.0) for pupil in pupils]
    assert image_distance_mm(pupils, seen) == pytest.approx(50_220.0, rel=1e-6)


def test_reticle_moves_with_the_laser() -> None:
    """Half a nanometre of drift moves it by sin(30 deg) / 640 per nm."""
    sight = scene("holographic_sight")
    still, moved = (
        chief_ray(sight, "window", "reticle", (0.0, 0.0, 0.0), nm) for nm in (640.0, 640.5)
    )
    sine = 55.0 / np.hypot(55.0, 95.0)
    assert abs(moved[1] - still[1]) == pytest.approx(sine * 0.5 / 640.0, rel=0.02)


def test_no_ray_through_a_window_that_is_not_there() -> None:
    sight = scene("holographic_sight", "elements.window.position_mm=[0, 0, 220]")
    with pytest.raises(SpecError, match="reticle: no ray from the pupil gets there through window"):
        chief_ray(sight, "window", "reticle", (0.0, 0.0, 0.0), 640.0)


@pytest.mark.filterwarnings("error")
def test_no_ray_is_aimed_at_what_stands_beside_the_pupil() -> None:
    sight = load_device("holographic_sight")
    assert isinstance(sight, SceneSpec)
    beside = (100.0, 0.0, sight.hologram("window").position_mm[2])
    with pytest.raises(SpecError):
        chief_ray(sight, "window", "reticle", beside, 640.0)
