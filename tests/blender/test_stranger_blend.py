# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A .blend from a stranger: whatever stands in its properties, one line says what is wrong."""

import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.strangers.documents import grown, lens, mutated, written
from tests.strangers.judging import unclear
from tests.strangers.texts import some_number, some_text
from tests.strangers.watching import watched

FEW, MANY = 150, 2000
DETAILS = {
    "surface": ("surface", "details", ("shape",)),
    "characteristic": ("characteristic", "details", ("kind",)),
    "object": ("recording.object", "details", ("kind",)),
    "kinoform": ("efficiency", "kinoform_details", ()),
    "kogelnik": ("efficiency", "kogelnik_details", ()),
    "rcwa": ("efficiency", "rcwa_details", ()),
    "common": ("efficiency", "common_details", ()),
}
GRACELESS = ("Traceback", "Error:", "TypeError", "ValueError")


def group_of(material: Any, path: str) -> Any:
    here = material.hologram
    for step in path.split("."):
        here = getattr(here, step)
    return here


def choose(rng: random.Random, group: Any, field: str) -> None:
    """Set an enumeration to any of its items."""
    items = group.bl_rna.properties[field].enum_items
    setattr(group, field, rng.choice(items).identifier)


def some_details(rng: random.Random) -> str:
    kind = rng.randrange(4)
    if kind == 0:
        return some_text(rng).replace("\x00", "")
    part = grown(rng, {"$ref": rng.choice(_STRUCTS)})
    if kind == 1:
        part = mutated(rng)[1]
    for tag in ("kind", "shape", "model"):
        part.pop(tag, None)
    if kind == 2:
        part[some_text(rng)] = some_number(rng)
    return written(rng, part).replace("\x00", "").encode("utf-8", "replace").decode()


_STRUCTS = tuple(
    f"#/$defs/{name}"
    for name in (
        *("SphereSurface", "AsphereSurface", "PolynomialSpec", "FormulaSpec", "ZernikeSpec"),
        *("WindowSourceSpec", "AstigmaticSpec", "ExtendedSourceSpec", "SystemWaveSpec"),
        *("KinoformSpec", "KogelnikSpec", "RcwaSpec", "LookupSpec", "HazeSpec"),
    )
)


def read_all(group: Any, depth: int = 0) -> Iterator[object]:
    """Read every property, as panels do."""
    for prop in group.bl_rna.properties:
        if prop.identifier in ("rna_type", "name"):
            continue
        value = getattr(group, prop.identifier)
        if prop.type == "POINTER" and value is not None and depth < 4:
            if prop.fixed_type.identifier.startswith("HOE_PG"):
                yield from read_all(value, depth + 1)
        elif prop.type == "COLLECTION":
            for item in value:
                yield from read_all(item, depth + 1)
        else:
            yield value


def judge(material: Any) -> bool:
    """Read a hologram: it is valid, or one line says why not."""
    from hoe_addon.blender.props.sync import read_spec
    from hoe_addon.core.errors import HoeError

    with watched() as seen:
        try:
            read_spec(material)
        except HoeError as error:
            assert not unclear(str(error)), str(error)
            return False
        finally:
            list(read_all(material.hologram))
    assert seen == []
    return True


def fuzz(make_material: Any, seed: int, count: int) -> int:
    """Read holograms with texts of anything; return how many are valid."""
    rng = random.Random(seed)
    material, valid = make_material(lens()), 0
    judge(material)
    for _ in range(count):
        path, field, tags = rng.choice(list(DETAILS.values()))
        group = group_of(material, path)
        for tag in tags:
            choose(rng, group, tag)
        if path == "efficiency":
            choose(rng, group, "model")
        if path == "characteristic":
            choose(rng, material.hologram, "pattern")
        setattr(group, field, some_details(rng))
        valid += judge(material)
        if rng.random() < 0.3:
            material.hologram.property_unset("surface")
            material.hologram.surface.shape = "plane"
            material.hologram.pattern = "recording"
    return valid


def test_texts_of_details(make_material: Any, capfd: pytest.CaptureFixture[str]) -> None:
    fuzz(make_material, 1, FEW)
    assert "Traceback" not in "".join(capfd.readouterr())


@pytest.mark.slow
def test_many_texts_of_details(make_material: Any, capfd: pytest.CaptureFixture[str]) -> None:
    fuzz(make_material, 2, MANY)
    assert "Traceback" not in "".join(capfd.readouterr())


@pytest.mark.parametrize(
    "text",
    ["no JSON", "[1]", "[" * 3000, '{"a": NaN}', '{"file": "/etc/passwd"}', "{" * 100, '"\\ud800"'],
)
def test_refresh_tells_one_line(make_material: Any, text: str) -> None:
    """The shader stays, and the reason stands where a panel shows it."""
    from hoe_addon.blender.props.sync import refresh_changed

    material = make_material(lens())
    script = next(node.script for node in material.node_tree.nodes if hasattr(node, "script"))
    material.hologram.efficiency.kinoform_details = text
    refresh_changed()
    problem = material.hologram.problem
    assert problem.startswith("efficiency")
    assert not unclear(problem)
    assert script in {getattr(node, "script", None) for node in material.node_tree.nodes}


