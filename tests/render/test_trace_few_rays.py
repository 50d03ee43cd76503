# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A handful of rays through Cycles: fewer than the rows of the smallest picture of Blender."""

import json
from pathlib import Path

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.rays import RayTable

pytestmark = pytest.mark.render

LENS = Path(__file__).parents[1] / "documents" / "lens.json"

DIRECTION = 2e-6
"""Float32, as for ten thousand rays; all of these are far from grazing."""


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 7, 1023, 1024, 1025, 1026])
def test_few_rays_agree_with_numpy(count: int, rng: np.random.Generator) -> None:
    spec = hologram_from(json.loads(LENS.read_text(encoding="utf-8")))
    toward = np.array([0.0, 0.0, 1.0]) + rng.uniform(-0.2, 0.2, size=(count, 3))
    rays = RayTable(
        origin_mm=rng.uniform(-5.0, 5.0, size=(count, 3)) - [0.0, 0.0, 20.0],
        direction=toward / np.linalg.norm(toward, axis=1, keepdims=True),
        wavelength_nm=rng.uniform(400.0, 700.0, size=count),
        order=np.ones(count, dtype=np.int64),
        reflected=np.zeros(count, dtype=np.bool_),
    )
    found, wanted = trace_cycles(spec, rays), trace(spec, rays)
    np.testing.assert_array_equal(found.status, wanted.status)
    np.testing.assert_allclose(found.direction, wanted.direction, atol=DIRECTION)
    np.testing.assert_allclose(found.hit_mm, wanted.hit_mm, atol=2e-5)
    np.testing.assert_allclose(found.efficiency, wanted.efficiency, atol=1e-5)


def test_extreme_rays_are_right_and_harm_no_other() -> None:
    spec = hologram_from(json.loads(LENS.read_text(encoding="utf-8")))
    starts = [(0, 0, -5), (1e39, 0, -1), (0, 0, -1500), (0, 0, 0), (0, 0, -1e-9), (1, 2, 1e12)]
    rays = RayTable(
        origin_mm=np.array(starts, dtype=np.float64),
        direction=np.array([[0.0, 0.0, 1.0]] * 5 + [[0.0, 0.0, -1.0]]),
        wavelength_nm=np.full(6, 532.0),
        order=np.ones(6, dtype=np.int64),
        reflected=np.zeros(6, dtype=np.bool_),
    )
    found, wanted = trace_cycles(spec, rays), trace(spec, rays)
    np.testing.assert_array_equal(found.status, wanted.status)
    np.testing.assert_allclose(found.direction, wanted.direction, atol=DIRECTION)
