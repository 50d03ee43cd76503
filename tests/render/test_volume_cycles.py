# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms in Cycles against numpy: directions and efficiencies of random rays."""

from typing import Any

import numpy as np
import pytest

from hoe_addon.blender.pictures import trace as probe
from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.arrays import unit
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import m_to_mm, mm_to_m
from hoe_addon.model.document import hologram_from
from hoe_addon.model.element import element_shape
from hoe_addon.model.evaluate import fan, trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable
from hoe_addon.shading.hologram import one_order_shader
from hoe_addon.shading.source import ShaderSource

pytestmark = pytest.mark.render

EFFICIENCY = 6e-5
"""float32: at 20 um a rounding of n s (1e-7) is some 2e-5 rad of dephasing, a few of which add up;
and Cycles drops what weighs less than 1e-5."""
DIRECTION, FROM_ELSEWHERE = 2e-6, 2e-5
"""rad, as for any hologram; the second where a curved surface or a map has a part in it."""
GRAZING = 5e-7
"""rad times cos: what a rounding does to a ray toward grazing."""
RAYS = 500

PLANE = {"shape": "plane", "size_mm": [20, 20]}
SPHERE = {"shape": "sphere", "size_mm": [20, 20], "radius_mm": 80}
PLANE_MIRROR = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0.2, 0.1, -1]},
    "reference": {"kind": "plane", "direction": [-0.1, 0.3, 1]},
}
POINT_MIRROR = {
    "wavelength_nm": 532,
    "object": {"kind": "point", "position_mm": [10, 5, 60]},
    "reference": {"kind": "plane", "direction": [0.3, 0.1, 1]},
}
POINTS = {
    "wavelength_nm": 532,
    "object": {"kind": "point", "position_mm": [30, 5, -60]},
    "reference": {"kind": "point", "position_mm": [-40, 0, -90]},
}
LINES = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 1200, "azimuth_deg": 30}
SYSTEM = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [2, 1, -110], "medium": "air"},
    "surfaces": [
        {
            "shape": "sphere",
            "vertex_mm": [0, 0, -60],
            "radius_mm": 50,
            "semi_diameter_mm": 16,
            "medium": "N-BK7",
        },
        {"shape": "plane", "vertex_mm": [0, 0, -52], "semi_diameter_mm": 16, "medium": 1.0},
    ],
}
EDGE_LIT = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0.9, 0, 0.6], "index": 1.5},
    "reference": {"kind": "plane", "direction": [0, 0, 1]},
}
ABSORBING = {
    "thickness_um": 20,
    "absorption_per_mm": 10,
    "absorption_modulation_per_mm": 5,
    "shrinkage": 0.02,
    "index_shift": 0.01,
}
THREE = {
    "index": "N-BK7",
    "thickness_um": {"formula": "10 + 0.1*x"},
    "exposures": [
        {"wavelength_nm": 633, "modulation": 0.02},
        {"wavelength_nm": 450, "modulation": {"formula": "0.02 + 0.001*y"}},
    ],
}

CASES: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, Any], tuple[float, float]]] = {
    "plane waves, reflection": ({"recording": PLANE_MIRROR}, {}, PLANE, (1.0, 1.0)),
    "points, transmission": ({"recording": POINTS}, {"thickness_um": 20}, PLANE, (1.0, 1.0)),
    "point, reflection, developed": ({"recording": POINT_MIRROR}, ABSORBING, PLANE, (1.0, 1.0)),
    "on a glass sphere": ({"recording": POINT_MIRROR}, {}, SPHERE, (1.5168, 1.0)),
    "three colours": ({"recording": POINT_MIRROR}, THREE, PLANE, (1.0, 1.2)),
    "slanted lines": ({"characteristic": LINES}, {"normal_period_um": -2}, PLANE, (1.5, 1.0)),
    "order that cannot leave": (
        {"recording": EDGE_LIT},
        {"total_internal_reflection": True},
        PLANE,
        (1.5, 1.0),
    ),
    "object wave from a map": (
        {"recording": {**POINTS, "object": SYSTEM}},
        {},
        {"shape": "plane", "size_mm": [10, 10]},
        (1.0, 1.0),
    ),
}


