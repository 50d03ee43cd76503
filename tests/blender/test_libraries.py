# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms of other files: linked, appended, overridden, made local; with real .blend files."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender.props.made import is_stale
from hoe_addon.blender.props.sync import (
    catch_up,
    hologram_node,
    read_spec,
    refresh,
    refresh_changed,
    write_spec,
)
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.errors import HoeError
from hoe_addon.model.document import hologram_from

type Make = Callable[..., Any]

CARRIER, SOURCE = "plate", "source"


@pytest.fixture
def library(make_material: Make, lens: dict[str, Any], tmp_path: Path) -> str:
    """A file with a plate that carries a hologram, and a lamp; another file is open after it."""
    material = make_material(lens)
    refresh(material)
    carrier(material)
    source = bpy.data.objects.new(SOURCE, None)
    source.location = (10.0, 5.0, -100.0)
    bpy.context.scene.collection.objects.link(source)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    return path


def carrier(material: Any) -> Any:
    mesh = bpy.data.meshes.new(CARRIER)
    mesh.from_pydata([(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    item = bpy.data.objects.new(CARRIER, mesh)
    bpy.context.scene.collection.objects.link(item)
    return item


def new_material(document: dict[str, Any]) -> Any:
    material = bpy.data.materials.new(document["name"])
    write_spec(material, hologram_from(document))
    refresh(material)
    return material


def load(path: str, *, link: bool, names: tuple[str, ...] = (CARRIER,)) -> Any:
    """Bring objects in; the material of the first comes along."""
    with bpy.data.libraries.load(path, link=link) as (_there, wanted):
        wanted.objects = list(names)
        wanted.materials = ["lens"] if link else []
    for item in wanted.objects:
        bpy.context.scene.collection.objects.link(item)
    return wanted.objects[0].data.materials[0]


def socket(material: Any, name: str) -> Any:
    return nodes.input_socket(hologram_node(material), name).default_value


def recording_nm(material: Any) -> float:
    return round(socket(material, "recording_wavelength_nm"), 3)


def test_a_linked_hologram_is_left_alone(library: str) -> None:
    material = load(library, link=True)
    assert read_spec(material).orders == (-1, 0, 1, 2)
    text = hologram_node(material).script
    material.hologram.recording.wavelength_nm = 600.0  # Blender lets scripts do so, for now
    refresh_changed()
    catch_up()
    assert recording_nm(material) == 532.0
    assert hologram_node(material).script == text
    with pytest.raises(HoeError, match=r"material lens: is linked from .*library.blend; edit it"):
        refresh(material)
    assert material.hologram.problem == ""


def test_a_linked_text_is_not_taken_by_a_local_hologram(library: str, lens: dict[str, Any]) -> None:
    """Else the new file could not be opened without the other."""
    linked = load(library, link=True)
    local = new_material(lens)
    mine, theirs = hologram_node(local).script, hologram_node(linked).script
    assert theirs.library is not None
    assert mine.library is None
    assert mine.as_string() == theirs.as_string()


def test_an_appended_hologram_is_a_local_one(library: str) -> None:
    material = load(library, link=False)
    assert material.library is None
    assert not is_stale(material)
    material.hologram.recording.wavelength_nm = 600.0
    refresh_changed()
    assert recording_nm(material) == 600.0
    material.hologram.recording.object.kind = "plane"
    refresh_changed()
    assert material.hologram.problem == ""
    assert not is_stale(material)


def test_appended_twice_they_are_two(library: str) -> None:
    first, second = load(library, link=False), load(library, link=False)
    assert first != second
    first.hologram.recording.object.kind = "plane"
    first.hologram.recording.wavelength_nm = 600.0
    refresh_changed()
    assert recording_nm(first) == 600.0
    assert recording_nm(second) == 532.0
    assert not is_stale(second)


def test_one_whose_shader_is_behind_catches_up_when_appended(
    make_material: Make, lens: dict[str, Any], tmp_path: Path
) -> None:
    material = make_material(lens)
    carrier(material)
    material.hologram.recording.wavelength_nm = 600.0
    path = str(tmp_path / "behind.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.append(directory=f"{path}/Object/", filename=CARRIER)
    (material,) = (each for each in bpy.data.materials if each.hologram.enabled)
    assert recording_nm(material) == 600.0
    assert not is_stale(material)


def test_made_local_it_can_be_edited(library: str) -> None:
    load(library, link=True)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.make_local(type="ALL")
    (material,) = (each for each in bpy.data.materials if each.hologram.enabled)
    assert material.library is None
    material.hologram.recording.wavelength_nm = 600.0
    refresh_changed()
    assert recording_nm(material) == 600.0
    material.hologram.recording.object.kind = "plane"
    refresh_changed()
    assert material.hologram.problem == ""
    assert hologram_node(material).script.library is None


def overridden(library: str) -> Any:
    linked = load(library, link=True)
    material = linked.override_create(remap_local_usages=False)
    item = carrier(material)
    item.name = "overriding"
    return material


def the_override() -> Any:
    (found,) = (each for each in bpy.data.materials if each.override_library is not None)
    return found


def test_an_override_follows_here_and_says_what_does_not_last(library: str, tmp_path: Path) -> None:
    material = overridden(library)
    hologram = material.hologram
    hologram.recording.wavelength_nm = 600.0
    hologram.recording.object.position_mm = (1.0, 2.0, -30.0)
    hologram.media.front.index = 1.25
    hologram.efficiency.relief.kind = "constant"
    hologram.efficiency.relief.index = 1.6
    refresh_changed()
    assert recording_nm(material) == 600.0
    assert "Blender does not save its shader" in hologram.problem
    assert "make the material local" in hologram.problem
    path = str(tmp_path / "overriding.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    material = the_override()
    hologram = material.hologram
    assert hologram.recording.wavelength_nm == 600.0
    assert tuple(hologram.recording.object.position_mm) == (1.0, 2.0, -30.0)
    assert hologram.media.front.index == 1.25
    assert round(hologram.efficiency.relief.index, 6) == 1.6
    # The shader was not kept, and is made anew when the file is opened.
    assert recording_nm(material) == 600.0
    assert not is_stale(material)
    (linked,) = (each for each in bpy.data.materials if each.library is not None)
    assert recording_nm(linked) == 532.0


def test_an_override_of_a_kind_and_of_orders(library: str, tmp_path: Path) -> None:
    material = overridden(library)
    material.hologram.recording.object.kind = "plane"
    material.hologram.orders.add().order = 3
    refresh_changed()
    path = str(tmp_path / "overriding.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    material = the_override()
    assert material.hologram.recording.object.kind == "plane"
    assert [entry.order for entry in material.hologram.orders] == [-1, 0, 1, 2, 3]
    assert not is_stale(material)


def test_an_override_of_what_the_library_never_set(registered: Any, tmp_path: Path) -> None:
    """A new hologram: Blender overrides only what lies in a group that the file has."""
    material = bpy.data.materials.new("lens")
    material.hologram.enabled = True
    refresh(material)
    carrier(material)
    library = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=library)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    hologram = overridden(library).hologram
    hologram.media.front.index = 1.25
    hologram.characteristic.kind = "radial"
    path = str(tmp_path / "overriding.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    hologram = the_override().hologram
    assert hologram.media.front.index == 1.25
    assert hologram.characteristic.kind == "radial"


def test_an_override_that_changes_nothing_has_no_problem(library: str) -> None:
    material = overridden(library)
    refresh(material)
    assert material.hologram.problem == ""


def test_a_source_of_another_file(library: str, lens: dict[str, Any], tmp_path: Path) -> None:
    """A lamp that is linked is followed, also after saving and opening."""
    load(library, link=True, names=(CARRIER, SOURCE))
    material = new_material(lens | {"name": "mine"})
    carrier(material).name = "mine"
    wave = material.hologram.recording.object
    wave.follows, wave.target = True, bpy.data.objects[SOURCE]
    refresh_changed()
    assert material.hologram.problem == ""
    path = str(tmp_path / "following.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    material = bpy.data.materials["mine"]
    assert material.hologram.recording.object.target.library is not None
    bpy.context.view_layer.update()
    assert not is_stale(material)
    origin = tuple(socket(material, "object_world_origin"))
    assert origin == pytest.approx((10.0, 5.0, -100.0))


def test_what_may_be_overridden(registered: Any) -> None:
    """All that is edited; not what the add-on notes for itself."""
    properties = registered_properties(bpy.types.Material.bl_rna.properties["hologram"])
    own = {"problem", "needs_bake", "made_of"}
    assert not {name for name in own if properties[name].is_overridable}
    nested = properties["recording"].fixed_type.properties["object"].fixed_type.properties
    for name in ("kind", "position_mm", "details", "follows", "target"):
        assert nested[name].is_overridable, name
    for name in ("enabled", "orders", "recording", "pattern", "units_per_mm"):
        assert properties[name].is_overridable, name
    role = registered_properties(bpy.types.Object.bl_rna.properties["hologram"])["role"]
    assert role.is_overridable


def registered_properties(pointer: Any) -> Any:
    return pointer.fixed_type.properties
