# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shipped OSL shader in a real Cycles render against the numpy engine, ray by ray."""

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.rays import RayTable

pytestmark = pytest.mark.render

DIRECTION = 2e-6
"""rad: some 30 roundings of float32 (6e-8) in normal, incidence, gradient and output."""

GRAZING = 3e-7
"""rad times cos: a tangential error of 3e-7 turns a ray toward grazing by 3e-7 / cos."""

LIMIT_BAND = 2e-6
"""Half width, in (n' cos')^2, of the band where float32 cannot tell the side of evanescence."""

EFFICIENCY = 1.1e-5
"""Cycles leaves out closures below a weight of 1e-5; above, float32 keeps 1e-6."""

HIT_MM = 2e-5
"""float32 at 20 mm is good to 2e-6 mm; a hit is the end of a ray and a sum over three corners."""


def _lens(object_beam: str = "diverging") -> dict:
    return {
        "schema": 1,
        "name": "lens",
        "surface": {"shape": "plane", "size_mm": [40, 40]},
        "media": {"back": 1.0, "front": "N-BK7"},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "point", "position_mm": [10, 5, -100], "beam": object_beam},
            "reference": {"kind": "plane", "direction": [0, 0, 1]},
        },
        "efficiency": {
            "model": "kinoform",
            "levels": 8,
            "design_wavelength_nm": 532,
            "relief": 1.5,
        },
        "orders": [-1, 0, 1, 2],
    }


def _random_rays(rng: np.random.Generator, count: int, *, near: float = 0.05) -> RayTable:
    hit = np.concatenate((rng.uniform(-19, 19, (count, 2)), np.zeros((count, 1))), axis=1)
    cos = rng.uniform(near, 1.0, count)
    sin, phi = np.sqrt(1.0 - cos**2), rng.uniform(0.0, 2.0 * np.pi, count)
    side = rng.choice([-1.0, 1.0], count)
    direction = np.stack((sin * np.cos(phi), sin * np.sin(phi), side * cos), axis=1)
    origin = hit - direction * rng.uniform(0.5, 40.0, (count, 1))
    return RayTable(
        origin,
        direction,
        rng.uniform(380.0, 780.0, count),
        rng.integers(-3, 4, count),
        rng.random(count) < 0.5,
    )


def _compare(spec, rays: RayTable) -> None:
    cycles, exact = trace_cycles(spec, rays), trace(spec, rays)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.3
    cos = np.abs(exact.direction[both, 2])
    angle = np.linalg.norm(cycles.direction[both] - exact.direction[both], axis=1)
    allowed = np.maximum(DIRECTION, GRAZING / cos)
    assert np.all(angle <= allowed), np.max(angle / allowed)
    differ = cycles.status != exact.status
    limit = np.where(exact.status == Status.OK, exact.direction[:, 2] ** 2, 0.0)
    assert np.all(limit[differ] < LIMIT_BAND)
    assert differ.sum() < 1e-3 * len(rays)
    assert np.max(np.abs(cycles.efficiency[both] - exact.efficiency[both])) < EFFICIENCY
    assert np.nanmax(np.abs(cycles.hit_mm - exact.hit_mm)) < HIT_MM


@pytest.mark.parametrize("beam", ["diverging", "converging"])
def test_ten_thousand_random_rays(rng: np.random.Generator, beam: str) -> None:
    _compare(hologram_from(_lens(beam)), _random_rays(rng, 10_000))


def test_two_points_in_media(rng: np.random.Generator) -> None:
    document = _lens()
    document["recording"]["object"]["index"] = 1.5
    document["recording"]["reference"] = {
        "kind": "point",
        "position_mm": [-3, 0, 80],
        "beam": "converging",
        "index": 1.2,
    }
    _compare(hologram_from(document), _random_rays(rng, 2_000))


def test_constant_shares_with_total_internal_reflection(rng: np.random.Generator) -> None:
    document = _lens()
    document["efficiency"] = {
        "model": "constant",
        "table": {"T": {"0": 0.5, "1": 0.2}, "R": {"-1": 0.1}},
        "total_internal_reflection": True,
    }
    document["orders"] = [-1, 0, 1]
    rays = _random_rays(rng, 2_000)
    spec = hologram_from(document)
    _compare(spec, rays)
    trapped = RayTable(
        np.array([[0.0, 0.0, 5.0]]),
        np.array([[0.9, 0.0, -np.sqrt(0.19)]]),
        np.array([532.0]),
        np.array([0]),
        np.array([True]),
    )
    assert trace_cycles(spec, trapped).efficiency[0] == pytest.approx(0.5, abs=1e-6)


def test_misses_and_rays_that_start_close(rng: np.random.Generator) -> None:
    origin = np.array([[0.0, 0.0, -1e-3], [30.0, 0.0, -5.0], [1.0, 1.0, 5.0]])
    direction = np.array([[0.0, 0.0, 1.0]] * 3)
    rays = RayTable(
        origin, direction, np.full(3, 532.0), np.zeros(3, dtype=np.int64), np.zeros(3, dtype=bool)
    )
    result = trace_cycles(hologram_from(_lens()), rays)
    assert result.status.tolist() == [Status.OK, Status.MISS, Status.MISS]
