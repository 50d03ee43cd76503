# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of the window that follows a plan renders what the command line renders."""

from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.document.follow_plan import follow_plan
from hoe_addon.blender.document.held import device_of, whole
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.pictures.passes import whole as one_pass
from hoe_addon.blender.pictures.render import render_layers
from hoe_addon.model.document import load_device
from hoe_addon.model.effects import plan_effects

SETTINGS = ("render.size=[40, 30]", "render.samples=16")

PIXELS = 0.995
"""Share of pixels that are equal: places read back from float32 send a few paths elsewhere."""

CLOSE = 1e-3
"""Relative difference of a pixel that still counts as equal: float32 sums of 16 samples."""

pytestmark = [pytest.mark.render, pytest.mark.slow]


@pytest.fixture
def registered(clean_scene: Any) -> Any:
    import hoe_addon

    hoe_addon.register()
    yield clean_scene
    hoe_addon.unregister()


def picture(scene: bpy.types.Scene) -> np.ndarray:
    return render_layers(scene, ["Combined"])["Combined"]


@pytest.mark.parametrize("name", resources.preset_paths())
def test_same_picture_as_built_by_the_plan(registered: Any, name: str) -> None:
    spec = load_device(name, SETTINGS)
    plan = plan_effects(spec)
    direct = build_device(bpy.context.scene, spec, resources.PRESETS_DIR, plan)
    wanted = picture(direct.scene)
    scene = bpy.data.scenes.new("Held")
    bpy.context.window.scene = scene
    held = build_device(scene, whole(spec), resources.PRESETS_DIR)
    hold(DeviceScene(**{**vars(held), "spec": spec}))
    mine = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    scene.collection.objects.link(mine)
    scene.camera = mine
    again = device_of(scene)
    followed = follow_plan(again, plan_effects(again.spec))
    assert len(followed.plan.left_out) == len(plan.left_out)
    found = picture(scene)
    scale = np.maximum(wanted.max(axis=-1), 1e-3 * wanted.max())
    off = np.abs(found - wanted).max(axis=-1) / scale
    assert (off < CLOSE).mean() > PIXELS, float((off < CLOSE).mean())
    assert one_pass(followed) is not None
