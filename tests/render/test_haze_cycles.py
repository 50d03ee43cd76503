# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Haze in Cycles: as much as was asked for, of the lobe of numpy, and no energy lost."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.haze import rough_share, scattered
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import fan
from hoe_addon.model.hologram import HologramSpec
from tests.render.path_bench import PathBench

pytestmark = pytest.mark.render

PATHS = 8192
BINS = 8
"""Along the radius and around it; each of the 64 cells gets some 60 scattered paths or more."""

UNLIKELY = 4.0
"""Standard deviations of a chi-square (as a normal number): one right picture in 30,000."""

SIGMAS = 4.0
FLOAT32 = 2e-6
"""Some 30 roundings, for weights near 1."""

SAME_WAY = 1e-5
"""A path that is this near to its order was not scattered; the lobes are 10,000 times as wide."""

WAVELENGTH_NM = 550.0
WIDTH_DEG = 6.0
INDEX = 1.5


@pytest.mark.parametrize("side", ["T", "R"])
@pytest.mark.parametrize("toward", [1.0, -1.0])
def test_lobe_is_that_of_numpy(
    clean_scene: Any, rng: np.random.Generator, side: str, toward: float
) -> None:
    """Share, radius and azimuth of the offsets, from both sides, transmitted and reflected."""
    share = 0.6
    spec = _hologram({"share": share, "width_deg": WIDTH_DEG}, side)
    heading = np.array(((-0.2, 0.1, toward), (-0.3, -0.1, toward), (0.0, 0.0, toward)))
    heading /= np.linalg.norm(heading, axis=1, keepdims=True)
    order, leaving, entered = _order(spec, heading, side)
    answers = _answers(clean_scene, spec, heading)
    assert np.max(np.abs(np.linalg.norm(answers, axis=-1) - 1.0)) < FLOAT32
    sine = np.sin(np.radians(WIDTH_DEG)) * entered / leaving
    draws = rng.random((len(heading), PATHS, 3))
    expected = scattered(
        np.repeat(order[:, None], PATHS, axis=1), (0.0, 0.0, 1.0), sine[:, None], share, draws
    )
    for found in (answers, expected):
        moved = np.linalg.norm(found - order[:, None], axis=-1) > SAME_WAY
        assert np.all(np.abs(moved.mean(axis=1) - share) < SIGMAS * _sigma(share))
        for ray, deviation in enumerate(sine):
            offset = (found[ray, moved[ray]] - order[ray])[:, :2] / deviation
            assert _chi_square(_cells(offset)) < UNLIKELY


def test_light_that_cannot_be_scattered_keeps_its_way(
    clean_scene: Any, rng: np.random.Generator
) -> None:
    """Near grazing a part of the lobe is evanescent; as many paths as in numpy keep their way."""
    spec = _hologram({"share": 1.0, "width_deg": WIDTH_DEG}, "R")
    heading = np.array(((-0.3, 0.86, np.sqrt(1.0 - 0.09 - 0.86**2)),))
    order, _leaving, _entered = _order(spec, heading, "R")
    answers = _answers(clean_scene, spec, heading)
    assert np.max(np.abs(np.linalg.norm(answers, axis=-1) - 1.0)) < FLOAT32
    many = np.repeat(order, 20 * PATHS, axis=0)
    sine = np.sin(np.radians(WIDTH_DEG))
    ways = scattered(many, (0.0, 0.0, 1.0), sine, 1.0, rng.random((len(many), 3)))
    kept = np.mean(np.all(ways == many, axis=-1))
    assert 0.1 < kept < 0.5
    same = np.linalg.norm(answers[0] - order[0], axis=-1) < SAME_WAY
    assert abs(same.mean() - kept) < SIGMAS * _sigma(kept)


