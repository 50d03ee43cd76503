# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables in Cycles against the same tables in numpy: every dimension, and both ways to choose."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.bench.tables import compare_lookups
from hoe_addon.blender.pictures import trace
from hoe_addon.blender.shaders import materials
from hoe_addon.core.efficiency import Incidence, meet
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import mm_to_m, nm_to_m
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import fan
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable
from tests.render.path_bench import PathBench

pytestmark = pytest.mark.render

WAYS = (Branch(0), Branch(1), Branch(-1), Branch(0, reflected=True), Branch(1, reflected=True))
COUNTS = {
    "wavelength": (7, 1, 1, 1, 1),
    "angles": (1, 6, 5, 1, 1),
    "three": (4, 5, 3, 1, 1),
    "place": (1, 1, 1, 5, 4),
    "all": (3, 4, 3, 3, 2),
    "collapsed": (1, 1, 1, 1, 1),
}
INDEX = 1.5
WAVELENGTHS_NM = (400.0, 700.0)

SHARE = 1.5e-5
"""Cycles drops closures below 1e-5. Interpolation in float32 is good to 3e-6 at the slopes here."""

ALIKE = 1.3
"""Root mean square over 64 squares of a difference in its own deviation: 1.0 +- 0.09 by chance."""

PATHS = 8192
SIGMAS = 3.0


@pytest.fixture
def use(monkeypatch: pytest.MonkeyPatch) -> Callable[[EfficiencyTable], None]:
    """Give the shader this table in place of the one of the model."""

    def prepared(table: EfficiencyTable) -> None:
        for module in (materials, trace):
            monkeypatch.setattr(module, "prepare_table", lambda *_args, **_more: table)

    return prepared


@pytest.mark.parametrize("dimensions", COUNTS)
@pytest.mark.parametrize("beyond", ["clamp", pytest.param("zero", marks=pytest.mark.slow)])
def test_interpolation_is_that_of_numpy(
    use: Callable[[EfficiencyTable], None],
    rng: np.random.Generator,
    dimensions: str,
    beyond: str,
) -> None:
    """Random numbers at uneven nodes, which do not reach as far as the rays, on both sides."""
    table = replace(_table(rng, COUNTS[dimensions]), beyond=beyond)
    spec = _hologram()
    rays = _rays(rng, 1000)
    use(table)
    found = trace.trace_cycles(spec, rays)
    light = _light(spec, rays.origin_mm + rays.direction, rays.direction, rays.wavelength_nm)
    shares = table.shares(WAYS, light)
    column = [WAYS.index(Branch(m, reflected=r)) for m, r in _ways_of(rays)]
    expected = shares[np.arange(len(rays)), column]
    met = (found.status == Status.OK) & ~_at_an_end(table, light)
    assert met.mean() > 0.5
    if beyond == "zero" and dimensions in ("wavelength", "angles", "three", "all"):
        assert np.any(expected[met] == 0.0)
    assert np.max(np.abs(found.efficiency - expected)[met]) < SHARE


@pytest.mark.parametrize("choice", ["bilinear", "stochastic"])
def test_both_choices_give_the_mean_of_the_table(
    clean_scene: Any, use: Callable[[EfficiencyTable], None], rng: np.random.Generator, choice: str
) -> None:
    """Energy by order of 20 walked rays at places of their own, each within 3 deviations."""
    count = 20
    table = _table(rng, (3, 4, 3, 3, 1))
    spec = _hologram(choice)
    way = rng.uniform(-0.3, 0.3, (count, 2))
    height = np.sqrt(1.0 - np.sum(way**2, axis=1)) * np.where(np.arange(count) % 2, -1.0, 1.0)
    heading = np.concatenate((way, height[:, None]), axis=1)
    wavelength_nm = rng.uniform(*WAVELENGTHS_NM, count)
    place_mm = np.arange(count)[:, None] * np.array((1.0, 0.0, 0.0))
    out = fan(spec, place_mm, heading, wavelength_nm, WAYS)
    shares = table.shares(WAYS, _light(spec, place_mm, heading, wavelength_nm))
    expected = np.where(out.status == int(Status.OK), shares, 0.0)
    use(table)
    bench = PathBench(clean_scene, spec, heading, wavelength_nm)
    deviation = np.sqrt(expected * (1.0 - expected) / PATHS)
    off = [
        np.abs(_energies(bench.answers(PATHS, seed), out.directions) - expected)
        > SIGMAS * deviation + SHARE
        for seed in (1, 2)
    ]
    # One that is off by chance is not so in two independent pictures.
    assert not np.any(off[0] & off[1])
    assert np.mean(off) < 0.02


