# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each order gets the energy of its model in Cycles: by formula, by table, and drawn from a table.

Twenty rays of random directions and wavelengths, half of them onto each side, meet a grating, each
at a place of its own. Every pixel follows one path and answers with the direction in which it left,
times its weight. Cycles walks backward, so what an order has to get is the share of the light that
takes it: of the ray that comes in against the one that left. A table has these shares in it; how
near it is to its model is another question.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.shaders import materials
from hoe_addon.core.efficiency import meet
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch, order_weights
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import nm_to_m
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import fan
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.medium import medium_from
from hoe_addon.model.tables.making import bake_hologram
from hoe_addon.model.tables.npz import write_npz
from tests.render.path_bench import PathBench

pytestmark = pytest.mark.render

RAYS = 20
PATHS = 8192
"""Paths of one ray: the standard deviation of an energy is at most 0.0055."""

SIGMAS = 3.0
ROUNDING = 2e-5
"""Of a share in float32, and closures that Cycles drops, as in test_energy."""

SAME_WAY = 1e-4
"""Directions of one order agree to this."""

TOLERANCE, LARGEST = 0.02, 4000
"""Of the tables, which are coarse, so that they are soon made."""

APART = 1e-2
"""Rays are chosen so that directions of different orders, and cut-offs, are further off."""

UNLIKELY = 4.0
"""Standard deviations of a chi-square (as a normal number): one right picture in 30,000."""

CONSTANT = {
    "model": "constant",
    "table": {
        "T": {"0": 0.3, "1": 0.25, "-1": 0.1, "2": 0.05},
        "R": {"0": 0.05, "1": 0.1, "-2": 0.02},
    },
}
FOLDING = {
    "model": "constant",
    "table": {"T": {"0": 0.5, "1": 0.2}, "R": {"-1": 0.2}},
    "total_internal_reflection": True,
}
KINOFORM = {"model": "kinoform", "levels": 4, "design_wavelength_nm": 380, "relief": "PMMA"}
VOLUME = {"model": "kogelnik", "thickness_um": 6, "index": 1.5, "modulation": 0.03}
RIGOROUS = {
    "model": "rcwa",
    "profile": {"shape": "binary", "depth_um": 0.4, "duty": 0.5},
    "ridge": 1.5,
    "harmonics": 7,
}
FROM_FILE = {"model": "table"}
MODELS: dict[str, tuple[dict[str, Any], list[int]]] = {
    "constant": (CONSTANT, [-2, -1, 0, 1, 2]),
    "folding": (FOLDING, [-1, 0, 1]),
    "kinoform": (KINOFORM, [-1, 0, 1, 2]),
    "kogelnik": (VOLUME, [-1, 0, 1]),
    "rcwa": (RIGOROUS, [-1, 0, 1]),
    "table": (FROM_FILE, [-1, 0, 1]),
}
LOOKUPS: dict[str, dict[str, Any]] = {
    "formula": {"form": "formula"},
    "bilinear": {"form": "table"},
    "stochastic": {"form": "table", "choice": "stochastic"},
}
FORMLESS = {"rcwa", "table"}
"""Models without a formula in the shader."""

SLOW = {"rcwa"}
"""Models whose tables take their time."""


def _is_slow(model: str, lookup: str) -> bool:
    """One model is enough for the quick tests to try both look-ups."""
    return model in SLOW or (lookup != "formula" and model != "kinoform")


CASES = [
    pytest.param(model, lookup, marks=[pytest.mark.slow] if _is_slow(model, lookup) else [])
    for model in MODELS
    for lookup in LOOKUPS
    if lookup != "formula" or model not in FORMLESS
]


