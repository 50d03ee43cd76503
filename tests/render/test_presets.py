# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in Cycles: every preset renders, lamps and rooms are as bright as they say."""

import json
from pathlib import Path

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.build.measure import pixel_direction, seen_direction
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.cli import main
from hoe_addon.core.photometry import luminance
from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_view import gaze_direction
from hoe_addon.resources import preset_paths

pytestmark = pytest.mark.render

SCENES = [name for name in preset_paths() if isinstance(load_device(name), SceneSpec)]

LUMINANCE_NOISE = 0.02
"""Four standard errors of 50,000 wavelengths drawn for a lamp that fills the picture."""

ROOM_SLACK = 0.25
"""A room says how bright white is in it, not in which place."""

PIXEL_SHARE = 0.02
"""Error of a centroid, in pixels."""


def one_element(room: str, white_cd_m2: float, **element: object) -> SceneSpec:
    """A scene of one element that fills the picture."""
    spec = device_from(
        {
            "kind": "scene",
            "schema": 1,
            "name": "one",
            "title": "One element",
            "elements": [{"name": "one", "position_mm": [0, 0, -900], **element}],
            "eye": {"pupil_diameter_mm": 1, "field_deg": 4},
            "room": {"kind": room, "luminance_cd_m2": white_cd_m2},
            "render": {"size": [32, 24], "samples": 64, "luminance_per_unit_cd_m2": 100},
        }
    )
    assert isinstance(spec, SceneSpec)
    return spec


def mean_luminance(device: DeviceScene) -> float:
    picture = render_layers(device.scene, (COMBINED,))[COMBINED]
    return float(luminance(picture, device.spec.render.luminance_per_unit_cd_m2).mean())


@pytest.mark.slow  # six renders, half a minute
@pytest.mark.parametrize("name", SCENES)
def test_every_scene_renders(name: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert main(["render", name, "--out", str(out), "--size", "32x24", "--samples", "4"]) == 0
    metrics = json.loads((out / "metrics.json").read_text(encoding="utf-8"))
    assert metrics["device"] == name
    assert metrics["picture"]["mean_cd_m2"] > 0.0
    assert "emitters" in metrics
    assert "display_field" not in metrics


@pytest.mark.parametrize(
    "spectrum",
    [
        {"kind": "illuminant", "illuminant": "A"},
        {"kind": "line", "centre_nm": 589.3, "fwhm_nm": 0.5},
        {"kind": "led", "centre_nm": 470, "fwhm_nm": 25},
    ],
    ids=lambda spectrum: spectrum["kind"],
)
def test_lamp_has_its_luminance(clean_scene: bpy.types.Scene, spectrum: dict[str, object]) -> None:
    lamp = {"kind": "lamp", "shape": "rectangle", "size_mm": [200, 200], "luminance_cd_m2": 250}
    spec = one_element("none", 0.0, spectrum=spectrum, **lamp)
    found = mean_luminance(build_device(clean_scene, spec, Path()))
    assert found == pytest.approx(250.0, rel=LUMINANCE_NOISE)


@pytest.mark.parametrize("room", ["desk", "range", "wall"])
def test_white_card_in_a_room(clean_scene: bpy.types.Scene, room: str) -> None:
    card = {"kind": "card", "image": "white", "size_mm": [200, 200], "reflectance": 1}
    spec = one_element(room, 80.0, **card)
    found = mean_luminance(build_device(clean_scene, spec, Path()))
    assert found == pytest.approx(80.0, rel=ROOM_SLACK)


def test_direction_of_a_spot(clean_scene: bpy.types.Scene) -> None:
    """A small disc away from the middle, seen by an eye that looks askance."""
    lamp = {"kind": "lamp", "shape": "disc", "size_mm": [8, 8], "luminance_cd_m2": 100}
    spec = one_element("none", 0.0, spectrum={"kind": "illuminant"}, **lamp)
    askance = device_from({**to_document(spec), "gaze_deg": [1.0, -0.5]})
    device = build_device(clean_scene, askance, Path())
    found = seen_direction(device)
    pixel = 2.0 * np.tan(np.radians(2.0)) / 32.0
    np.testing.assert_allclose(found[:2], 0.0, atol=PIXEL_SHARE * pixel)
    middle = pixel_direction(device, 16.0, 12.0)
    np.testing.assert_allclose(middle, gaze_direction((1.0, -0.5)), atol=1e-6)
