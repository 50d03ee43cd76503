# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The living room: its brightness, its light group, and what it leaves alone."""

from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.room.living_room import add_living_room
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.colour import LUMINANCE_WEIGHTS

WHITE = 2.5
WHITE_SHARE = 0.15
"""What a user may expect of "a white surface in the middle of the room"."""

NEUTRAL_SHARE = 0.15
"""Lamp, sky and painted walls together give a white that is seen as white."""

CARD_DISTANCE = 2500.0
CARD_SIZE = 60.0


def _camera(scene: Any, size: float, distance: float) -> None:
    """An eye at the origin along +y that sees a square of this size at this distance."""
    camera = bpy.data.cameras.new("Eye")
    camera.angle = 2.0 * np.arctan(size / 2.0 / distance)
    camera.clip_end = 1e5
    eye = bpy.data.objects.new("Eye", camera)
    eye.rotation_euler = (np.pi / 2.0, 0.0, 0.0)
    scene.collection.objects.link(eye)
    scene.camera = eye
    scene.render.resolution_x = scene.render.resolution_y = 8


def _add_white_card(scene: Any) -> None:
    material = bpy.data.materials.new("Card")
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    mesh = meshes.rectangle("Card", CARD_SIZE, CARD_SIZE)
    card = meshes.add(scene.collection, mesh, material, location=(0.0, CARD_DISTANCE, 0.0))
    card.rotation_euler = (np.pi / 2.0, 0.0, 0.0)


@pytest.mark.render
def test_white_card_in_the_middle_has_the_asked_value(clean_scene: Any) -> None:
    add_living_room(clean_scene.collection, WHITE)
    _add_white_card(clean_scene)
    _camera(clean_scene, 0.8 * CARD_SIZE, CARD_DISTANCE)
    set_up(clean_scene, samples=128, seed=0, spectral=False, max_bounces=16)
    clean_scene.view_layers[0].lightgroups.add(name="ambient")
    layers = render_layers(clean_scene, (COMBINED, f"{COMBINED}_ambient"))
    rgb = layers[COMBINED].mean(axis=(0, 1))
    assert rgb @ LUMINANCE_WEIGHTS == pytest.approx(WHITE, rel=WHITE_SHARE)
    assert rgb == pytest.approx(np.full(3, rgb.mean()), rel=NEUTRAL_SHARE)
    # All light of the room is in its light group.
    np.testing.assert_allclose(layers[f"{COMBINED}_ambient"], layers[COMBINED], rtol=1e-4)


def test_every_light_is_in_the_light_group(clean_scene: Any) -> None:
    add_living_room(clean_scene.collection, WHITE)
    lights = [item for item in bpy.data.objects if item.type == "LIGHT"]
    assert lights
    assert {item.lightgroup for item in lights} == {"ambient"}


def test_dark_room_has_no_light(clean_scene: Any) -> None:
    add_living_room(clean_scene.collection, 0.0)
    assert {light.energy for light in bpy.data.lights} == {0.0}


def test_nothing_stands_in_the_way_of_a_device(clean_scene: Any) -> None:
    """Half a metre around the eye is free, and all objects are in the given collection."""
    collection = bpy.data.collections.new("Room")
    clean_scene.collection.children.link(collection)
    add_living_room(collection, WHITE)
    assert set(collection.objects) == set(bpy.data.objects)
    clean_scene.view_layers[0].update()
    for item in collection.objects:
        if item.type != "MESH":
            continue
        corners = np.asarray([item.matrix_world @ v.co for v in item.data.vertices])
        assert np.linalg.norm(corners, axis=1).min() > 500.0, item.name
