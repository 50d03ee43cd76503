# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms at their extremes through the shader that Cycles runs, beside numpy."""

from itertools import product
from typing import Any

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable

pytestmark = pytest.mark.render

DROPPED = 1.1e-5
"""Cycles leaves out closures below a weight of 1e-5."""

DIRECTION = 4e-7
"""n s and lambda Q have a few roundings of 1e-7 each: the dephasing turns that into a phase, at
pi d / (lambda n cos) rad for each of it."""

COUPLING = 2e-7
"""Two roundings of nu, each of which a share follows by 1 at most."""

INDEX = 1.5
TRANSMITTED = {"object": [0.3, 0.0, 0.9539392], "reference": [-0.2, 0.1, 0.9746794]}
REFLECTED = {"object": [0.3, 0.0, -0.9539392], "reference": [-0.2, 0.1, 0.9746794]}
STEEP, GRAZING = (1.0, 0.9, 0.6, 0.3), (1e-1, 1e-2, 1e-3)

CASES: dict[str, tuple[dict[str, Any], float, float, tuple[float, ...], int]] = {
    "no coupling": (TRANSMITTED, 10.0, 0.0, (*STEEP, *GRAZING), 0),
    "no coupling, reflection": (REFLECTED, 10.0, 0.0, (*STEEP, *GRAZING), 1),
    "overmodulated": (TRANSMITTED, 60.0, 0.15, STEEP, 1),
    "overmodulated, reflection": (REFLECTED, 60.0, 0.15, STEEP, 1),
    "thick, far off Bragg": (TRANSMITTED, 500.0, 0.001, STEEP, 1),
    "thick, far off Bragg, order 0": (REFLECTED, 500.0, 0.001, STEEP, 0),
    "along the layer": (TRANSMITTED, 1.0, 0.05, GRAZING, 1),
    "along the layer, reflection": (REFLECTED, 1.0, 0.05, GRAZING, 1),
}
"""Waves, thickness in um, modulation, cosines of the light and order."""


def hologram(waves: dict[str, Any], thickness_um: float, modulation: float) -> HologramSpec:
    recording = {
        name: {"kind": "plane", "direction": direction, "index": INDEX}
        for name, direction in waves.items()
    }
    return hologram_from(
        {
            "schema": 1,
            "name": "volume",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"back": INDEX, "front": INDEX},
            "recording": {"wavelength_nm": 532, **recording},
            "efficiency": {
                "model": "kogelnik",
                "thickness_um": thickness_um,
                "index": INDEX,
                "modulation": modulation,
            },
            "orders": [0, 1],
        }
    )


def rays_at(cosines: tuple[float, ...], order: int, *, reflected: bool) -> RayTable:
    """At all azimuths, from both sides, at the wavelength of the recording and beside it."""
    rows = list(product(cosines, np.radians(np.arange(0, 360, 40)), (1, -1), (532, 450, 620)))
    cos, azimuth, side, wavelength = np.array(rows, dtype=np.float64).T
    sin = np.sqrt(1.0 - cos**2)
    travel = np.stack((sin * np.cos(azimuth), sin * np.sin(azimuth), side * cos), axis=1)
    count = len(rows)
    return RayTable(
        -2.0 * travel, travel, wavelength, np.full(count, order), np.full(count, reflected)
    )


@pytest.mark.parametrize("name", CASES)
def test_shares_are_those_of_numpy(name: str) -> None:
    waves, thickness_um, modulation, cosines, order = CASES[name]
    reflected = order == 1 and waves is REFLECTED
    spec = hologram(waves, thickness_um, modulation)
    rays = rays_at(cosines, order, reflected=reflected)
    exact, found = trace(spec, rays), trace_cycles(spec, rays)
    both = (exact.status == Status.OK) & (found.status == Status.OK)
    assert both.mean() > 0.3
    cos_in, cos_out = np.abs(rays.direction[:, 2]), np.abs(exact.direction[:, 2])
    depth = np.pi * thickness_um * 1e-6 / (rays.wavelength_nm * 1e-9)
    lowest = np.maximum(np.minimum(cos_in, cos_out), 1e-3)
    nu = modulation * depth / np.sqrt(np.maximum(cos_in * cos_out, 1e-6))
    # No coupling, no share that could follow the phase.
    phase = np.minimum(nu, 1.0) * depth
    allowed = DROPPED + phase * DIRECTION / (INDEX * lowest) + COUPLING * nu
    error = np.abs(found.efficiency - exact.efficiency)
    assert np.all(error[both] <= allowed[both]), float(np.max((error / allowed)[both]))
    if modulation == 0.0:
        assert np.all(np.abs(found.efficiency[both] - (order == 0)) <= DROPPED)
    else:
        assert np.max(exact.efficiency[both]) > 0.05