@pytest.mark.parametrize(("model", "lookup"), CASES)
def test_every_order_gets_the_energy_of_its_model(
    clean_scene: Any,
    rng: np.random.Generator,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    model: str,
    lookup: str,
) -> None:
    """Each within 3 standard deviations; one that is not is measured again, by itself."""
    efficiency, orders = MODELS[model]
    if model == "table":
        efficiency = efficiency | {"file": _file(tmp_path / "table.npz", rng)}
    spec = _hologram(efficiency | {"lookup": LOOKUPS[lookup]}, orders)
    direction, wavelength_nm = _rays(spec, rng)
    ways = _ways(spec)
    out = fan(spec, (0.0, 0.0, 0.0), direction, wavelength_nm, ways)
    expected = _by_model(spec, direction, wavelength_nm, ways)
    if lookup != "formula":
        table = bake_hologram(spec, TOLERANCE, backward=True, largest=LARGEST).table
        monkeypatch.setattr(materials, "prepare_table", lambda *_, **__: table)
        expected = _by_table(spec, table, direction, wavelength_nm, ways)
    assert np.sum(expected > 0.01) > 1.5 * RAYS
    bench = PathBench(clean_scene, spec, direction, wavelength_nm)
    first, again = (
        _energies(bench.answers(PATHS, seed), out.directions, expected) for seed in (1, 2)
    )
    sigma = _sigma(expected, lookup)
    for measured in (first, again):
        assert np.all(measured[expected == 0.0] == 0.0)
        assert _chi_square(measured, expected, sigma) < UNLIKELY
    off = [np.abs(measured - expected) > SIGMAS * sigma + ROUNDING for measured in (first, again)]
    assert not np.any(off[0] & off[1])


def test_wrong_energies_are_seen() -> None:
    """The bounds above tell a share of 0.10 from one of 0.12, and 20 of 0.11 from 20 of 0.10."""
    expected = np.full((RAYS, 1), 0.1)
    sigma = _sigma(expected, "stochastic")
    assert SIGMAS * sigma[0, 0] + ROUNDING < 0.02
    assert _chi_square(expected + 0.01, expected, sigma) > UNLIKELY


def _hologram(efficiency: dict[str, Any], orders: list[int]) -> HologramSpec:
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [4 * RAYS, 4 * RAYS]},
            "media": {"back": 1.0, "front": "N-BK7"},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.3, 0.1, 0.949]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": efficiency,
            "orders": orders,
        }
    )


def _file(path: Path, rng: np.random.Generator) -> str:
    """A file of random shares that sum to 0.9, by wavelength and angle, from either side."""
    values = rng.random((2, 3, 4, 1, 1, 1, 7))
    values *= 0.9 / values.sum(axis=-1, keepdims=True)
    ways = tuple(Branch(order, reflected=side) for side in (False, True) for order in (-1, 0, 1))
    one = np.zeros(1)
    wavelength, along = np.linspace(4e-7, 7e-7, 3), np.linspace(-0.9, 0.9, 4)
    sides = ("back", "front")
    table = EfficiencyTable(ways, wavelength, along, one, one, one, sides, values[..., :-1])
    write_npz(path, table)
    return str(path)


def _ways(spec: HologramSpec) -> list[Branch]:
    ways = list(spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm))
    if spec.efficiency.total_internal_reflection:
        ways += [way for way in (TRANSMITTED_ZERO, REFLECTED_ZERO) if way not in ways]
    return ways


