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
from hoe_addon.core.efficiency.table_error import QUANTILE, near_cutoff
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.tables.light import TableRange, node_source
from hoe_addon.model.tables.making import bake_hologram

DOCUMENTS = Path(__file__).parents[1] / "documents"
SINE = 532e-6 * 1200
TOLERANCE = 1e-2
LUCK = 1.5
"""Other random points may find a little more than those of the last measurement."""
NEW_POINTS = 3000
SEARCH = 1e-3
"""Tolerance of a search for harmonics where none is given."""
ROUNDING = 1e-9
"""Of solutions that are the same but for the order of their operations."""
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
WIDE = TableRange((450.0, 650.0), (-0.6, 0.6), (-0.3, 0.3), ("back", "front"))
WIDE_MODELS = ["kinoform", "kogelnik", pytest.param("rcwa", marks=pytest.mark.slow)]
PART = TableRange((530.0, 530.0), (-0.3, -0.1), (0.0, 0.0), ("back", "front"))
CHECKS = 100
"""Few, since the rigorous model takes its time."""


def hologram(
    name: str, profile: dict[str, Any] | None = None, harmonics: int | str | None = None
) -> HologramSpec:
    plane = {"kind": "plane", "index": 1}
    recording = {
        "wavelength_nm": 532,
        "object": plane | {"direction": [SINE, 0, float(np.sqrt(1 - SINE**2))]},
        "reference": plane | {"direction": [0, 0, 1]},
    }
    efficiency, orders = MODELS[name]
    if profile is not None:
        efficiency = {"model": name, "profile": profile, "harmonics": efficiency["harmonics"]}
    if harmonics is not None:
        efficiency = efficiency | {"harmonics": harmonics}
    document = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    parts = {"media": {"back": 1.5, "front": 1.0}, "recording": recording}
    return hologram_from(document | parts | {"efficiency": efficiency, "orders": orders})


def points(within: TableRange, rng: np.random.Generator, count: int) -> Any:
    nodes = np.zeros((count, 6))
    nodes[:, 0] = rng.integers(2, size=count)
    low, high = within.wavelength_nm
    for axis, ends in enumerate(((low * 1e-9, high * 1e-9), within.along, within.across)):
        nodes[:, 1 + axis] = rng.uniform(*ends, count)
    return nodes


def rays(spec: HologramSpec, rng: np.random.Generator, count: int) -> Incidence:
    return node_source(spec, PART).light_at(points(PART, rng, count))


