# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The percentage of the resolution: pictures have its size, measurements are not touched by it."""

import bpy
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.accuracy.target import sharpness
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.build.measure import pixel_direction
from hoe_addon.blender.pictures import division, rounds
from hoe_addon.blender.pictures.division import divided
from hoe_addon.blender.pictures.eyebox import fields_at, survey
from hoe_addon.blender.pictures.render import COMBINED, Region, render_samples
from hoe_addon.blender.pictures.view import render_view
from hoe_addon.model.document import load_device
from hoe_addon.model.eyebox import pupil_positions

pytestmark = pytest.mark.render

SIZE, LARGE, PERCENTAGE = (29, 21), (100, 75), 29


@pytest.fixture
def device(clean_scene: bpy.types.Scene) -> DeviceScene:
    changes = ["render.samples=4", "render.quality=null", "room.kind=none", "eyebox.grid=[1, 1]"]
    spec = load_device("two_hologram_ar", [f"render.size={list(SIZE)}", *changes])
    return build_device(clean_scene, spec, resources.PRESETS_DIR)


def shrink(device: DeviceScene) -> None:
    """Ask for the same size by a percentage."""
    render = device.scene.render
    (render.resolution_x, render.resolution_y), render.resolution_percentage = LARGE, PERCENTAGE


@pytest.mark.slow
def test_picture_is_that_of_its_size(device: DeviceScene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(division, "_LEAST_PATHS", 0)
    wanted = divided(device)
    picture = render_view(device, division=wanted).picture
    shrink(device)
    found = divided(device)
    assert len(found.passes) > 1
    assert [(each.pixels, each.region) for each in found.passes] == [
        (each.pixels, each.region) for each in wanted.passes
    ]
    np.testing.assert_array_equal(render_view(device, division=found).picture, picture)


def test_small_picture_is_one_round(device: DeviceScene, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own pixels are counted, not those of the whole resolution."""
    monkeypatch.setattr(rounds, "_LEAST_PATHS", SIZE[0] * SIZE[1] * 8 + 1)
    shrink(device)
    assert rounds._rounds(device, (8,)) == 1
    device.scene.render.resolution_percentage = 100
    assert rounds._rounds(device, (8,)) == 8


def test_region_is_rendered_to_the_pixel(device: DeviceScene) -> None:
    region = Region(5, 3, 17, 12)
    wanted = render_samples(device.scene, (COMBINED,), 1, 0, 2, region=region)[COMBINED]
    shrink(device)
    found = render_samples(device.scene, (COMBINED,), 1, 0, 2, region=region)[COMBINED]
    np.testing.assert_array_equal(found, wanted)


def test_direction_of_a_pixel(device: DeviceScene) -> None:
    wanted = pixel_direction(device, 3.0, 4.0)
    shrink(device)
    np.testing.assert_array_equal(pixel_direction(device, 3.0, 4.0), wanted)


@pytest.mark.slow
def test_measurements_have_sizes_of_their_own(device: DeviceScene) -> None:
    positions = list(pupil_positions(device.guide_spec))
    wanted = fields_at(device, positions, 8), sharpness(device, 2, 1)
    shrink(device)
    assert (fields_at(device, positions, 8)[0].to_dict(), sharpness(device, 2, 1)) == (
        wanted[0][0].to_dict(),
        wanted[1],
    )
    (seen,) = survey(device, 8)
    assert seen.view.picture.shape == (SIZE[1], SIZE[0], 3)
    render = device.scene.render
    assert (render.resolution_x, render.resolution_y) == LARGE
    assert render.resolution_percentage == PERCENTAGE
