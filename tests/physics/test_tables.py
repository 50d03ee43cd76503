# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables made of the models of the field: their error, reciprocity, and the two look-up forms."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency import Incidence, Polarization
from hoe_addon.core.efficiency.node_source import propagates
from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.tables.light import TableRange, node_source
from hoe_addon.model.tables.making import bake_hologram

DOCUMENTS = Path(__file__).parents[1] / "documents"
SINE = 532e-6 * 1200
TOLERANCE = 1e-2
LUCK = 1.5
"""Other random points may find a little more than those of the last measurement."""
FEW_SIGMA = 4.5

MODELS: dict[str, tuple[dict[str, Any], list[int]]] = {
    "kinoform": (
        {"model": "kinoform", "levels": 4, "design_wavelength_nm": 532, "relief": 1.5}, [0, 1]
    ),
    "kogelnik": (
        {"model": "kogelnik", "thickness_um": 6, "index": 1.5, "modulation": 0.03}, [0, 1]
    ),
    "rcwa": (
        {"model": "rcwa", "profile": {"shape": "binary", "depth_um": 0.3}, "ridge": 1.5,
         "harmonics": 5},
        [-1, 0, 1],
    ),
}  # fmt: skip
PART = TableRange((530.0, 530.0), (-0.3, -0.1), (0.0, 0.0), ("back", "front"))
CHECKS = 100
"""Few, since the rigorous model takes its time."""


def hologram(name: str) -> HologramSpec:
    plane = {"kind": "plane", "index": 1}
    recording = {
        "wavelength_nm": 532,
        "object": plane | {"direction": [SINE, 0, float(np.sqrt(1 - SINE**2))]},
        "reference": plane | {"direction": [0, 0, 1]},
    }
    efficiency, orders = MODELS[name]
    document = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    parts = {"media": {"back": 1.5, "front": 1.0}, "recording": recording}
    return hologram_from(document | parts | {"efficiency": efficiency, "orders": orders})


def rays(spec: HologramSpec, rng: np.random.Generator, count: int) -> Incidence:
    nodes = np.zeros((count, 6))
    nodes[:, 0] = rng.integers(2, size=count)
    ends = ((530e-9, 530e-9), PART.along, PART.across)
    for axis, (low, high) in enumerate(ends):
        nodes[:, 1 + axis] = rng.uniform(low, high, count)
    return node_source(spec, PART).light_at(nodes)


@pytest.mark.parametrize("name", MODELS)
def test_forward_tables_meet_the_model(name: str, rng: np.random.Generator) -> None:
    spec = hologram(name)
    baked = bake_hologram(spec, TOLERANCE, PART, checks=CHECKS)
    assert baked.reached, baked.error
    light = rays(spec, rng, 100)
    ways = baked.table.branches
    exact = spec.efficiency.model().shares(ways, light)
    error = np.abs(baked.table.shares(ways, light) - exact)[propagates(light, ways)]
    assert error.max() <= LUCK * max(baked.error, baked.cutoff_error)


@pytest.mark.parametrize("name", MODELS)
def test_backward_tables_hold_the_share_of_the_light_that_comes(
    name: str, rng: np.random.Generator
) -> None:
    spec = hologram(name)
    baked = bake_hologram(spec, TOLERANCE, PART, checks=CHECKS, backward=True)
    walked = rays(spec, rng, 100)
    # A model that is not reciprocal gives shares above 1 in sum, which are scaled down.
    worst = LUCK * max(baked.error, baked.cutoff_error) + baked.excess
    for way in baked.table.branches:
        live = propagates(walked, (way,))[:, 0]
        light = walked.reversed(way.steps, reflected=way.reflected)
        exact = spec.efficiency.model().shares((way,), light)[:, 0]
        found = baked.table.shares((way,), walked)[:, 0]
        assert np.abs(found - exact)[live].max(initial=0.0) <= worst


def test_rigorous_tables_are_the_same_both_ways(rng: np.random.Generator) -> None:
    """A rigorous solution is reciprocal: a ray and its reverse have the same share."""
    spec = hologram("rcwa")
    forward, backward = (
        bake_hologram(spec, TOLERANCE, PART, checks=CHECKS, backward=way) for way in (False, True)
    )
    walked = rays(spec, rng, 100)
    ways = forward.table.branches
    live = propagates(walked, ways)
    apart = np.abs(forward.table.shares(ways, walked) - backward.table.shares(ways, walked))[live]
    worst = sum(max(table.error, table.cutoff_error) for table in (forward, backward))
    assert apart.max() <= LUCK * worst
    assert backward.excess < 1e-6


def test_s_against_p_is_the_models_own() -> None:
    spec = hologram("rcwa")
    tables = {
        name: bake_hologram(spec, TOLERANCE, PART, checks=CHECKS, polarization=name)
        for name in Polarization
    }
    spreads = [table.spread for table in tables.values()]
    assert min(spreads) > 0.02
    assert max(spreads) - min(spreads) < 1e-9


@pytest.mark.parametrize("name", MODELS)
def test_both_look_up_forms_have_the_same_mean(name: str, rng: np.random.Generator) -> None:
    spec = hologram(name)
    table = bake_hologram(spec, TOLERANCE, PART, checks=CHECKS).table
    light = rays(spec, rng, 100_000)
    shares = table.shares(table.branches, light)
    chosen = table.stochastic(light, rng.random((100_000, 6)))
    for column in range(len(table.branches)):
        hits = chosen == column
        # Each ray is a draw of its own with its own chance.
        sigma = np.sqrt(np.sum(shares[:, column] * (1.0 - shares[:, column])))
        assert abs(hits.sum() - shares[:, column].sum()) <= FEW_SIGMA * max(sigma, 1.0)
