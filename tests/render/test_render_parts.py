# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture rendered in parts is the picture of one long render."""

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.pictures import render
from hoe_addon.core.errors import CancelledError
from hoe_addon.model.document import find_device, load_device

pytestmark = pytest.mark.render

ROUNDING = 1e-5
"""Relative: Cycles adds samples in float32, in another order when they come in parts."""


@pytest.fixture
def small_device(clean_scene: bpy.types.Scene) -> bpy.types.Scene:
    spec = load_device(
        "two_hologram_ar",
        ["room.kind=none", "display.image=white", "render.size=[40,30]", "render.samples=24"],
    )
    return build_device(clean_scene, spec, find_device("two_hologram_ar").parent).scene


def test_parts_add_up_to_one_render(
    small_device: bpy.types.Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = render.render_layers(small_device, (render.COMBINED,))[render.COMBINED]
    monkeypatch.setattr(render, "_PATHS_PER_PART", 40 * 30 * 7)
    heard: list[float] = []
    parts = render.render_layers(small_device, (render.COMBINED,), heard.append)[render.COMBINED]
    assert heard == [7 / 24, 14 / 24, 21 / 24, 1.0]
    assert whole.max() > 0.0
    np.testing.assert_allclose(parts, whole, rtol=ROUNDING, atol=ROUNDING * whole.max())


def test_a_stop_between_parts_leaves_the_settings_as_they_were(
    small_device: bpy.types.Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(render, "_PATHS_PER_PART", 40 * 30)

    def stop(_done: float) -> None:
        raise CancelledError("stopped")

    before = small_device.render.filepath, small_device.cycles.use_sample_subset
    with pytest.raises(CancelledError):
        render.render_layers(small_device, (render.COMBINED,), stop)
    assert before == (small_device.render.filepath, small_device.cycles.use_sample_subset)
