# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which object carries a hologram, in whose frame waves are told that follow another object."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.build import meshes
from hoe_addon.blender.document.held import device_of, document_of
from hoe_addon.blender.document.live import settle
from hoe_addon.blender.document.source_objects import bind_source, make_source
from hoe_addon.blender.ids import Role
from hoe_addon.blender.props.followed import carrier_of
from hoe_addon.blender.props.sync import read_spec, refresh
from hoe_addon.core.errors import HoeError, SpecError

type Make = Callable[..., Any]

LENS = "lens"
"""The element of the preset, and its material's name."""


def add_plate(name: str, material: Any, scene: Any = None, x: float = 0.0) -> Any:
    scene = scene or bpy.context.scene
    plate = meshes.add(scene.collection, meshes.rectangle(name, 40.0, 40.0), material)
    plate.location.x = x
    return plate


def add_lamp(material: Any, x: float = 7.0) -> Any:
    lamp = bpy.data.objects.new("Lamp", None)
    bpy.context.scene.collection.objects.link(lamp)
    lamp.location = (x, 0.0, -90.0)
    bind_source(material, "object", lamp)
    return lamp


def place_mm(spec: Any) -> tuple[float, ...]:
    return tuple(spec.recording.object.position_mm)


def to_own_slot(item: Any, material: Any) -> None:
    """As with the Link menu of a slot; the mesh has the material no more."""
    item.data.materials[0] = None
    item.material_slots[0].link = "OBJECT"
    item.material_slots[0].material = material


@pytest.fixture
def material(make_material: Make, lens: dict[str, Any]) -> Any:
    return make_material(lens)


def test_a_slot_of_the_object_counts_as_that_of_its_mesh(material: Any) -> None:
    plate = add_plate("Plate", material, x=3.0)
    add_lamp(material)
    before = place_mm(read_spec(material))
    assert before == pytest.approx((4.0, 0.0, -90.0))
    to_own_slot(plate, material)
    assert carrier_of(material) == plate
    assert place_mm(read_spec(material)) == before
    with pytest.raises(HoeError, match="object Plate: carries the hologram"):
        bind_source(material, "object", plate)
    made = make_source(bpy.context.scene.collection, material, "reference")
    assert made.users_collection


def test_a_mesh_whose_object_shows_another_material_is_no_carrier(material: Any) -> None:
    hidden, plate = add_plate("A", material), add_plate("B", material)
    hidden.material_slots[0].link = "OBJECT"
    hidden.material_slots[0].material = bpy.data.materials.new("plain")
    assert carrier_of(material) == plate


def test_a_part_of_a_device_in_the_scene_shown_comes_first(material: Any) -> None:
    other = bpy.data.scenes.new("other")
    add_plate("A", material, other).hologram.role = Role.HOLOGRAM
    assert carrier_of(material).name == "A", "better than none"
    add_plate("C", material)
    assert carrier_of(material).name == "C"
    add_plate("B", material)
    assert carrier_of(material).name == "B"
    bpy.data.objects["C"].hologram.role = Role.HOLOGRAM
    assert carrier_of(material).name == "C"


def test_without_a_carrier_there_are_no_numbers(material: Any) -> None:
    add_lamp(material)
    rule = "must be off where no object carries the hologram; give its material to one"
    with pytest.raises(SpecError, match=rf"recording\.object\.follows: {rule}, got true"):
        read_spec(material)
    refresh(material)
    assert material.hologram.problem == "", "the shader needs no numbers"
    add_plate("Plate", material)
    assert place_mm(read_spec(material)) == pytest.approx((7.0, 0.0, -90.0))


def test_each_element_of_a_document_has_numbers_of_its_own(registered: Any) -> None:
    scene = add_scene("point_lens")
    item = scene.objects[LENS]
    source = make_source(scene.collection, item.active_material, "object")
    before = place_mm(document_of(scene).element(LENS).hologram)
    copy = item.copy()
    copy.name, copy.location.x = "a copy", item.location.x + 30.0
    scene.collection.objects.link(copy)
    spec = document_of(scene)
    assert place_mm(spec.element(LENS).hologram) == before
    found = place_mm(spec.element("a copy").hologram)
    assert found == pytest.approx((before[0] - 30.0, *before[1:]), rel=1e-5, abs=1e-4)
    assert source.name not in {element.name for element in spec.elements}


def test_patches_of_a_light_guide_are_on_its_plate(registered: Any) -> None:
    scene = add_scene("two_hologram_ar")
    patch = scene.hologram.patches[0]
    make_source(scene.collection, patch.material, "object")
    before = document_of(scene).holograms[0].recording.object
    decoy = add_plate("A", patch.material, scene, x=50.0)
    decoy.hologram.role = Role.PART
    assert carrier_of(patch.material) == decoy
    assert document_of(scene).holograms[0].recording.object == before


@pytest.fixture
def beside_a_linked_device(registered: Any, tmp_path: Path) -> Any:
    """A scene with a device, and a linked element that has the name of one of its own."""
    path = str(tmp_path / "library.blend")
    made = add_scene("point_lens")
    bpy.data.libraries.write(path, {made.objects[LENS]}, fake_user=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = add_scene("point_lens")
    with bpy.data.libraries.load(path, link=True) as (_there, wanted):
        wanted.objects = [LENS]
    scene.collection.objects.link(wanted.objects[0])
    return scene


def own_element(scene: Any) -> Any:
    (item,) = (i for i in scene.objects if i.name == LENS and i.library is None)
    return item


def test_a_linked_element_is_no_part_of_the_document(beside_a_linked_device: Any) -> None:
    scene = beside_a_linked_device
    own = own_element(scene)
    names = [element.name for element in document_of(scene).elements]
    assert names.count(LENS) == 1
    assert device_of(scene).elements[LENS] == own
    mesh = own.data.name
    own.active_material.hologram.surface.size_mm = (15.0, 15.0)
    refresh(own.active_material)
    assert settle(scene) == ("shape",)
    assert own.data.name == mesh
    assert max(vertex.co.x for vertex in own.data.vertices) == pytest.approx(7.5)


def test_an_element_that_hangs_elsewhere_still_counts(beside_a_linked_device: Any) -> None:
    scene = beside_a_linked_device
    own = own_element(scene)
    hook = bpy.data.objects.new("hook", None)
    scene.collection.objects.link(hook)
    own.parent = hook
    assert device_of(scene).elements[LENS] == own


def test_a_linked_element_on_the_root_is_a_part(beside_a_linked_device: Any) -> None:
    scene = beside_a_linked_device
    (linked,) = (i for i in scene.objects if i.name == LENS and i.library is not None)
    linked.parent = scene.hologram.root  # Blender lets scripts do so
    with pytest.raises(SpecError, match=r"must be used once, got \"lens\""):
        document_of(scene)
