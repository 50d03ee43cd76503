# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A device that is larger than true says so, and one click mends it."""

from typing import Any

import bpy
import pytest

from hoe_addon.blender.add.presets import add_device
from hoe_addon.blender.document.size import enlargement
from hoe_addon.ui.facts.scenes import DEVICE_FACTS
from hoe_addon.ui.ids import Op
from tests.ui.layouts import draw
from tests.ui.steps import call

PANEL = "HOE_PT_device_sidebar"


def test_one_click_gives_the_true_size(registered: Any) -> None:
    registered.collection.objects.link(bpy.data.objects.new("Mine", None))
    root = add_device(registered, "point_lens").root
    DEVICE_FACTS.update_now(registered)
    assert Op.TRUE_SIZE not in draw(getattr(bpy.types, PANEL)).operators()
    root.scale *= 25.0
    registered.view_layers[0].update()
    DEVICE_FACTS.update_now(registered)
    panel = draw(getattr(bpy.types, PANEL))
    assert "Stands here 25 times its true size" in panel.words()
    assert Op.TRUE_SIZE in panel.operators()
    bpy.ops.ed.undo_push(message="scaled")
    call(Op.TRUE_SIZE)
    assert enlargement(registered) == 1.0
    assert tuple(registered.hologram.root.scale) == pytest.approx((1e-3,) * 3)


def test_without_a_device_there_is_no_size(registered: Any) -> None:
    with pytest.raises(RuntimeError, match="holds no device"):
        call(Op.TRUE_SIZE)
