# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene document in Blender: its objects, where they stand, and what they are lit by."""

import math
from pathlib import Path

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.cli import main
from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_view import gaze_direction, rotation_of

FLOAT32 = 1e-6

PRESETS = ["compact_disc", "grating_rainbow", "holographic_sight", "laser_grating", "point_lens"]

UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From the frame of a document to the world."""


def build(scene: bpy.types.Scene, name: str, *changes: str) -> DeviceScene:
    return build_device(scene, load_device(name, changes), Path())


@pytest.mark.parametrize("name", PRESETS)
def test_every_element_is_an_object_in_its_place(clean_scene: bpy.types.Scene, name: str) -> None:
    device = build(clean_scene, name, "room.kind=none", "gaze_deg=[20, -10]")
    bpy.context.view_layer.update()
    assert isinstance(device.spec, SceneSpec)
    for element in device.spec.elements:
        matrix = np.array(bpy.data.objects[element.name].matrix_world)
        place = UPRIGHT @ np.asarray(element.position_mm)
        scale = max(1.0, np.abs(place).max())
        np.testing.assert_allclose(matrix[:3, 3], place, atol=FLOAT32 * scale)
        np.testing.assert_allclose(matrix[:3, :3], UPRIGHT @ rotation_of(element), atol=FLOAT32)
    heading = -np.array(device.eye.matrix_world)[:3, 2]
    np.testing.assert_allclose(heading, UPRIGHT @ gaze_direction((20.0, -10.0)), atol=FLOAT32)


def test_emitters_are_apart_from_the_room(clean_scene: bpy.types.Scene) -> None:
    build(clean_scene, "point_lens")
    assert bpy.data.objects["display"].lightgroup == "display"
    assert all(item.lightgroup == "ambient" for item in bpy.data.objects if item.type == "LIGHT")


@pytest.mark.parametrize("kind", ["desk", "range", "road", "wall"])
def test_backdrops_have_light_of_their_own(clean_scene: bpy.types.Scene, kind: str) -> None:
    device = build(clean_scene, "grating_rainbow", f"room.kind={kind}")
    lights = [item for item in device.room.objects if item.type == "LIGHT"]
    assert lights
    outdoors = kind in ("range", "road")
    assert (clean_scene.world is not None and clean_scene.world.lightgroup == "ambient") == outdoors


@pytest.mark.parametrize("shape", ["disc", "rectangle", "sphere", "line"])
def test_lamps_have_their_size(clean_scene: bpy.types.Scene, shape: str) -> None:
    change = f"elements.lamp.shape={shape}"
    build(
        clean_scene, "grating_rainbow", "room.kind=none", change, "elements.lamp.size_mm=[30, 80]"
    )
    corners = np.array([vertex.co for vertex in bpy.data.objects["lamp"].data.vertices])
    # A disc has the area of its circle, so its corners stand out by a ten thousandth.
    extent = np.ptp(corners, axis=0)
    depth = 30.0 if shape in ("sphere", "line") else 0.0
    expected = (30.0, 30.0, 80.0) if shape == "sphere" else (30.0, 80.0, depth)
    np.testing.assert_allclose(extent, expected, rtol=3e-3)


def test_lamp_normals_point_outward(clean_scene: bpy.types.Scene) -> None:
    """Lamps shine from their front only."""
    for shape in ("sphere", "line"):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        change = f"elements.lamp.shape={shape}"
        build(bpy.context.scene, "grating_rainbow", "room.kind=none", change)
        mesh = bpy.data.objects["lamp"].data
        outward = [face.normal.dot(face.center) for face in mesh.polygons]
        assert min(outward) > 0.0


def test_holder_leaves_its_opening_free(clean_scene: bpy.types.Scene) -> None:
    build(clean_scene, "point_lens", "elements.stand.outline=ellipse")
    stand = bpy.data.objects["stand"]
    corners = np.array([vertex.co for vertex in stand.data.vertices])
    assert np.hypot(corners[:96, 0], corners[:96, 1]).min() == pytest.approx(35.0, rel=1e-6)
    assert corners[:, 1].min() == pytest.approx(-35.0 - 5.0 - 80.0)


def test_card_shows_its_picture(clean_scene: bpy.types.Scene) -> None:
    document = to_document(load_device("grating_rainbow"))
    card = {"kind": "card", "name": "card", "position_mm": [0, 0, -900], "image": "bars"}
    document["elements"].append({**card, "size_mm": [200, 100], "reflectance": 0.5})
    build_device(clean_scene, device_from(document), Path())
    tree = bpy.data.objects["card"].active_material.node_tree
    (texture,) = (node for node in tree.nodes if node.bl_idname == "ShaderNodeTexImage")
    assert texture.image.name.startswith("bars")
    assert math.isclose(texture.image.size[0] / texture.image.size[1], 2.0)


def test_eyebox_is_for_light_guides(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    code = main(["eyebox", "point_lens", "--out", str(tmp_path / "out"), "--grid", "3x3"])
    assert code == 2
    said = capsys.readouterr().err
    assert "point_lens: kind: must be light_guide for an eyebox, got scene" in said
    assert not (tmp_path / "out").exists()