def _rays(
    spec: HologramSpec, rng: np.random.Generator
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Random rays whose orders all go different ways, and none of them near to a cut-off."""
    count = 40 * RAYS
    cosine = rng.uniform(0.35, 1.0, count) * np.where(np.arange(count) % 2, -1.0, 1.0)
    phi = rng.uniform(0.0, 2.0 * np.pi, count)
    sine = np.sqrt(1.0 - cosine**2)
    direction = np.stack((sine * np.cos(phi), sine * np.sin(phi), cosine), axis=1)
    wavelength_nm = rng.uniform(400.0, 700.0, count)
    found = fan(spec, (0.0, 0.0, 0.0), direction, wavelength_nm, _ways(spec))
    steady = np.ones(count, dtype=np.bool_)
    for factor in (1.0 - APART, 1.0 + APART):
        moved = fan(spec, (0.0, 0.0, 0.0), direction, factor * wavelength_nm, _ways(spec))
        steady &= np.all(moved.status == found.status, axis=-1)
    way = np.nan_to_num(found.directions, nan=9.0)
    apart = np.linalg.norm(way[:, :, None] - way[:, None], axis=-1)
    apart[np.broadcast_to(np.eye(way.shape[1], dtype=np.bool_), apart.shape)] = np.inf
    gone = found.status != int(Status.OK)
    apart[gone[:, :, None] | gone[:, None, :]] = np.inf
    steady &= np.all(apart > APART, axis=(1, 2))
    front = np.flatnonzero(steady & (cosine < 0.0))[: RAYS // 2]
    back = np.flatnonzero(steady & (cosine > 0.0))[: RAYS // 2]
    chosen = np.concatenate((front, back))
    assert len(chosen) == RAYS
    return direction[chosen], wavelength_nm[chosen]


def _by_model(
    spec: HologramSpec,
    direction: NDArray[np.float64],
    wavelength_nm: NDArray[np.float64],
    ways: list[Branch],
) -> NDArray[np.float64]:
    """Share of the light of each order: it comes in against the order's own direction."""
    out = fan(spec, (0.0, 0.0, 0.0), direction, wavelength_nm, ways)
    shares = np.zeros(out.weights.shape)
    for place in range(len(ways)):
        met = out.status[:, place] == int(Status.OK)
        back = fan(spec, (0.0, 0.0, 0.0), -out.directions[met, place], wavelength_nm[met], ways)
        assert np.allclose(back.directions[:, place], -direction[met], atol=1e-9)
        shares[met, place] = back.weights[:, place]
    # The shader scales what is more than all light down: two-wave theory is not quite reciprocal.
    return shares / np.maximum(shares.sum(axis=-1, keepdims=True), 1.0)


def _by_table(
    spec: HologramSpec,
    table: EfficiencyTable,
    direction: NDArray[np.float64],
    wavelength_nm: NDArray[np.float64],
    ways: list[Branch],
) -> NDArray[np.float64]:
    """Shares of the table that the shader has: its rays are those that are walked."""
    wavelength = nm_to_m(wavelength_nm)
    indices = [medium_from(medium).index(wavelength) for medium in (1.0, "N-BK7")]
    origin, normal = np.zeros(3), np.array((0.0, 0.0, 1.0))
    pattern = pattern_from(spec.pattern)
    gradient, ray = meet(
        pattern, origin, None, normal, direction, wavelength, (indices[0], indices[1])
    )
    return order_weights(
        ways,
        table.shares(ways, ray),
        direction,
        normal,
        gradient,
        wavelength_nm / spec.pattern.wavelength_nm,
        ray.index_in,
        ray.index_out,
        total_internal_reflection=spec.efficiency.total_internal_reflection,
    ).weights


def _energies(
    answers: NDArray[np.float64],
    directions: NDArray[np.float64],
    expected: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Mean weight of the paths that left in each order; every path must have left in one."""
    weight = np.linalg.norm(answers, axis=-1)
    way = answers / np.where(weight > 0.0, weight, 1.0)[..., None]
    energy = np.zeros(expected.shape)
    counted = weight == 0.0
    for place in range(expected.shape[1]):
        there = np.linalg.norm(way - directions[:, None, place], axis=-1) < SAME_WAY
        energy[:, place] = np.mean(np.where(there & (weight > 0.0), weight, 0.0), axis=1)
        counted |= there
    assert counted.all()
    return energy


def _sigma(expected: NDArray[np.float64], lookup: str) -> NDArray[np.float64]:
    """Standard deviation of each energy: one path takes one order, or none.

    Cycles chooses among closures by their weights and gives the path the sum of them; a drawn order
    has a weight of 1.
    """
    total = expected.sum(axis=-1, keepdims=True)
    whole = np.ones_like(total) if lookup == "stochastic" else np.maximum(total, 1e-12)
    return np.sqrt(expected * np.maximum(whole - expected, 0.0) / PATHS)


def _chi_square(
    measured: NDArray[np.float64], expected: NDArray[np.float64], sigma: NDArray[np.float64]
) -> float:
    """Sum of squared deviations as a standard normal number (Wilson and Hilferty, 1931).

    Neighbouring shares of one ray are slightly dependent, which makes the sum smaller, if anything.
    """
    seen = sigma > 10.0 * ROUNDING
    count = int(seen.sum())
    total = float(np.sum(((measured - expected)[seen] / sigma[seen]) ** 2))
    ninth = 2.0 / (9.0 * count)
    return ((total / count) ** (1.0 / 3.0) - (1.0 - ninth)) / np.sqrt(ninth)
