# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the add-on keeps what it makes for itself."""

import bpy
import pytest

from hoe_addon.blender import paths


def test_an_extension_has_a_folder_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paths, "__package__", "bl_ext.somewhere.hoe_addon.hoe_addon.blender")
    folder = paths.own_folder()
    assert folder is not None
    assert folder.parts[-4:] == (".user", "somewhere", "hoe_addon", "cache")


def test_a_plain_package_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paths, "__package__", "hoe_addon.blender")
    assert paths.own_folder() is None


def test_no_folder_where_blender_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """An empty path would be the folder that Blender was started in."""
    monkeypatch.setattr(bpy.utils, "extension_path_user", lambda *_, **__: "")
    assert paths.own_folder() is None