def sent(spec: HologramSpec, walked: Incidence, ways: Any) -> Any:
    """Shares of the light that takes each branch into the reverse of the walked rays."""
    live = propagates(walked, ways)
    shares = np.zeros(live.shape)
    for column, way in enumerate(ways):
        rows = live[:, column]
        light = walked.reversed(way.steps, reflected=way.reflected)
        shares[rows, column] = spec.efficiency.model().shares((way,), light)[rows, 0]
    # They belong to different light: a model that is not reciprocal gives more than 1 in sum. The
    # shader scales that down with a formula, and so does the table.
    return shares / np.maximum(shares.sum(axis=-1, keepdims=True), 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("name", WIDE_MODELS)
def test_the_stated_error_is_kept_at_other_points(
    name: str, rng: np.random.Generator, *, backward: bool
) -> None:
    spec = hologram(name)
    baked = bake_hologram(spec, TOLERANCE, WIDE, backward=backward)
    nodes = points(WIDE, rng, NEW_POINTS)
    source = node_source(spec, WIDE)
    away = ~near_cutoff(source, baked.table, nodes)
    light = source.light_at(nodes[away])
    ways = baked.table.branches
    model = spec.efficiency.model()
    exact = sent(spec, light, ways) if backward else model.shares(ways, light)
    error = np.abs(baked.table.shares(ways, light) - exact)
    worst = np.where(propagates(light, ways), error, 0.0).max(axis=-1)
    # The stated error is that of a sample, too.
    stated_from = baked.checks * (1.0 - baked.cutoff_part)
    spread = np.sqrt(QUANTILE * (1.0 - QUANTILE) * (1.0 / stated_from + 1.0 / len(worst)))
    assert len(worst) > 0.3 * NEW_POINTS
    assert np.mean(worst > baked.quantile) <= 1.0 - QUANTILE + FEW_SIGMA * spread
    assert baked.quantile <= baked.error
    assert baked.reached == (max(baked.quantile, baked.landmark_error) <= TOLERANCE)


SHARP = TableRange((500.0, 560.0), (0.0, 0.0), (0.0, 0.0))
SHARP_WIDE = TableRange((500.0, 560.0))


@pytest.mark.parametrize("shrinkage", [0.0, 0.01])
@pytest.mark.parametrize("thickness_um", [5000, 500])
def test_a_sharp_peak_is_held_or_told(thickness_um: float, shrinkage: float) -> None:
    """A mirror of some picometres is far narrower than the distance of random points."""
    plane = {"kind": "plane", "index": 1.5}
    recording = {
        "wavelength_nm": 532,
        "object": plane | {"direction": [0, 0, -1]},
        "reference": plane | {"direction": [0, 0, 1]},
    }
    modulation = 0.5 / thickness_um
    efficiency = {"model": "kogelnik", "thickness_um": thickness_um, "index": 1.5,
                  "modulation": modulation, "shrinkage": shrinkage}  # fmt: skip
    document = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    parts = {"media": {"back": 1.5, "front": 1.5}, "recording": recording}
    spec = hologram_from(document | parts | {"efficiency": efficiency, "orders": [0, 1]})
    # Development takes the fringes nearer together, and leaves less of them.
    peak, left = 532e-9 * (1.0 - shrinkage), 1.0 - shrinkage
    expected = np.tanh(np.pi * modulation * thickness_um * 1e-6 * left / peak) ** 2
    light = node_source(spec, SHARP).light_at(np.array([[0.0, peak, 0.0, 0.0, 0.0, 0.0]]))

    def read(baked: Any) -> float:
        ways = baked.table.branches
        return float(baked.table.shares(ways, light)[0, ways.index(Branch(1, reflected=True))])

    held = bake_hologram(spec, TOLERANCE, SHARP)
    assert held.reached
    assert read(held) == pytest.approx(expected, abs=TOLERANCE)
    # Over all directions no such table has the room.
    lacking = bake_hologram(spec, TOLERANCE, SHARP_WIDE, largest=4000)
    assert not lacking.reached
    assert lacking.landmark_error > 0.5


SLANTED = {"shape": "volume", "thickness_um": 3, "index": 1.5, "modulation": 0.05, "slant_deg": 15}


@pytest.mark.parametrize("profile", [None, SLANTED], ids=["binary", "slanted"])
def test_rigorous_solutions_are_reciprocal_and_mirrored(
    rng: np.random.Generator, profile: dict[str, Any] | None
) -> None:
    """Tables count on both: a ray, its reverse and its mirror image have the same share."""
    spec = hologram("rcwa", profile)
    nodes = points(WIDE, rng, 200)
    source = node_source(spec, WIDE)
    walked, mirrored = source.light_at(nodes), source.light_at(nodes * [1, 1, 1, -1, 1, 1])
    model, ways = spec.efficiency.model(), source.branches
    own = model.shares(ways, walked)
    assert own == pytest.approx(sent(spec, walked, ways), abs=ROUNDING)
    assert own == pytest.approx(model.shares(ways, mirrored), abs=ROUNDING)
    backward = node_source(spec, WIDE, backward=True)
    assert backward.at(nodes)[0] == pytest.approx(own, abs=ROUNDING)
    assert backward.excess < ROUNDING
    for light in (Polarization.S, Polarization.P):
        # In a cone s and p mix: what is walked backward is then solved for.
        polarised = node_source(spec, WIDE, backward=True, polarization=light)
        reverse = np.zeros_like(own)
        for column, way in enumerate(ways):
            rows = propagates(walked, (way,))[:, 0]
            back = walked.reversed(way.steps, reflected=way.reflected)
            reverse[rows, column] = model.shares((way,), back, light)[rows, 0]
        total = np.maximum(reverse.sum(axis=-1, keepdims=True), 1.0)
        found = np.where(propagates(walked, ways), polarised.at(nodes)[0], 0.0)
        assert found == pytest.approx(reverse / total, abs=ROUNDING)


def test_a_walked_table_has_no_cliff_at_a_cut_off() -> None:
    """Beyond it order 0 goes on as it was, though the reversed shares sum to about 1."""
    source = node_source(hologram("kogelnik"), WIDE, backward=True)
    nodes = np.zeros((2, 6))
    nodes[:, 1], nodes[:, 2] = 500e-9, -0.6
    # Light from glass of 1.5 is totally reflected from this cosine on.
    nodes[:, 3] = np.sqrt(1.5**-2 * np.array([0.999, 1.001]) - 0.6**2)
    shares = source.at(nodes)[0]
    assert source.passing(nodes)[:, 0].tolist() == [True, False]
    assert shares[0, 0] > 0.9
    assert shares[1] == pytest.approx(shares[0], abs=TOLERANCE)


def test_a_search_settles_once_for_all_nodes(rng: np.random.Generator) -> None:
    spec = hologram("rcwa", harmonics="auto")
    source = node_source(spec, WIDE)
    source.settle(points(WIDE, rng, 50))
    settled, searched = source.settled, spec.efficiency.model()
    assert settled is not None
    assert settled.harmonics % 2 == 1
    assert settled.error <= SEARCH
    light = source.light_at(points(WIDE, rng, 100))
    apart = np.abs(
        source.model.shares(source.branches, light) - searched.shares(source.branches, light)
    )
    assert apart.max() <= LUCK * SEARCH


def test_many_rays_are_those_of_few(rng: np.random.Generator) -> None:
    spec = hologram("rcwa")
    model, ways = spec.efficiency.model(), node_source(spec, WIDE).branches
    nodes = points(WIDE, rng, 700)
    light_at = node_source(spec, WIDE).light_at
    few = [model.shares(ways, light_at(part)) for part in np.array_split(nodes, 7)]
    assert model.shares(ways, light_at(nodes)) == pytest.approx(np.concatenate(few), abs=ROUNDING)


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
