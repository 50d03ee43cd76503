# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A lens of a scene in Cycles bends rays as numpy says."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.build.measure import seen_direction
from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_lens import LensElement
from hoe_addon.model.scene_lens_walk import through_lens
from hoe_addon.model.scene_view import gaze_of

pytestmark = pytest.mark.render

LENS_MM = np.array((-4.0, 2.0, -120.0))
NEAR_SPOT_MM = np.array((-1.0, -1.0, -160.0))
RIM_SPOT_MM = np.array((-19.6, 3.3, -198.0))
"""Seen 15 mm off the axis through a lens of f = 100 mm, where colours come apart most."""

GREEN_NM, F_NM, C_NM = 532.0, 486.13, 656.27
ORDERS = {"front": 1, "back": 1}

DIRECTION = 1e-4
"""The error that facets may add; the centroid's own noise is a tenth of it."""

KINOFORM = {
    "characteristic": {
        "kind": "even_radial",
        "wavelength_nm": 587.56,
        "coefficients": [-1e-3],
        "unit": "mm",
    },
    "efficiency": {"model": "constant", "table": {"T": {"1": 1}}},
}
GLASS = {"medium": "N-BK7", "diameter_mm": 30, "thickness_mm": 7}
LENSES: dict[str, dict[str, Any]] = {
    "bare plano-convex": {"front": {"radius_mm": -40}},
    "bare biconvex conic": {"front": {"radius_mm": -60, "conic": -1}, "back": {"radius_mm": 50}},
    "hologram on the flat back": {"front": {"radius_mm": -40}, "back": {"hologram": KINOFORM}},
    "hologram on the curved front": {"front": {"radius_mm": -40, "hologram": KINOFORM}},
}


def scene(
    lens: dict[str, Any],
    spot_mm: NDArray[np.float64],
    wavelength_nm: float,
    gaze_deg: tuple[float, float] = (0.0, 0.0),
) -> SceneSpec:
    place = {"kind": "lens", "name": "lens", "position_mm": LENS_MM.tolist()}
    spot = {
        "kind": "lamp",
        "name": "spot",
        "position_mm": spot_mm.tolist(),
        "shape": "disc",
        "size_mm": [0.2, 0.2],
        "luminance_cd_m2": 1e5,
        "spectrum": {"kind": "line", "centre_nm": wavelength_nm, "fwhm_nm": 0.5},
    }
    found = device_from(
        {
            "kind": "scene",
            "schema": 1,
            "name": "test",
            "title": "test",
            "elements": [{**place, **lens}, spot],
            "eye": {"pupil_diameter_mm": 0.2, "focus_mm": 300, "field_deg": 1.0},
            "gaze_deg": list(gaze_deg),
            "room": {"kind": "none", "luminance_cd_m2": 0},
            "render": {"size": [96, 96], "samples": 24, "spectrum_floor": 0.05},
        }
    )
    assert isinstance(found, SceneSpec)
    return found


def direction_to_spot(spec: SceneSpec, wavelength_nm: float) -> NDArray[np.float64]:
    """Direction in which the eye sees the spot: Newton's method on the two slopes of its ray."""
    lens = spec.element("lens")
    assert isinstance(lens, LensElement)
    spot = np.asarray(spec.element("spot").position_mm) - LENS_MM

    def missed_by(aim: NDArray[np.float64]) -> NDArray[np.float64]:
        heading = np.concatenate((aim, -np.ones((len(aim), 1))), axis=1)
        heading /= np.linalg.norm(heading, axis=1, keepdims=True)
        start = np.tile(-LENS_MM, (len(aim), 1))
        place, left = through_lens(lens, start, heading, wavelength_nm, ORDERS)
        steps = (spot[2] - place[:, 2]) / left[:, 2]
        return (place + steps[:, None] * left - spot)[:, :2]

    aim, step = spec.element("spot").position_mm[:2] / -np.asarray(LENS_MM[2]), 1e-6
    for _ in range(12):
        offset, right, up = missed_by(aim + step * np.array([[0, 0], [1, 0], [0, 1]]))
        aim = aim - np.linalg.solve(np.stack((right - offset, up - offset), axis=1) / step, offset)
    assert np.linalg.norm(missed_by(aim[None])) < 1e-9
    return np.array((*aim, -1.0)) / np.sqrt(1.0 + aim @ aim)


def seen(spec: SceneSpec) -> NDArray[np.float64]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return seen_direction(build_device(bpy.context.scene, spec, Path()))


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_a_spot_is_seen_through_a_lens_where_exact_rays_say(lens: dict[str, Any]) -> None:
    lens = {**GLASS, **lens}
    wanted = direction_to_spot(scene(lens, NEAR_SPOT_MM, GREEN_NM), GREEN_NM)
    straight = NEAR_SPOT_MM / np.linalg.norm(NEAR_SPOT_MM)
    assert np.linalg.norm(wanted - straight) > 100.0 * DIRECTION
    # Not in the middle of the picture, where any symmetric picture would be right.
    right, up = gaze_of(wanted)
    found = seen(scene(lens, NEAR_SPOT_MM, GREEN_NM, (right + 0.11, up - 0.07)))
    assert np.linalg.norm(found - wanted) < DIRECTION


def test_the_kinoform_of_the_preset_takes_the_fringes_away() -> None:
    """A spot of F light and one of C light, seen near the rim of both lenses."""
    plain, mended = fringe("plain"), fringe("achromat")
    assert plain > 1e-3  # 3 minutes of arc, three times what an eye resolves
    assert mended < 0.1 * plain


def fringe(name: str) -> float:
    """Angle between F and C light in Cycles, which numpy confirms."""
    preset = load_device("diffractive_achromat")
    assert isinstance(preset, SceneSpec)
    document = to_document(preset.element(f"{name} lens"))
    lens = {field: document[field] for field in (*GLASS, "front", "back")}
    if name == "achromat":
        # Light of its other orders would draw the centroid aside.
        lens["back"]["hologram"] |= {"efficiency": KINOFORM["efficiency"], "orders": [1]}
    found = []
    for wavelength_nm in (F_NM, C_NM):
        wanted = direction_to_spot(scene(lens, RIM_SPOT_MM, wavelength_nm), wavelength_nm)
        found.append(seen(scene(lens, RIM_SPOT_MM, wavelength_nm, gaze_of(wanted))))
        assert np.linalg.norm(found[-1] - wanted) < DIRECTION
    return float(np.linalg.norm(found[1] - found[0]))