def test_more_than_all_light_is_scaled_down(
    clean_scene: Any, use: Callable[[EfficiencyTable], None]
) -> None:
    """Walked backward, a model that is not reciprocal may give more than all: 0.9 and 0.6."""
    made = _table(np.random.default_rng(1), (1, 1, 1, 1, 1))
    values = np.zeros_like(made.values)
    values[..., 0] = 0.9
    made = replace(made, values=values)
    # Such a table is never read from a file; rows of walked rays are not checked for their sum.
    made.values[..., 1] = 0.6
    heading = np.array(((0.1, 0.0, 1.0), (0.0, 0.1, -1.0))) / np.sqrt(1.01)
    spec = _hologram("stochastic")
    out = fan(spec, (0.0, 0.0, 0.0), heading, 550.0, WAYS)
    use(made)
    bench = PathBench(clean_scene, spec, heading, np.full(2, 550.0))
    energy = _energies(bench.answers(PATHS, 1), out.directions)
    deviation = np.sqrt(0.6 * 0.4 / PATHS)
    assert np.all(np.abs(energy[:, :2] - (0.6, 0.4)) < SIGMAS * deviation)


@pytest.mark.slow
def test_all_forms_give_the_same_picture() -> None:
    """Formula, interpolated and drawn: the mean is the same, and drawing has the larger scatter."""
    formula, bilinear, stochastic = compare_lookups()
    assert formula.time_to_error == 1.0
    # The first two take the same random numbers, so they differ by less than their scatter.
    assert bilinear.difference < ALIKE
    assert 0.5 < stochastic.difference < ALIKE
    assert bilinear.deviation == pytest.approx(formula.deviation, rel=0.01)
    assert stochastic.deviation > bilinear.deviation


def _hologram(choice: str = "bilinear") -> HologramSpec:
    shares = {"T": {"0": 0.2, "1": 0.2, "-1": 0.2}, "R": {"0": 0.2, "1": 0.2}}
    lookup = {"form": "table", "choice": choice}
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [60, 40]},
            "media": {"back": 1.0, "front": INDEX},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.25, 0.15, 0.957]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": {"model": "constant", "table": shares, "lookup": lookup},
            "orders": [-1, 0, 1],
        }
    )


def _table(rng: np.random.Generator, counts: tuple[int, ...]) -> EfficiencyTable:
    """Random shares that sum to 0.97, at nodes of uneven distance that cover most of the rays."""
    ends = ((420e-9, 690e-9), (-0.7, 0.75), (-0.6, 0.7), (-0.012, 0.02), (-0.015, 0.011))
    axes: list[NDArray[np.float64]] = []
    for (low, high), count in zip(ends, counts, strict=True):
        steps = np.cumsum(rng.uniform(0.5, 1.5, count))
        spread = (steps - steps[0]) / max(steps[-1] - steps[0], 1e-9)
        axes.append(low + (high - low) * spread)
    values = rng.random((2, *counts, len(WAYS) + 1)) ** 2
    values *= 0.97 / values.sum(axis=-1, keepdims=True)
    wavelength, along, across, x, y = axes
    sides = ("front", "back")
    return EfficiencyTable(WAYS, wavelength, along, across, x, y, sides, values[..., :-1])


def _rays(rng: np.random.Generator, count: int) -> RayTable:
    hit = np.concatenate((rng.uniform(-19, 19, (count, 2)), np.zeros((count, 1))), axis=1)
    cosine = rng.uniform(0.3, 1.0, count)
    sine, phi = np.sqrt(1.0 - cosine**2), rng.uniform(0.0, 2.0 * np.pi, count)
    side = rng.choice([-1.0, 1.0], count)
    direction = np.stack((sine * np.cos(phi), sine * np.sin(phi), side * cosine), axis=1)
    chosen = rng.integers(0, len(WAYS), count)
    return RayTable(
        hit - direction,
        direction,
        rng.uniform(*WAVELENGTHS_NM, count),
        np.array([way.order for way in WAYS])[chosen],
        np.array([way.reflected for way in WAYS])[chosen],
    )


def _ways_of(rays: RayTable) -> list[tuple[int, bool]]:
    return list(zip(rays.order.tolist(), rays.reflected.tolist(), strict=True))


def _light(
    spec: HologramSpec,
    place_mm: NDArray[np.float64],
    heading: NDArray[np.float64],
    wavelength_nm: NDArray[np.float64],
) -> Incidence:
    normal = np.array((0.0, 0.0, 1.0))
    pattern, wavelength = pattern_from(spec.pattern), nm_to_m(wavelength_nm)
    return meet(pattern, mm_to_m(place_mm), None, normal, heading, wavelength, (1.0, INDEX))[1]


def _at_an_end(table: EfficiencyTable, light: Incidence) -> NDArray[np.bool_]:
    """Rays so near to the end of an axis that float32 could take them for the other side."""
    cosines = light.tangential / light.index_in[..., None]
    seen = (light.wavelength, cosines[..., 0], cosines[..., 1])
    near = [
        np.min(np.abs(value[:, None] - nodes[[0, -1]]), axis=1) < 1e-5 * np.ptp(nodes)
        for nodes, value in zip(table.axes, seen, strict=False)
        if len(nodes) > 1
    ]
    return np.any([np.zeros(light.shape, dtype=np.bool_), *near], axis=0)


def _energies(answers: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.float64]:
    weight = np.linalg.norm(answers, axis=-1)
    way = answers / np.where(weight > 0.0, weight, 1.0)[..., None]
    apart = np.linalg.norm(way[:, :, None] - directions[:, None], axis=-1)
    return np.mean(np.where(apart < 1e-4, weight[..., None], 0.0), axis=1)
