# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Registering leaves Blender as it should be; unregistering as it was."""

import gc
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any

import bpy
import pytest

import hoe_addon
from hoe_addon.blender import parts
from hoe_addon.blender.registration import class_registrars, register_all, unregister_all

ROOT = Path(__file__).parents[2]

CYCLES = 20


def state() -> dict[str, Any]:
    """All that the add-on might leave behind."""
    handlers = {
        name: list(found)
        for name in dir(bpy.app.handlers)
        if isinstance(found := getattr(bpy.app.handlers, name), list)
    }
    return {
        "types": set(dir(bpy.types)),
        "material": set(dir(bpy.types.Material)),
        "material properties": set(bpy.types.Material.bl_rna.properties.keys()),
        "handlers": handlers,
    }


def own_classes() -> list[type]:
    return [
        item
        for part in parts.PARTS
        if inspect.ismodule(part)
        for name, item in inspect.getmembers(part, inspect.isclass)
        if name.startswith("HOE_") and item.__module__ == part.__name__
    ]


class Failing:
    """A part that cannot be registered."""

    def register(self) -> None:
        raise RuntimeError("no")

    def unregister(self) -> None:
        raise AssertionError("was never registered")


@pytest.mark.usefixtures("clean_scene")
def test_register_and_back() -> None:
    before = state()
    hoe_addon.register()
    after = state()
    assert "hologram" in after["material properties"]
    hoe_addon.unregister()
    assert state() == before
    hoe_addon.register()
    assert state() == after
    hoe_addon.unregister()
    assert state() == before


def test_every_class_is_registered(registered: Any) -> None:
    assert len(own_classes()) >= 9
    assert all(item.is_registered for item in own_classes())


def test_names_of_classes_follow_blender(registered: Any) -> None:
    assert all(item.__name__.startswith("HOE_PG_") for item in own_classes())


@pytest.mark.usefixtures("clean_scene")
@pytest.mark.parametrize("place", range(len(parts.PARTS) + 1))
def test_failure_rolls_back(place: int, monkeypatch: pytest.MonkeyPatch) -> None:
    before = state()
    broken = (*parts.PARTS[:place], Failing(), *parts.PARTS[place:])
    with monkeypatch.context() as patch:
        patch.setattr(parts, "PARTS", broken)
        with pytest.raises(RuntimeError, match=r"^no$"):
            hoe_addon.register()
    assert state() == before
    hoe_addon.register()
    hoe_addon.unregister()
    assert state() == before


@pytest.mark.usefixtures("clean_scene")
def test_class_that_fails_takes_its_module_back() -> None:
    class HOE_PG_first(bpy.types.PropertyGroup):  # noqa: N801
        pass

    class HOE_PG_second(bpy.types.PropertyGroup):  # noqa: N801
        pass

    before = state()
    register, _ = class_registrars((HOE_PG_first, HOE_PG_second, HOE_PG_first))
    with pytest.raises(ValueError, match="already registered"):
        register()
    assert state() == before
    assert not HOE_PG_first.is_registered
    assert not HOE_PG_second.is_registered


def test_unregistering_goes_on_after_a_failure() -> None:
    calls: list[str] = []

    class Part:
        def __init__(self, name: str) -> None:
            self.name = name

        def register(self) -> None:
            calls.append(f"+{self.name}")

        def unregister(self) -> None:
            calls.append(f"-{self.name}")
            if self.name == "b":
                raise RuntimeError("b")

    register_all([Part("a"), Part("b"), Part("c")])
    with pytest.raises(RuntimeError, match=r"^b$"):
        unregister_all([Part("a"), Part("b"), Part("c")])
    assert calls == ["+a", "+b", "+c", "-c", "-b", "-a"]


@pytest.mark.usefixtures("clean_scene")
def test_cycles_leak_nothing() -> None:
    def cycle() -> None:
        hoe_addon.register()
        hoe_addon.unregister()

    cycle()
    gc.collect()
    before, groups = state(), len(bpy.types.PropertyGroup.__subclasses__())
    objects = len(gc.get_objects())
    for _ in range(CYCLES):
        cycle()
    gc.collect()
    # Blender itself may keep a few once; a leak would be some objects in every cycle.
    assert len(gc.get_objects()) - objects < CYCLES
    assert state() == before
    assert len(bpy.types.PropertyGroup.__subclasses__()) == groups


def test_pending_changes_go_with_the_add_on(make_material: Any, lens: dict[str, Any]) -> None:
    from hoe_addon.blender.props import changes

    make_material(lens).hologram.recording.wavelength_nm = 600.0
    assert changes.is_waiting()
    hoe_addon.unregister()
    try:
        assert not changes.is_waiting()
    finally:
        hoe_addon.register()


def test_values_outlive_the_add_on(make_material: Any, lens: dict[str, Any]) -> None:
    """Disabled and enabled again, the add-on finds its holograms as they were."""
    from hoe_addon.blender.props.sync import read_spec

    material = make_material(lens)
    spec = read_spec(material)
    hoe_addon.unregister()
    hoe_addon.register()
    assert read_spec(bpy.data.materials[material.name]) == spec


def test_import_is_cheap() -> None:
    code = "import sys, hoe_addon.blender; print('bpy' in sys.modules, 'numpy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "False"]


def test_names_for_scripts() -> None:
    from hoe_addon import blender
    from hoe_addon.blender import api, build_device, hologram_material

    assert callable(build_device)
    assert callable(hologram_material)
    for name in api.__all__:
        assert getattr(blender, name) is getattr(api, name)
        assert f"``{name}``" in (api.__doc__ or ""), name


def test_unknown_name() -> None:
    from hoe_addon import blender

    with pytest.raises(AttributeError, match="has no attribute 'nonsense'"):
        blender.nonsense  # noqa: B018
