# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V in the shipped shader, in a real Cycles render, against exact numpy."""

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.maps import MapRequest, map_file
from hoe_addon.model.rays import RayTable
from hoe_addon.shading.pattern import pattern_part

pytestmark = pytest.mark.render

DIRECTION = 1e-5
"""rad; what the map promises: its own 1e-6, and float32 in look-up, position and ray law."""

EFFICIENCY = 1.1e-5
"""As in test_trace_cycles: Cycles leaves out closures below a weight of 1e-5."""

HALF_MM = 5.0


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path))


def document(semi_diameter_mm: float = 14.0) -> dict[str, Any]:
    """A point behind two lenses as the object, an oblique plane wave as the reference."""
    faces = ((-60, 50, "N-BK7"), (-55, -40, "N-SF15"), (-52, -200, "air"))
    return {
        "schema": 1,
        "name": "behind lenses",
        "surface": {"shape": "plane", "size_mm": [2 * HALF_MM, 2 * HALF_MM]},
        "media": {"back": 1.0, "front": 1.5},
        "recording": {
            "wavelength_nm": 532,
            "object": {
                "kind": "system",
                "source": {"kind": "point", "position_mm": [2, 1, -150]},
                "surfaces": [
                    {
                        "shape": "sphere",
                        "vertex_mm": [0, 0, z],
                        "radius_mm": radius,
                        "semi_diameter_mm": semi_diameter_mm,
                        "medium": medium,
                    }
                    for z, radius, medium in faces
                ],
            },
            "reference": {"kind": "plane", "direction": [0, 0.2, 1]},
        },
        "efficiency": {
            "model": "constant",
            "table": {"T": {"0": 0.25, "1": 0.5}, "R": {"-1": 0.125}},
            "total_internal_reflection": True,
        },
        "orders": [-1, 0, 1],
    }


def rays(rng: np.random.Generator, count: int, branches, sag=None) -> RayTable:
    """Rays onto random points, from both sides, into random branches."""
    x, y = rng.uniform(-0.998 * HALF_MM, 0.998 * HALF_MM, (2, count))
    z = np.zeros(count) if sag is None else sag(x, y)
    cos = rng.uniform(0.4, 1.0, count)
    sin, phi = np.sqrt(1.0 - cos**2), rng.uniform(0.0, 2.0 * np.pi, count)
    side = rng.choice([-1.0, 1.0], count)
    direction = np.stack((sin * np.cos(phi), sin * np.sin(phi), side * cos), axis=1)
    chosen = np.asarray(branches)[rng.integers(0, len(branches), count)]
    return RayTable(
        np.stack((x, y, z), axis=1) - 3.0 * direction,
        direction,
        np.full(count, 532.0),
        chosen[:, 0],
        chosen[:, 1].astype(bool),
    )


def angle(cycles, exact, chosen) -> float:
    return np.linalg.norm(cycles.direction - exact.direction, axis=1)[chosen].max()


def test_directions_at_a_thousand_points(rng):
    spec = hologram_from(document())
    table = rays(rng, 1000, [(1, 0)])
    cycles, exact = trace_cycles(spec, table), trace(spec, table)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.5
    assert np.mean(cycles.status != exact.status) < 2e-3
    assert angle(cycles, exact, both) < DIRECTION
    assert np.abs(cycles.efficiency - exact.efficiency)[both].max() < EFFICIENCY


def test_both_waves_in_one_map(rng):
    made = document()
    second = copy.deepcopy(made["recording"]["object"])
    second["source"] = {"kind": "point", "position_mm": [-4, 2, -130]}
    made["recording"]["reference"] = second
    spec = hologram_from(made)
    assert len(pattern_part(spec.pattern, 1.0).map.terms) == 2
    table = rays(rng, 300, [(1, 0), (-1, 0)])
    cycles, exact = trace_cycles(spec, table), trace(spec, table)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.5
    assert angle(cycles, exact, both) < DIRECTION


def test_on_a_sphere_the_place_on_the_map_is_the_true_one(rng):
    made = document()
    made["surface"] = {"shape": "sphere", "size_mm": [10, 10], "radius_mm": 30}
    spec = hologram_from(made)
    shape = spec.surface.core_shape()
    table = rays(rng, 600, [(1, 0)], lambda x, y: 1e3 * shape.sag(x * 1e-3, y * 1e-3))
    cycles, exact = trace_cycles(spec, table), trace(spec, table)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.5
    assert angle(cycles, exact, both) < DIRECTION


@pytest.mark.slow
def test_where_nothing_is_recorded_light_goes_straight_on(rng):
    """Lenses so small that they light a part of the element: both rules, and no false light."""
    spec = hologram_from(document(5.0))
    branches = [(1, 0), (0, 0), (0, 1), (-1, 1)]
    table = rays(rng, 1000, branches)
    cycles, exact = trace_cycles(spec, table), trace(spec, table)
    source = pattern_part(spec.pattern, 1.0).map
    _, made = map_file(MapRequest(source, spec.surface, 532.0))
    by_map = np.isfinite(made.gradient(exact.hit_mm * 1e-3)[:, 0])
    recorded = np.isfinite(spec_gradient(spec, exact.hit_mm))
    # The map may give up what is recorded beside the border, and nothing else.
    assert not np.any(by_map & ~recorded)
    assert 0.02 < np.mean(~recorded) < 0.5
    assert np.mean(recorded & ~by_map) < 0.03
    sure = by_map == recorded
    away = ~recorded & sure
    straight = (table.order == 0) & ~table.reflected
    assert (away & straight).sum() > 10

    both = (cycles.status == Status.OK) & (exact.status == Status.OK) & sure
    assert angle(cycles, exact, both) < DIRECTION
    np.testing.assert_allclose(cycles.efficiency[both], exact.efficiency[both], atol=EFFICIENCY)
    np.testing.assert_allclose(cycles.efficiency[away], exact.efficiency[away], atol=EFFICIENCY)
    passing = away & straight & (exact.status == Status.OK)
    assert passing.any()
    assert np.all(exact.efficiency[passing] == 1.0)
    assert np.all(exact.efficiency[away & (table.order != 0)] == 0.0)
    trapped = away & (table.order == 0) & table.reflected & (exact.efficiency > 0.0)
    assert trapped.any()
    assert np.all(exact.efficiency[trapped] == 1.0)


def spec_gradient(spec, points_mm):
    from hoe_addon.model.convert import pattern_from

    return pattern_from(spec.pattern).gradient(points_mm * 1e-3)[:, 0]
