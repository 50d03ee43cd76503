# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines over the 3-D view, before they get to the graphics card: they are where the light is."""

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.arrays import unit
from hoe_addon.core.units import mm_to_m
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.document import load_device
from hoe_addon.model.motion import to_wave
from hoe_addon.model.optical_system import SystemWaveSpec
from hoe_addon.model.recording import RecordingSpec
from hoe_addon.model.surface import ConicSurface, PlaneSurface
from hoe_addon.model.waves import AstigmaticSpec, WindowSourceSpec
from hoe_addon.resources import preset_paths
from hoe_addon.ui.overlay import colours, document, foci, optics
from hoe_addon.ui.overlay.aims import aims_of
from hoe_addon.ui.overlay.document import Density, Kind, drawing_of
from hoe_addon.ui.overlay.lines import Lines, arrow_heads, circle, star
from hoe_addon.ui.overlay.sources import source_lines

ROOT = Path(__file__).parents[2]
WAVES: dict[str, Any] = json.loads(
    (ROOT / "tests" / "documents" / "waves.json").read_text(encoding="utf-8")
)
SYSTEM = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [1, 0, -120]},
    "surfaces": [
        {"shape": "sphere", "vertex_mm": [0, 0, -62], "radius_mm": 40, "semi_diameter_mm": 18}
        | {"medium": 1.52},
        {"shape": "sphere", "vertex_mm": [0, 0, -55], "radius_mm": -60, "semi_diameter_mm": 18}
        | {"medium": 1.0},
    ],
}
MIRROR = {
    "kind": "system",
    "source": {"kind": "plane", "direction": [0, 0, -1]},
    "surfaces": [
        {"shape": "conic", "vertex_mm": [0, 0, -60], "radius_mm": 300, "conic": -1}
        | {"semi_diameter_mm": 40, "interaction": "reflect"},
    ],
}
ALL_WAVES = WAVES | {"lens": SYSTEM, "mirror": MIRROR}

SURFACES = {
    "plane": PlaneSurface(size_mm=(12.0, 8.0)),
    "round": PlaneSurface(size_mm=(12.0, 12.0), outline="ellipse"),
    "bowl": ConicSurface(size_mm=(12.0, 12.0), radius_mm=60.0, conic=-1.0),
}

SINGLE = 2e-5
"""Directions of pieces whose ends are float32; the shortest is some mm long."""

AGREE_MM = 1e-9
BUDGET_S = 0.05
"""For all lines of a shipped preset, on a core that has nothing else to do."""

IDLE_S = 1.8e-3
"""What `yardstick` takes on such a core."""


def beams(wave: Any, surface: Any, rays: int = 9) -> tuple[Lines, Any]:
    """Lines of a wave as the object wave, and directions of the core at the element's places."""
    spec = to_wave(wave)
    other = to_wave({"kind": "point", "position_mm": [0, 0, -30000]})
    recording = RecordingSpec(wavelength_nm=532.0, object=spec, reference=other)
    points = aims_of(surface, rays).points
    way = unit(wave_from(spec, 532.0).gradient(mm_to_m(points)))
    return source_lines(surface, recording, rays), np.broadcast_to(way, points.shape)


@pytest.mark.parametrize("shape", SURFACES)
@pytest.mark.parametrize("name", ALL_WAVES)
def test_beams_meet_the_element_as_the_wave_of_the_core_does(name: str, shape: str) -> None:
    if (name, shape) == ("window that holds the hologram", "bowl"):
        return  # what is left of its beams behind the window is shorter than heads of arrows
    wave, surface = ALL_WAVES[name], SURFACES[shape]
    lines, ways = beams(wave, surface)
    points = aims_of(surface, 9).points
    first, last = (lines.ends[:, place].astype(np.float64) for place in (0, 1))
    lit = 0
    for point, way in zip(points, ways, strict=True):
        arrives = np.linalg.norm(last - point, axis=1) < 1e-4
        leaves = np.linalg.norm(first - point, axis=1) < 1e-4
        long = np.linalg.norm(last - first, axis=1) > 2.0
        drawn = unit((last - first)[(arrives | leaves) & long])
        if np.isfinite(way).all():
            assert len(drawn), point
            along = np.linalg.norm(np.cross(drawn, way), axis=1) < SINGLE
            # Extended sources add rays of their edge to the middle, which are no rays of it.
            assert along.any(), (point, way, drawn)
            assert np.all(drawn[along] @ way > 0.0)
            if wave["kind"] != "extended":
                assert along.all()
            lit += 1
    assert lit >= 5
    assert np.isfinite(lines.ends).all()