def hologram(name: str) -> HologramSpec:
    pattern, fields, surface, (back, front) = CASES[name]
    return hologram_from(
        {
            "schema": 1,
            "name": name,
            "surface": surface,
            "media": {"back": back, "front": front},
            **pattern,
            "efficiency": {
                "model": "kogelnik",
                "thickness_um": 12,
                "index": 1.5,
                "modulation": 0.03,
                **fields,
            },
        }
    )


def random_rays(
    spec: HologramSpec, rng: np.random.Generator, order: int, *, side: bool
) -> RayTable:
    """From both sides, at all visible wavelengths."""
    reach = 0.45 * spec.surface.size_mm[0]
    xy = mm_to_m(rng.uniform(-reach, reach, (RAYS, 2)))
    place_mm = m_to_mm(np.column_stack((xy, element_shape(spec).sag(xy[:, 0], xy[:, 1]))))
    sign = np.where(np.arange(RAYS) % 2, 1.0, -1.0)
    travel = unit(np.column_stack((rng.uniform(-0.8, 0.8, (RAYS, 2)), sign)))
    return RayTable(
        place_mm - 5.0 * travel,
        travel,
        rng.uniform(420.0, 680.0, RAYS),
        np.full(RAYS, order),
        np.full(RAYS, side),
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_cycles_gives_what_numpy_gives(name: str, rng: np.random.Generator) -> None:
    spec = hologram(name)
    plain = "sphere" not in name and "map" not in name
    largest = 0.0
    for order, side in ((0, False), (1, False), (1, True), (-1, False), (-1, True)):
        rays = random_rays(spec, rng, order, side=side)
        exact, found = trace(spec, rays), trace_cycles(spec, rays)
        going = (exact.status == Status.OK) & (found.status == Status.OK)
        assert (exact.status != found.status).sum() <= 2  # at the edge of evanescence
        error = np.abs(found.efficiency - exact.efficiency)[going]
        assert error.max() < EFFICIENCY, (order, side, error.max())
        turned = np.linalg.norm(found.direction - exact.direction, axis=1)[going]
        steep = np.abs(exact.direction[going, 2])
        allowed = np.maximum(DIRECTION if plain else FROM_ELSEWHERE, GRAZING / steep)
        assert (turned < allowed).all(), (turned / allowed).max()
        if order != 0:
            largest = max(largest, float(exact.efficiency[going].max()))
    assert largest > 0.3


@pytest.mark.parametrize("name", ["points, transmission", "three colours"])
def test_a_picture_has_the_shares_of_the_light(
    name: str, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Cycles walks backward: the weight of a ray is the share of the light that comes that way."""

    def walked_backward(spec: HologramSpec, branch: Branch, *more: Any) -> ShaderSource:
        source = one_order_shader(spec, branch, *more)
        text = source.text.replace("#define HOE_FORWARD 1\n", "")
        assert text != source.text
        return ShaderSource(source.name, text)

    monkeypatch.setattr(probe, "one_order_shader", walked_backward)
    spec = hologram(name)
    reflected = "transmission" not in name
    rays = random_rays(spec, rng, 1, side=reflected)
    found = trace_cycles(spec, rays)
    exact = trace(spec, rays)
    frequency = probe.followed_frequency(spec, rays)
    going = (exact.status == Status.OK) & (found.status == Status.OK) & (frequency == 1.0)
    light = fan(
        spec,
        exact.hit_mm[going],
        -exact.direction[going],
        rays.wavelength_nm[going],
        (Branch(1, reflected=reflected),),
    )
    share = light.weights[:, 0]
    assert share.max() > 0.3
    np.testing.assert_allclose(found.efficiency[going], share, atol=EFFICIENCY)
    # Two-wave theory is not reciprocal off Bragg: the walked ray as light would have another.
    assert np.abs(share - exact.efficiency[going]).max() > 10.0 * EFFICIENCY