@pytest.mark.parametrize("side", ["T", "R"])
def test_roughness_tells_the_share(clean_scene: Any, side: str) -> None:
    roughness_nm = {"T": 60.0, "R": 20.0}[side]
    spec = _hologram({"roughness_nm": roughness_nm, "width_deg": WIDTH_DEG}, side)
    heading = np.array(((0.2, -0.1, 0.9), (-0.5, 0.4, -0.8), (0.0, 0.0, -1.0)))
    heading /= np.linalg.norm(heading, axis=1, keepdims=True)
    order, leaving, entered = _order(spec, heading, side)
    cosines = entered * np.abs(heading[:, 2]), leaving * np.abs(order[:, 2])
    share = rough_share(roughness_nm, WAVELENGTH_NM, *cosines, reflected=side == "R")
    assert np.all((share > 0.02) & (share < 0.9))
    answers = _answers(clean_scene, spec, heading)
    moved = np.linalg.norm(answers - order[:, None], axis=-1) > SAME_WAY
    assert np.all(np.abs(moved.mean(axis=1) - share) < SIGMAS * _sigma(share))


def test_haze_is_drawn_apart_from_the_order(clean_scene: Any) -> None:
    """With orders that are drawn from a table, too, each gets its share of the haze."""
    share = 0.4
    table = {"T": {"0": 0.5, "1": 0.5}}
    lookup = {"form": "table", "choice": "stochastic"}
    haze = {"share": share, "width_deg": 0.5}
    efficiency = {"model": "constant", "table": table, "lookup": lookup, "haze": haze}
    spec = _hologram_with(efficiency, [0, 1])
    heading = np.array(((0.0, 0.1, np.sqrt(0.99)),))
    out = fan(spec, (0.0, 0.0, 0.0), heading, WAVELENGTH_NM, spec.efficiency.branches([0, 1], 532))
    answers = _answers(clean_scene, spec, heading)[0]
    for way in out.directions[0]:
        near = np.linalg.norm(answers - way, axis=-1)
        assert abs(np.mean(near < 0.1) - 0.5) < SIGMAS * _sigma(0.5)
        moved = (near > SAME_WAY) & (near < 0.1)
        assert abs(moved.mean() - 0.5 * share) < SIGMAS * _sigma(0.5 * share)


def _hologram(haze: dict[str, float], side: str) -> HologramSpec:
    efficiency = {"model": "constant", "table": {side: {"1": 1.0}}, "haze": haze}
    return _hologram_with(efficiency, [1])


def _hologram_with(efficiency: dict[str, Any], orders: list[int]) -> HologramSpec:
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"back": 1.0, "front": INDEX},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.3, 0.1, 0.949]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": efficiency,
            "orders": orders,
        }
    )


def _order(
    spec: HologramSpec, heading: NDArray[np.float64], side: str
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Direction of the one order, the index it leaves into, and the index it comes from."""
    ways = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    out = fan(spec, (0.0, 0.0, 0.0), heading, WAVELENGTH_NM, ways)
    entered = np.where(heading[:, 2] > 0.0, 1.0, INDEX)
    other = np.where(heading[:, 2] > 0.0, INDEX, 1.0)
    return out.directions[:, 0], entered if side == "R" else other, entered


def _answers(scene: Any, spec: HologramSpec, heading: NDArray[np.float64]) -> NDArray[np.float64]:
    wavelength_nm = np.full(len(heading), WAVELENGTH_NM)
    return PathBench(scene, spec, heading, wavelength_nm).answers(PATHS, seed=1)


def _cells(offset: NDArray[np.float64]) -> NDArray[np.int64]:
    """Count offsets in cells that the Gaussian lobe fills evenly."""
    inside = 1.0 - np.exp(-0.5 * np.sum(offset**2, axis=-1))
    turn = (np.arctan2(offset[:, 1], offset[:, 0]) / (2.0 * np.pi)) % 1.0
    return np.histogram2d(inside, turn, bins=BINS, range=((0.0, 1.0), (0.0, 1.0)))[0].astype(int)


def _chi_square(counts: NDArray[np.int64]) -> float:
    """How uneven counts are, as a standard normal number (Wilson and Hilferty, 1931)."""
    mean, free = counts.mean(), counts.size - 1
    total = float(np.sum((counts - mean) ** 2) / mean)
    ninth = 2.0 / (9.0 * free)
    return ((total / free) ** (1.0 / 3.0) - (1.0 - ninth)) / np.sqrt(ninth)


def _sigma(share: Any) -> Any:
    return np.sqrt(share * (1.0 - share) / PATHS)
