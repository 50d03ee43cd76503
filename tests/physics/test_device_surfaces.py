# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light guide as surfaces of the tracer: nothing missing, nothing twice, nothing turned wrong."""

import json
import math
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.orders import Branch
from hoe_addon.core.tracer import Grating
from hoe_addon.core.tracer.surfaces import LocalRays
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.device_surfaces import Housing, surfaces_of
from hoe_addon.model.document import device_from
from hoe_addon.resources import preset_paths

IN_PLANE = 1e-9
"""Metres. Far above rounding, far below the thickness of the plate."""


def device(**changes: Any) -> LightGuideSpec:
    """The shipped device; keywords replace fields of its out-coupler."""
    document = json.loads(preset_paths()["two_hologram_ar"].read_text(encoding="utf-8"))
    document["holograms"][1] |= changes
    spec = device_from(document)
    assert isinstance(spec, LightGuideSpec)
    return spec


@pytest.mark.parametrize("face", ["eye", "world"])
@pytest.mark.parametrize("patch_face", ["eye", "world"])
def test_faces_are_covered_once(rng: np.random.Generator, face: str, patch_face: str) -> None:
    spec = device(face=patch_face)
    centre, half = np.array(spec.guide.center_mm), np.array(spec.guide.size_mm) / 2.0
    places = np.full((5_000, 3), spec.guide.face_z_mm(face))
    places[:, :2] = rng.uniform(centre - half, centre + half, (5_000, 2))
    covers = np.zeros(len(places))
    for surface in surfaces_of(spec).parts:
        local = surface.frame.point_to_local(places * 1e-3)
        covers += surface.aperture.contains(local) & (abs(local[:, 2]) < IN_PLANE)
    assert np.all(covers == 1.0)


def test_a_patch_on_the_world_face_is_turned_about_y() -> None:
    index, period_nm, wavelength_nm = 1.8, 400.0, 530.0
    sine = wavelength_nm / period_nm / index
    # In the patch's own frame light that goes left in the device goes right, and outward.
    guided = {"direction": [sine, 0.0, math.sqrt(1.0 - sine**2)], "kind": "plane", "index": index}
    back = {"direction": [0.0, 0.0, -1.0], "kind": "plane", "index": index}
    spec = device(
        face="world",
        center_mm=[1.0, 0.0],
        size_mm=[10.0, 10.0],
        recording={"wavelength_nm": wavelength_nm, "object": back, "reference": guided},
        efficiency={"model": "constant", "table": {"R": {"1": 0.3}}},
        orders=[1],
    )
    grating = next(
        part
        for part in surfaces_of(spec).parts
        if isinstance(part, Grating) and part.frame.rotation[2, 2] < 0.0
    )
    edge = np.array([[x, 4.9, spec.guide.face_z_mm("world")] for x in (5.9, -3.9, -4.1, 6.1)])
    local = grating.frame.point_to_local(edge * 1e-3)
    assert grating.aperture.contains(local).tolist() == [True, True, False, False]
    heading = np.array([[-sine, 0.0, -math.sqrt(1.0 - sine**2)]])
    rays = LocalRays(
        np.zeros((1, 3)), grating.frame.vector_to_local(heading), np.array([wavelength_nm * 1e-9])
    )
    onward, _status = grating.follow(rays, Branch(1, reflected=True))
    assert grating.frame.vector_to_world(onward)[0] == pytest.approx([0, 0, 1], abs=1e-7)


def test_housing_shades_what_passes_through_it() -> None:
    housing = Housing(centre=(1.0, 0.0), radius=0.5, front=-2.0, length=1.0)
    start = np.array([[0.9, 0.1], [0.4, 0.0], [0.4, 0.0], [0.0, 0.49], [0.4, 0.51], [0.0, 0.0]])
    slope = np.array([[0.0, 0.0], [0.0, 0.0], [0.2, 0.0], [2.0, 0.0], [1.2, 0.0], [0.4, 0.0]])
    shaded = [True, False, True, True, False, False]
    assert housing.shades(start, slope, 5.0).tolist() == shaded
    # A way that ends early has not come to the can yet.
    assert not housing.shades(start[2:3], slope[2:3], -1.9)[0]
