# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A device in the .blend of a stranger: its scene and its objects say anything."""

import random
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document import live
from hoe_addon.blender.document.held import device_of, document_of
from hoe_addon.blender.ids import Role
from hoe_addon.core.errors import HoeError
from hoe_addon.model.document import load_device
from tests.strangers.judging import Case, assert_faultless, judge, unclear
from tests.strangers.texts import some_number, some_text

FEW, MANY = 60, 400
EACH = 50
"""Inputs that are tried on one scene before it is opened anew; most are taken back first."""

PRESETS = ("point_lens", "two_hologram_ar", "holographic_sight")


@pytest.fixture
def files(registered: Any, tmp_path: Path) -> list[str]:
    """Good files; each holds a device without its room."""
    found = []
    for name in PRESETS:
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        spec = load_device(name)
        scene = add_scene(replace(spec, room=replace(spec.room, kind="none")))
        bpy.context.window.scene = scene
        found.append(str(tmp_path / f"{name}.blend"))
        bpy.ops.wm.save_as_mainfile(filepath=found[-1])
    return found


def groups(group: Any) -> Iterator[Any]:
    """A property group and all those in it."""
    yield group
    for prop in group.bl_rna.properties:
        if prop.identifier == "rna_type":
            continue
        value = getattr(group, prop.identifier)
        if prop.type == "COLLECTION":
            for item in value:
                yield from groups(item)
        elif prop.type == "POINTER" and isinstance(value, bpy.types.PropertyGroup):
            yield from groups(value)


def some_value(rng: random.Random, group: Any, prop: Any) -> Any:
    """Anything that a file may have in a property; a pointer may name anything of its kind."""
    match prop.type:
        case "STRING":
            text = some_text(rng).replace("\x00", "")
            return text.encode("utf-8", "replace").decode()
        case "ENUM":
            return rng.choice(prop.enum_items).identifier
        case "POINTER":
            kind = prop.fixed_type.identifier
            found = [block for block in bpy.data.user_map() if type(block).__name__ == kind]
            return rng.choice([None, *found])
        case "BOOLEAN":
            value = rng.random() < 0.5
        case "INT":
            value = rng.choice((prop.hard_min, prop.hard_max, 0, 1, rng.randrange(-9, 99)))
        case _:
            number = some_number(rng)
            # Properties hold float32.
            value = min(max(number, -1e38), 1e38) if isinstance(number, int | float) else 0.0
            value = float(value)
    count = getattr(prop, "array_length", 0)
    return (value,) * count if count else value


def change(rng: random.Random) -> tuple[str, Callable[[], None]]:
    """Change one thing; return what, and what takes it back."""
    scene = bpy.context.scene
    owners = [scene, scene, *(item for item in scene.objects if item.hologram.role != Role.NONE)]
    owner = rng.choice(owners)
    if owner != scene and rng.random() < 0.1:
        return changed(owner, "scale", [rng.choice((0.0, 1.0, -1.0, 1e30)) for _ in range(3)])
    group = rng.choice([each for each in groups(owner.hologram) if fields(each)])
    prop = rng.choice(fields(group))
    return changed(group, prop.identifier, some_value(rng, group, prop))


def fields(group: Any) -> list[Any]:
    """Properties of a group that a file can hold and that are no groups themselves."""
    return [
        prop
        for prop in group.bl_rna.properties
        if prop.identifier not in ("rna_type", "name")
        and not prop.is_readonly
        and prop.type != "COLLECTION"
        and not (prop.type == "POINTER" and "HOE_PG" in prop.fixed_type.identifier)
    ]


def changed(owner: Any, name: str, value: Any) -> tuple[str, Callable[[], None]]:
    before, block = getattr(owner, name), owner.id_data
    if hasattr(before, "__len__") and not isinstance(before, str):
        before = tuple(before)
    if isinstance(before, bpy.types.ID):
        before = None
    blocks, called = ("scenes" if block == bpy.context.scene else "objects"), block.name
    path = owner.path_from_id() if owner != block else ""
    done = f"{called}.{path}.{name} = {value!r:.80}"
    setattr(owner, name, value)

    def back() -> None:
        # Settling may have removed what was changed.
        there = getattr(bpy.data, blocks).get(called)
        if there is not None:
            with suppress(TypeError, ValueError):
                setattr(there.path_resolve(path) if path else there, name, before)

    return done, back


def read() -> None:
    """What a program does first with a scene."""
    document_of(bpy.context.scene)
    device_of(bpy.context.scene)


def settle() -> None:
    """Bring the objects up to date, which may make pictures and shaders."""
    try:
        live.settle(bpy.context.scene)
    except HoeError as error:
        assert not unclear(str(error)), str(error)


def cases(files: list[str], seed: int, count: int) -> Iterator[Case]:
    rng = random.Random(seed)
    for number in range(count):
        if number % EACH == 0:
            bpy.ops.wm.open_mainfile(filepath=rng.choice(files))
        done, back = change(rng)
        yield Case(f"{number}: {done}", read, done)
        settle()
        if rng.random() < 0.9:
            back()


def test_scenes_of_strangers(files: list[str]) -> None:
    assert_faultless(judge(cases(files, 1, FEW)), FEW)


@pytest.mark.slow
def test_many_scenes_of_strangers(files: list[str]) -> None:
    assert_faultless(judge(cases(files, 2, MANY)), MANY)
