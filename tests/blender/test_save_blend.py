# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A .blend is written whole, and nothing else is left in the folder."""

from pathlib import Path

import bpy
import pytest

from hoe_addon.blender.pictures.view import save_blend


@pytest.mark.parametrize("versions", [0, 1, 3])
def test_no_older_version_is_left(
    clean_scene: bpy.types.Scene, tmp_path: Path, versions: int
) -> None:
    """Blender keeps what stood there before as .blend1; that would be an empty file."""
    preferences = bpy.context.preferences.filepaths
    preferences.save_version = versions
    path = tmp_path / "view.blend"
    for _ in range(2):
        save_blend(path)
        assert list(tmp_path.iterdir()) == [path]
    assert preferences.save_version == versions
    assert path.stat().st_size > 1000
    bpy.ops.wm.open_mainfile(filepath=str(path))
