# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of recording wave in Cycles: against numpy, and read-out gives the other wave."""

import json
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import mm_to_m
from hoe_addon.core.waves import Wave
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable
from hoe_addon.model.waves import WaveSpec
from hoe_addon.shading import extended
from hoe_addon.shading.hologram import Frame, hologram_sockets, one_order_shader

pytestmark = pytest.mark.render

DIRECTION = 2e-6
"""rad: some 30 roundings of float32 (6e-8) in normal, incidence, gradient and output."""

GRAZING = 3e-7
"""rad times cos: a tangential error of 3e-7 turns a ray toward grazing by 3e-7 / cos."""

RAYS = 1000
DRAWS = ("0.3", "0.8", "0.15")
"""Instead of random numbers, so that numpy and the shader meet the same point of a source."""

PLAIN = {"kind": "plane", "direction": [0.1, 0.2, 1]}
DOCUMENTS = json.loads(
    (Path(__file__).parents[1] / "documents" / "waves.json").read_text(encoding="utf-8")
)
"""Waves of every kind that travel toward +z at a hologram of 20 mm in the plane z = 0."""

WINDOWS = {
    "grazing behind": (
        [40, 0, -30],
        {"position_mm": [0, 0, -0.02], "thickness_mm": 0},
        1.7,
        1.3,
    ),
    "thin gap of air": (
        [60, 10, -30],
        {"position_mm": [0, 0, -12], "thickness_mm": 0.002, "index": 1.0},
        1.5,
        1.5,
    ),
    "far": (
        [3e6, -4e6, -1e7],
        {"position_mm": [0, 0, -8], "thickness_mm": 5, "index": 1.6},
        1,
        1.2,
    ),
    "close to the face": (
        [1, 2, -10.001],
        {"position_mm": [0, 0, -10], "thickness_mm": 9, "index": 1.4},
        1.0,
        1.7,
    ),
    "hologram on the far face": (
        [1, 2, -40],
        {"position_mm": [0, 0, -3], "thickness_mm": 3, "index": 1.5},
        1.0,
        1.5,
    ),
}
"""Point in mm, window, index at the point, index at the hologram."""

NEAR, FAR, BEYOND = [1.0, 2.0, -100.0], [0.0, 3e5, -4e5], [1.0, 2.0, 100.0]


@pytest.fixture
def fixed_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extended, "draw", lambda role, dimension: DRAWS[dimension])


def hologram(recording: dict[str, Any], back: float, front: float) -> HologramSpec:
    return hologram_from(
        {
            "schema": 1,
            "name": "waves",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"back": back, "front": front},
            "recording": {"wavelength_nm": 532, **recording},
            "efficiency": {"model": "constant", "table": {"T": {"1": 0.5, "-1": 0.3}}},
            "orders": [-1, 1],
        }
    )


def rays_along(points_mm: np.ndarray, travel: np.ndarray, order: int) -> RayTable:
    count = len(points_mm)
    return RayTable(
        points_mm - 5.0 * travel,
        travel,
        np.full(count, 532.0),
        np.full(count, order),
        np.zeros(count, dtype=bool),
    )


def assert_close(found: np.ndarray, expected: np.ndarray) -> None:
    error = np.linalg.norm(found - expected, axis=1)
    allowed = np.maximum(DIRECTION, GRAZING / np.abs(expected[:, 2]))
    assert np.all(error <= allowed), np.max(error / allowed)


def exact_direction(wave: Wave, points_mm: np.ndarray) -> np.ndarray:
    draws = np.array([float(text) for text in DRAWS])[: wave.draws]
    gradient = wave.gradient(
        mm_to_m(points_mm), np.broadcast_to(draws, (len(points_mm), len(draws)))
    )
    return gradient / wave.index


@pytest.mark.parametrize("role", ["object", "reference"])
@pytest.mark.parametrize("name", DOCUMENTS)
@pytest.mark.usefixtures("fixed_draws")
def test_read_out_and_its_reverse(name: str, role: str, rng: np.random.Generator) -> None:
    recording = {"object": PLAIN, "reference": PLAIN} | {role: DOCUMENTS[name]}
    points_mm = np.column_stack([rng.uniform(-9.9, 9.9, (RAYS, 2)), np.zeros(RAYS)])
    wave_o, wave_r = (
        wave_from(msgspec.convert(recording[which], WaveSpec)) for which in ("object", "reference")
    )
    s_o, s_r = exact_direction(wave_o, points_mm), exact_direction(wave_r, points_mm)
    for order, n_in, s_in, n_out, s_out in (
        (1, wave_r.index, s_r, wave_o.index, s_o),
        (-1, wave_o.index, s_o, wave_r.index, s_r),
    ):
        result = trace_cycles(hologram(recording, n_in, n_out), rays_along(points_mm, s_in, order))
        assert (result.status == Status.OK).all()
        assert_close(result.direction, s_out)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_every_number_of_a_wave_has_its_socket(name: str) -> None:
    spec = hologram({"object": DOCUMENTS[name], "reference": DOCUMENTS[name]}, 1.0, 1.0)
    needed = hologram_sockets(spec, Frame(), units_per_mm=0.001)
    made = nodes.socket_names(one_order_shader(spec, Branch(1)))
    waves = {name for name in needed if name.startswith(("object_", "reference_"))}
    assert len(waves) >= 4
    assert waves <= made


