# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of a lens of a scene, and a display that is seen by a reflection."""

from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build.device import build_device
from hoe_addon.model.document import device_from, find_device
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_lens import LensElement

SINGLE = 4e-6
"""Rounding of coordinates of 20 to 60 mm in single precision."""

BICONVEX: dict[str, Any] = {
    "kind": "lens",
    "name": "lens",
    "position_mm": [1, 2, -100],
    "medium": "N-BK7",
    "diameter_mm": 40,
    "thickness_mm": 10,
    "front": {"radius_mm": -60},
    "back": {"radius_mm": 50, "conic": -1},
}
KINOFORM = {
    "characteristic": {"kind": "even_radial", "wavelength_nm": 550, "coefficients": [-2.0]},
    "efficiency": {"model": "kinoform", "levels": 0, "design_wavelength_nm": 550, "relief": 1.5},
    "orders": [0, 1],
}
DISPLAY: dict[str, Any] = {
    "kind": "display",
    "name": "display",
    "position_mm": [0, 0, -100],
    "display": {
        "image": "white",
        "size_mm": [20, 10],
        "luminance_cd_m2": 100,
        "primaries": "laser_rgb",
    },
}


def build(*elements: dict[str, Any]) -> SceneSpec:
    spec = device_from(
        {
            "kind": "scene",
            "schema": 1,
            "name": "test",
            "title": "test",
            "elements": list(elements),
            "eye": {"pupil_diameter_mm": 2, "field_deg": 20},
            "room": {"kind": "none", "luminance_cd_m2": 0},
            "render": {"size": [8, 8]},
        }
    )
    assert isinstance(spec, SceneSpec)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    build_device(bpy.context.scene, spec, find_device("two_hologram_ar").parent)
    return spec


def vectors(values: Any, name: str) -> NDArray[np.float64]:
    found = np.empty(3 * len(values), dtype=np.float32)
    values.foreach_get(name, found)
    return found.reshape(-1, 3).astype(np.float64)


@pytest.mark.parametrize("face", ["front", "back"])
def test_faces_lie_on_their_surfaces_and_look_outward(face: str) -> None:
    lens = build(BICONVEX).element("lens")
    assert isinstance(lens, LensElement)
    item = bpy.data.objects[f"lens {face}"]
    corners = vectors(item.data.vertices, "co") + np.array(item.location)
    radius = np.hypot(corners[:, 0], corners[:, 1])
    assert radius.max() == pytest.approx(20.0, abs=SINGLE)
    assert corners[:, 2] == pytest.approx(lens.sag_mm(face, radius), abs=SINGLE)
    outward = vectors(item.data.polygons, "normal")[:, 2] * (1.0 if face == "front" else -1.0)
    assert np.all(outward > 0.5)
    smooth = vectors(item.data.corner_normals, "vector")[:, 2]
    assert np.all(np.sign(smooth) == (1.0 if face == "front" else -1.0))


def test_rim_closes_the_lens_and_is_black_and_looks_outward() -> None:
    lens = build(BICONVEX).element("lens")
    assert isinstance(lens, LensElement)
    rim = bpy.data.objects["lens"]
    assert tuple(rim.location) == (1.0, 2.0, -100.0)
    assert {child.name for child in rim.children} == {"lens front", "lens back"}
    corners = vectors(rim.data.vertices, "co")
    assert np.hypot(corners[:, 0], corners[:, 1]) == pytest.approx(20.0, abs=SINGLE)
    ends = sorted(float(lens.sag_mm(face, np.asarray(20.0))) for face in ("front", "back"))
    assert sorted(set(np.round(corners[:, 2], 4))) == pytest.approx(ends, abs=1e-4)
    middle = vectors(rim.data.polygons, "center")
    outward = np.sum(vectors(rim.data.polygons, "normal") * middle, axis=1)
    assert np.all(outward > 0.0)
    assert rim.active_material.name == "lens Rim"


def test_holograms_of_both_faces_are_children_at_their_vertices() -> None:
    build({**BICONVEX, "front": {"hologram": KINOFORM}, "back": {"hologram": KINOFORM}})
    places = {child.name: tuple(child.location) for child in bpy.data.objects["lens"].children}
    assert places == {"lens front": (0.0, 0.0, 5.0), "lens back": (0.0, 0.0, -5.0)}


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_mirrored_display_has_its_left_on_the_right(mirrored: bool) -> None:
    build({**DISPLAY, "mirrored": mirrored})
    mesh = bpy.data.objects["display"].data
    for corner, place in zip(mesh.loops, mesh.uv_layers[0].uv, strict=True):
        x, y, _ = mesh.vertices[corner.vertex_index].co
        assert (place.vector[0] > 0.5) == ((x > 0.0) is not mirrored)
        assert (place.vector[1] > 0.5) == (y > 0.0)