@pytest.mark.parametrize("name", [key for key, wave in WAVES.items() if "first_mm" in wave])
def test_rays_cross_both_focal_lines(name: str) -> None:
    wave = to_wave(WAVES[name])
    assert isinstance(wave, AstigmaticSpec)
    points = aims_of(SURFACES["plane"], 17).points
    way = unit(wave_from(wave).gradient(mm_to_m(points)))
    crossed = foci.crossings_mm(wave, points)
    for places, pieces in zip(crossed, foci.lines_mm(wave, crossed), strict=True):
        assert np.max(np.linalg.norm(np.cross(places - points, way), axis=1)) < AGREE_MM
        along = unit(pieces[:, 1] - pieces[:, 0])
        away = places[:, None] - pieces[None, :, 0]
        # An arc of sixteen chords is flat to well below a hundredth of a mm here.
        assert np.min(np.linalg.norm(np.cross(away, along), axis=2), axis=1).max() < 1e-2


@pytest.mark.parametrize("name", [key for key, wave in ALL_WAVES.items() if "window" in wave])
def test_rays_behind_a_window_come_from_its_point(name: str) -> None:
    wave = to_wave(ALL_WAVES[name])
    assert isinstance(wave, WindowSourceSpec)
    points = aims_of(SURFACES["plane"], 9).points
    way = unit(wave_from(wave).gradient(mm_to_m(points)))
    way = -way if wave.beam == "converging" else way
    system = optics.window_system(wave)
    ends = optics.source_ends_mm(system, optics.traced_back(system, points, way), 5.0)
    assert np.max(np.abs(ends - wave.position_mm)) < AGREE_MM


def test_rays_through_a_lens_come_from_its_point() -> None:
    wave = to_wave(SYSTEM)
    assert isinstance(wave, SystemWaveSpec)
    points = aims_of(SURFACES["plane"], 9).points
    way = unit(wave_from(wave, 532.0).gradient(mm_to_m(points)))
    system = wave.core_system(532.0)
    ends = optics.source_ends_mm(system, optics.traced_back(system, points, way), 5.0)
    assert np.max(np.abs(ends - (1, 0, -120))) < 1e-6


def test_reference_wave_is_dashed_and_the_object_wave_is_not() -> None:
    plane = to_wave({"kind": "plane", "direction": [0, 0, 1]})
    far = to_wave({"kind": "point", "position_mm": [0, 0, -30000]})
    surface = SURFACES["plane"]
    count = [
        len(source_lines(surface, RecordingSpec(532.0, *pair), 9).ends)
        for pair in ((plane, far), (far, plane))
    ]
    whole = source_lines(surface, RecordingSpec(532.0, far, far), 9)
    assert count[0] > 9 * 10
    assert count[0] == count[1], "the same two waves, either of which is dashed"
    lengths = np.linalg.norm(np.diff(whole.ends.astype(np.float64), axis=1)[:, 0], axis=1)
    assert lengths.max() > 5.0
    assert np.sum(lengths < 1.0) > 9 * 5


def test_dashes_cover_their_share_and_keep_the_ends() -> None:
    line = Lines.of([[(0, 0, 0), (10, 0, 0)]], (1, 0, 0), (0.0, 1.0)).dashed(1.0)
    assert len(line.ends) == 10
    assert np.diff(line.ends[..., 0], axis=1).sum() == pytest.approx(5.5)
    assert np.allclose(line.colours[..., 3], line.ends[..., 0] / 10.0, atol=1e-6)


