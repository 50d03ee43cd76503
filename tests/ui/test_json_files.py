# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents are written where the path says, ``//`` being the folder of the open file."""

from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender.add import hologram
from hoe_addon.model.document import load_device, load_hologram
from hoe_addon.ui.ids import Op
from tests.ui.steps import call


@pytest.mark.parametrize(
    ("operator", "load"), [(Op.EXPORT_DEVICE, load_device), (Op.EXPORT_HOLOGRAM, load_hologram)]
)
def test_relative_path_is_beside_the_file(
    registered: Any, tmp_path: Path, operator: Op, load: Any
) -> None:
    item, _ = hologram.add_hologram(registered)
    bpy.context.view_layer.objects.active = item
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
    call(operator, filepath="//mine.json")
    assert load(tmp_path / "mine.json") is not None