def junk_groups(kind: str) -> Any:
    """Property groups like those of the add-on, with other types under the same names."""
    import bpy
    from bpy.props import (
        CollectionProperty,
        FloatProperty,
        FloatVectorProperty,
        IntProperty,
        PointerProperty,
        StringProperty,
    )

    class HOE_PG_junk_part(bpy.types.PropertyGroup):  # noqa: N801
        pass

    class HOE_PG_junk(bpy.types.PropertyGroup):  # noqa: N801
        pass

    part, whole = HOE_PG_junk_part.__annotations__, HOE_PG_junk.__annotations__
    names = ("enabled", "schema", "version", "kind", "role", "shape", "pattern", "model", "size_mm")
    parts = ("surface", "recording", "efficiency", "media", "frame", "eye", "render", "orders")
    for target in (part, whole):
        for name in names:
            match kind:
                case "enums":
                    target[name] = IntProperty(default=0)
                case "texts":
                    target[name] = StringProperty()
                case _:
                    target[name] = FloatVectorProperty(size=3)
    for name in parts:
        if kind == "enums":
            whole[name] = PointerProperty(type=HOE_PG_junk_part)
        elif kind == "texts":
            whole[name] = FloatProperty()
        else:
            whole[name] = CollectionProperty(type=HOE_PG_junk_part)
    return HOE_PG_junk_part, HOE_PG_junk


def fill(group: Any, kind: str) -> None:
    for prop in group.bl_rna.properties:
        match prop.type:
            case "INT":
                setattr(group, prop.identifier, 1 if prop.identifier == "enabled" else 987654)
            case "STRING" if prop.identifier != "name":
                setattr(group, prop.identifier, "junk " * 1000)
            case "FLOAT":
                setattr(group, prop.identifier, (1e30,) * 3 if prop.array_length else 1e30)
            case "POINTER" if prop.identifier != "rna_type":
                fill(getattr(group, prop.identifier), kind)
            case "COLLECTION":
                fill(getattr(group, prop.identifier).add(), kind)


def write_junk(path: Path, kind: str) -> None:
    """Save a file whose properties have the names of the add-on's, and other types."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    part, whole = junk_groups(kind)
    owners = (bpy.types.Material, bpy.types.Scene, bpy.types.Object)
    for group in (part, whole):
        bpy.utils.register_class(group)
    for owner in owners:
        owner.hologram = bpy.props.PointerProperty(type=whole)
    item = bpy.data.objects.new("item", bpy.data.meshes.new("item"))
    material = bpy.data.materials.new("junk")
    item.data.materials.append(material)
    bpy.context.scene.collection.objects.link(item)
    for thing in (item, material, bpy.context.scene):
        fill(thing.hologram, kind)
        thing["hologram_more"] = {"a": [1, 2], "b": "x" * 1000}
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    for owner in owners:
        del owner.hologram
    for group in (whole, part):
        bpy.utils.unregister_class(group)
    bpy.ops.wm.read_factory_settings(use_empty=True)


@pytest.mark.usefixtures("clean_scene")
@pytest.mark.parametrize("kind", ["enums", "texts", "lists"])
def test_junk_under_our_names(tmp_path: Path, capfd: pytest.CaptureFixture[str], kind: str) -> None:
    """Properties of other types, enumerations without such an item, numbers out of all bounds."""
    import bpy

    import hoe_addon
    from hoe_addon.blender.document.held import document_of
    from hoe_addon.blender.props.sync import refresh, refresh_changed
    from hoe_addon.core.errors import HoeError

    path = tmp_path / "junk.blend"
    write_junk(path, kind)
    hoe_addon.register()
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path))
        refresh_changed()
        material, scene = bpy.data.materials["junk"], bpy.context.scene
        for thing in (material, scene, bpy.data.objects["item"]):
            list(read_all(thing.hologram))
        material.hologram.enabled = True
        for action in (lambda: refresh(material), lambda: document_of(scene)):
            try:
                action()
            except HoeError as error:
                assert not unclear(str(error)), str(error)
        assert not unclear(material.hologram.problem or "a: b")
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "again.blend"))
    finally:
        hoe_addon.unregister()
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["again.blend", "junk.blend"]
    said = "".join(capfd.readouterr())
    assert not any(word in said for word in GRACELESS), said


def test_a_target_that_is_gone(make_material: Any) -> None:
    import bpy

    from hoe_addon.blender.props.sync import refresh_changed

    material = make_material(lens())
    lamp = bpy.data.objects.new("lamp", None)
    wave = material.hologram.recording.object
    wave.follows, wave.target = True, lamp
    bpy.data.objects.remove(lamp)
    refresh_changed()
    assert not unclear(material.hologram.problem)
    assert json.loads(json.dumps(material.hologram.problem)) == material.hologram.problem
