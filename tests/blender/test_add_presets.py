# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets as scenes of their own, and as devices in a scene of the user's."""

from typing import Any

import bpy
import pytest

from hoe_addon import resources
from hoe_addon.blender.add.presets import add_device, add_scene
from hoe_addon.blender.api import add_hologram, device_of, document_of, load_device
from hoe_addon.blender.document.live import settle
from hoe_addon.blender.units import in_millimetres
from hoe_addon.core.errors import HoeError
from hoe_addon.model.document import to_document


@pytest.mark.parametrize("name", resources.preset_paths())
def test_preset_becomes_a_scene(registered: Any, name: str) -> None:
    scene = add_scene(name)
    assert scene != registered
    assert scene.name == name
    assert scene.camera == scene.hologram.eye.camera
    assert document_of(scene).title == load_device(name).title
    assert document_of(scene).render.effects == load_device(name).render.effects
    assert settle(scene) == (), "made as it says"
    assert not registered.objects
    assert registered.hologram.kind == "none"


def test_document_becomes_a_scene(registered: Any) -> None:
    spec = load_device("laser_grating", ["eye.field_deg=12.5"])
    assert document_of(add_scene(spec)).eye.field_deg == 12.5


def test_same_preset_twice(registered: Any) -> None:
    one, other = add_scene("laser_grating"), add_scene("laser_grating")
    assert one.name != other.name
    assert not set(one.objects) & set(other.objects)
    assert len(document_of(other).elements) == len(document_of(one).elements)


@pytest.mark.parametrize("name", ["point_lens", "two_hologram_ar"])
def test_device_in_a_scene_of_the_user(registered: Any, name: str) -> None:
    registered.render.resolution_x, registered.cycles.samples = 333, 7
    world = bpy.data.worlds.new("Mine")
    registered.world = world
    registered.collection.objects.link(bpy.data.objects.new("Mine", None))
    added = add_device(registered, name, (10.0, 20.0, 30.0))
    assert tuple(added.root.location) == (10.0, 20.0, 30.0)
    assert (registered.render.resolution_x, registered.cycles.samples) == (333, 7)
    assert registered.unit_settings.scale_length == 1.0
    assert registered.world == world
    assert registered.camera == added.eye
    assert added.kept_camera is None
    assert "Motion Blur" in added.settings
    found, wanted = document_of(registered), load_device(name)
    assert found.room.kind == "none"
    assert found.name == wanted.name
    assert to_document(found.eye)["pupil_diameter_mm"] == wanted.eye.pupil_diameter_mm
    assert device_of(registered).eye == added.eye
    assert settle(registered) == ()


def test_empty_scene_gets_millimetres(registered: Any) -> None:
    add_device(registered, "laser_grating")
    assert in_millimetres(registered)


def test_camera_of_the_user_stays(registered: Any) -> None:
    mine = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    registered.collection.objects.link(mine)
    registered.camera = mine
    added = add_device(registered, "laser_grating")
    assert registered.camera == added.kept_camera == mine


def test_one_device_a_scene(registered: Any) -> None:
    add_device(registered, "laser_grating")
    with pytest.raises(HoeError, match="scene Scene: holds a device already"):
        add_device(registered, "laser_grating")


def test_unknown_preset_leaves_nothing(registered: Any) -> None:
    for add in (add_scene, lambda name: add_device(registered, name)):
        with pytest.raises(HoeError, match="nothing: is neither a preset"):
            add("nothing")
    assert list(bpy.data.scenes) == [registered]


def test_failure_on_the_way_leaves_nothing(
    registered: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from hoe_addon.blender.build import device

    def fails(*_arguments: Any) -> None:
        raise HoeError("no room")

    engine, count = registered.render.engine, len(bpy.data.materials)
    monkeypatch.setattr(device, "add_room", fails)
    for add in (add_scene, lambda name: add_device(registered, name)):
        with pytest.raises(HoeError, match="no room"):
            add("laser_grating")
    assert list(bpy.data.scenes) == [registered]
    assert not bpy.data.objects
    assert not bpy.data.collections
    assert len(bpy.data.materials) == count
    assert registered.render.engine == engine
    assert registered.hologram.kind == "none"
    assert registered.camera is None


def test_hologram_beside_a_light_guide(registered: Any) -> None:
    add_device(registered, "two_hologram_ar")
    before = document_of(registered)
    item, _ = add_hologram(registered)
    assert item.parent == registered.hologram.root
    found = document_of(registered)
    assert found.holograms == before.holograms
    assert found.render.effects == ("all",), "nothing is left out for what nobody knows"


def test_display_beside_a_light_guide_is_refused(registered: Any) -> None:
    from hoe_addon.blender.api import add_display

    add_device(registered, "two_hologram_ar")
    with pytest.raises(HoeError, match="holds a light guide, which has a display of its own"):
        add_display(registered)
