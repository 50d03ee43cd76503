# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of a rigorous grating, read by Cycles where its efficiencies have their kinks."""

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.pictures import trace
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.rcwa import PlaneWaves, solve
from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable
from tests.hard_cases.exact_gratings import Lit, Slab
from tests.hard_cases.test_rcwa import AIR, GLASS, GRATING, METAL, stack_of

WAYS = (Branch(0), Branch(0, reflected=True))
SHARE = 2.5e-5
"""Cycles drops closures below 1e-5. A cosine has a rounding of 1e-7: in cells of 1e-4 that is 1e-3
of the way to the next node, whose shares differ by 1e-2."""


@pytest.mark.render
@pytest.mark.parametrize("slab", [GRATING, METAL])
@pytest.mark.parametrize("branch", [0, 1])
def test_table_in_cycles_at_its_nodes(
    monkeypatch: pytest.MonkeyPatch, slab: Slab, branch: int
) -> None:
    """Nodes at, just inside and just outside of an anomaly, at theta = 0 and at azimuth 90."""
    index, step = 1.5, 0.5
    along = np.array((-0.6, 0.0, 0.5, 1.0 - 1e-4, 1.0, 1.0 + 1e-4, 1.2)) / index
    across = np.array((0.0, 1e-4, 0.7)) / index
    grid = np.stack(np.meshgrid(along, across, indexing="ij"), axis=-1)
    stack, materials = stack_of((slab,), Lit(0.0, 0.0, step, GLASS, AIR))
    cosines = grid.reshape(-1, 2)
    waves = PlaneWaves.of(1.0, tuple(index * cosines.T), 1.0 / step, materials)
    solved = solve(stack, waves, 21)
    zero = solved.place(0)
    values = np.stack(
        [part[:, zero].mean(axis=1) for part in (solved.transmitted, solved.reflected)], axis=-1
    )
    table = EfficiencyTable(
        WAYS,
        np.array((532e-9,)),
        along,
        across,
        np.zeros(1),
        np.zeros(1),
        ("back",),
        values.reshape(1, 1, len(along), len(across), 1, 1, 2),
    )
    monkeypatch.setattr(trace, "prepare_table", lambda *_args, **_more: table)
    # Beyond the critical angle the transmitted order 0 does not exist.
    leaves = np.hypot(*cosines.T) * index < (index if WAYS[branch].reflected else 0.99999)
    seen = trace.trace_cycles(_grating(), _rays(cosines[leaves], WAYS[branch]))
    assert np.all(seen.status == int(Status.OK))
    assert np.max(np.abs(seen.efficiency - values[leaves, branch])) < SHARE


def _rays(cosines: NDArray[np.float64], way: Branch) -> RayTable:
    height = np.sqrt(1.0 - np.sum(cosines**2, axis=1))
    direction = np.column_stack((cosines, height))
    count = len(cosines)
    reflected = np.full(count, way.reflected)
    return RayTable(
        -direction, direction, np.full(count, 532.0), np.full(count, way.order), reflected
    )


def _grating() -> HologramSpec:
    """Lines along y, wavelength over period 1/2, under glass; the model is that of the table."""
    shares_of_any = {"T": {"0": 0.5}, "R": {"0": 0.5}}
    return hologram_from(
        {
            "schema": 1,
            "name": "rigorous",
            "surface": {"shape": "plane", "size_mm": [10, 10]},
            "media": {"back": 1.5, "front": 1.0},
            "characteristic": {
                "kind": "linear",
                "wavelength_nm": 532,
                "lines_per_mm": 0.5 / 532e-6,
            },
            "efficiency": {
                "model": "constant",
                "table": shares_of_any,
                "lookup": {"form": "table"},
            },
            "orders": [0],
        }
    )