@pytest.mark.parametrize("name", WINDOWS)
def test_windows_toward_grazing_and_far_away(name: str, rng: np.random.Generator) -> None:
    """Compared with numpy, which is compared with 40 digits elsewhere."""
    position, window, source_index, index = WINDOWS[name]
    recording = {
        "object": {
            "kind": "window",
            "position_mm": position,
            "window": window,
            "source_index": source_index,
            "index": index,
        },
        "reference": {"kind": "plane", "direction": [0, 0, 1]},
    }
    points_mm = np.column_stack([rng.uniform(-9.9, 9.9, (RAYS, 2)), np.zeros(RAYS)])
    exact = exact_direction(wave_from(msgspec.convert(recording["object"], WaveSpec)), points_mm)
    travel = np.broadcast_to((0.0, 0.0, 1.0), (RAYS, 3))
    result = trace_cycles(hologram(recording, 1.0, index), rays_along(points_mm, travel, 1))
    assert (result.status == Status.OK).all()
    assert_close(result.direction, exact)


@pytest.mark.parametrize("first, second", [(FAR, NEAR), (NEAR, FAR), (FAR, BEYOND)])
def test_far_line_foci(first: list[float], second: list[float], rng: np.random.Generator) -> None:
    """A nearly cylindrical wave, where radii of 500 m are subtracted."""
    recording = {
        "object": {
            "kind": "astigmatic",
            "first_mm": first,
            "second_mm": second,
            "line_direction": [1, 0.3, 0],
            "beam": "converging" if second[2] > 0.0 else "diverging",
        },
        "reference": PLAIN,
    }
    wave_o, wave_r = (
        wave_from(msgspec.convert(recording[which], WaveSpec)) for which in ("object", "reference")
    )
    points_mm = np.column_stack([rng.uniform(-9.9, 9.9, (RAYS, 2)), np.zeros(RAYS)])
    travel = exact_direction(wave_r, points_mm)
    result = trace_cycles(hologram(recording, 1.0, 1.0), rays_along(points_mm, travel, 1))
    assert_close(result.direction, exact_direction(wave_o, points_mm))


@pytest.mark.parametrize("order", [0, 1])
def test_where_the_window_is_not_before_the_hologram_nothing_is_recorded(
    order: int, rng: np.random.Generator
) -> None:
    """A tilted window that leaves x < 2 mm free: there the light goes straight on."""
    recording = {
        "object": {
            "kind": "window",
            "position_mm": [-20, 0, -40],
            "window": {"position_mm": [2, 0, 0], "normal": [1, 0, 0.5], "index": 1.0},
            "source_index": 1.2,
        },
        "reference": PLAIN,
    }
    points_mm = np.column_stack([rng.uniform(-9.9, 9.9, (RAYS, 2)), np.zeros(RAYS)])
    # At the window's very edge float32 may see either side.
    points_mm = points_mm[np.abs(points_mm[:, 0] - 2.0) > 1e-3]
    travel = exact_direction(wave_from(msgspec.convert(PLAIN, WaveSpec)), points_mm)
    spec, rays = hologram(recording, 1.0, 1.0), rays_along(points_mm, travel, order)
    exact, found = trace(spec, rays), trace_cycles(spec, rays)
    free = points_mm[:, 0] < 2.0
    assert 0.3 < free.mean() < 0.8
    assert ((exact.status == Status.OK) == (~free | (order == 0))).all()
    assert ((found.status == Status.OK) == (exact.status == Status.OK)).all()
    np.testing.assert_allclose(found.efficiency, exact.efficiency, atol=1e-6)
    np.testing.assert_array_equal(exact.efficiency[free], 1.0 if order == 0 else 0.0)
    going = exact.status == Status.OK
    assert_close(found.direction[going], exact.direction[going])
