# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which hologram is baked: that of the panel with the button, never a library's."""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import pytest

from hoe_addon.cli.worker import baking
from hoe_addon.core.errors import HoeError
from hoe_addon.ui.operators import bake

type Make = Callable[..., Any]

BAKE = bpy.ops.hologram.bake_table


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the materials that jobs were to be started for."""
    names: list[str] = []

    def launch(*_job: Any, settings: Any) -> None:
        names.append(settings["material"])
        raise HoeError("no job in a test")

    monkeypatch.setattr(bake, "launch", launch)
    return names


def bake_it() -> None:
    with pytest.raises(RuntimeError, match="no job in a test"):
        BAKE()


def test_pinned_material_is_baked(
    make_hologram: Make, lens: dict[str, Any], asked: list[str]
) -> None:
    active = make_hologram(lens)
    pinned = active.copy()
    bake_it()
    with bpy.context.temp_override(material=pinned):
        bake_it()
    assert asked == [active.name, pinned.name]


def linked_namesake(material: Any, folder: Path) -> Any:
    path = str(folder / "library.blend")
    bpy.data.libraries.write(path, {material}, fake_user=True)
    with bpy.data.libraries.load(path, link=True) as (_there, wanted):
        wanted.materials = [material.name]
    return wanted.materials[0]


def test_material_of_a_library_is_refused(
    make_hologram: Make, lens: dict[str, Any], tmp_path: Path, asked: list[str]
) -> None:
    linked = linked_namesake(make_hologram(lens), tmp_path)
    with bpy.context.temp_override(material=linked):
        assert not BAKE.poll()
        with pytest.raises(RuntimeError, match="linked from another file; make it local first"):
            BAKE()
    bake_it()
    assert len(asked) == 1


def test_worker_takes_the_one_of_this_file(
    make_hologram: Make, lens: dict[str, Any], tmp_path: Path
) -> None:
    material = make_hologram(lens)
    material.hologram.enabled = False
    linked_namesake(material, tmp_path)
    material.hologram.enabled = True
    work = SimpleNamespace(settings={"material": material.name}, progress=lambda _share: None)
    result = baking.run(work)  # pyright: ignore[reportArgumentType]
    assert result["words"] == f"{material.name} has nothing to bake"