def test_shapes_have_their_sizes() -> None:
    ring = circle((1, 2, 3), (0, 0.6, 0.8), 2.0)
    assert np.allclose(np.linalg.norm(ring - (1, 2, 3), axis=2), 2.0)
    assert np.allclose((ring - (1, 2, 3)) @ (0, 0.6, 0.8), 0.0)
    assert np.allclose(np.linalg.norm(np.diff(star((1, 1, 1), 0.5), axis=1), axis=2), 0.5)
    heads = arrow_heads(np.zeros((1, 3)), (0, 0, 1), 1.0)
    assert np.all(heads[:, 0] == 0.0)
    assert np.allclose(heads[:, 1, 2], -1.0)


@pytest.mark.parametrize("nm", [200.0, 385.0, 405.0, 460.0, 532.0, 589.0, 640.0, 700.0, 900.0])
def test_every_wavelength_can_be_seen_on_a_dark_and_on_a_light_ground(nm: float) -> None:
    rgb = np.array(colours.of_wavelength(nm))
    assert np.all((rgb >= 0.0) & (rgb <= 1.0))
    linear = np.where(rgb > 0.04, ((rgb + 0.055) / 1.055) ** 2.4, rgb / 12.92)
    luminance = linear @ (0.2126, 0.7152, 0.0722)
    assert luminance > 0.2
    strongest = {460.0: 2, 532.0: 1, 640.0: 0, 700.0: 0}.get(nm)
    assert strongest is None or np.argmax(rgb) == strongest


def test_nothing_here_needs_blender() -> None:
    code = (
        "import sys; import hoe_addon.ui.overlay.document as d; from hoe_addon.model.document "
        "import load_device as l; d.drawing_of(l('point_lens'), d.Density(), frozenset(d.Kind)); "
        "print('bpy' in sys.modules, 'gpu' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "False"]


def yardstick() -> float:
    """Time of a fixed number of small steps like those of the drawing, in s of the processor."""
    values = np.linspace(0.0, 1.0, 300).reshape(100, 3)
    start = time.process_time()
    for _ in range(300):
        np.where(values > 0.5, values, 0.0).sum(axis=1)
    return time.process_time() - start


@pytest.mark.parametrize("name", preset_paths())
def test_all_lines_of_a_preset_are_drawn_in_time(name: str) -> None:
    """A loaded machine makes a step longer, so the time is told in steps of a yardstick."""
    spec = load_device(name)
    ratios: list[float] = []
    for _ in range(7):
        document.forget_all()
        before = yardstick()
        start = time.process_time()
        drawing = drawing_of(spec, Density(), frozenset(Kind))
        used = time.process_time() - start
        ratios.append(used / max(before, yardstick(), IDLE_S))
        assert Kind.CHIEF_RAYS in drawing.lines
    assert min(ratios) < BUDGET_S / IDLE_S


def test_what_has_not_changed_is_not_drawn_anew() -> None:
    spec = load_device("two_hologram_ar")
    first = drawing_of(spec, Density(), frozenset(Kind))
    again = drawing_of(load_device("two_hologram_ar"), Density(), frozenset(Kind))
    assert again.lines[Kind.CHIEF_RAYS] is first.lines[Kind.CHIEF_RAYS]
    moved = load_device("two_hologram_ar", ["eye.position_mm=[1, 0, 0]"])
    other = drawing_of(moved, Density(), frozenset(Kind))
    assert other.lines[Kind.CHIEF_RAYS] is not first.lines[Kind.CHIEF_RAYS]


def test_pupil_and_eyebox_have_their_true_sizes() -> None:
    spec = load_device("two_hologram_ar", ["eye.position_mm=[1, 2, 3]"])
    drawing = drawing_of(spec, Density(), frozenset(Kind))
    rim = drawing.lines[Kind.PUPIL].ends[:48].astype(np.float64) - (1, 2, 3)
    assert np.allclose(np.linalg.norm(rim, axis=2), spec.eye.pupil_diameter_mm / 2.0, atol=1e-5)
    assert [label.text for label in drawing.labels] == ["21 mm"]
    frame = drawing.lines[Kind.EYEBOX].ends[-4:].reshape(-1, 3)
    assert np.allclose(np.ptp(frame, axis=0), (18.0, 5.0, 0.0), atol=1e-5)
    assert np.allclose(frame.mean(axis=0), (1, 2, 3), atol=1e-5)
