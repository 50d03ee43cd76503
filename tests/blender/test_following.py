# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording sources that are objects: moved, parented, animated, deleted, saved."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.props.sync import hologram_node, read_spec, refresh, refresh_changed
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.evaluate import fan
from hoe_addon.shading.probe import MISSED, direction_world_shader, position_shader

type Make = Callable[..., Any]

SOCKETS = 2e-7
"""Unit vectors and places of up to 100 mm, in float32, by a matrix of float32."""

DIRECTIONS, GRAZING = 3e-6, 6e-7
"""Radians, and radians times the cosine toward grazing: float32 places of hit and source in the
world, and Blender's float32 matrices, twice what one frame alone allows."""

ANIMATED = {"model": "constant", "table": {"T": {"1": 1.0}}}


@pytest.fixture
def lamp(registered: Any) -> Any:
    """An empty with a parent, both turned; the parent moves from frame 1 to frame 11."""
    parent, lamp = (bpy.data.objects.new(name, None) for name in ("Parent", "Lamp"))
    for item in (parent, lamp):
        registered.collection.objects.link(item)
    lamp.parent = parent
    lamp.location = (20.0, -10.0, 5.0)
    lamp.rotation_euler = (0.4, 0.2, -0.3)
    parent.rotation_euler = (0.3, -0.5, 0.8)
    parent.scale = (2.0, 2.0, 2.0)
    for frame, place in ((1, (0.0, 0.0, -120.0)), (11, (15.0, 5.0, -70.0))):
        parent.location = place
        parent.keyframe_insert("location", frame=frame)
    return lamp


@pytest.fixture
def plate(make_material: Make, lens: dict[str, Any]) -> Any:
    """A turned and moved element with the material, in the scene."""
    material = make_material(lens | {"efficiency": ANIMATED, "orders": [1]})
    plate = meshes.add(
        bpy.context.scene.collection, meshes.rectangle("Plate", 40.0, 40.0), material
    )
    plate.location = (3.0, -4.0, 2.0)
    plate.rotation_euler = (0.1, -0.2, 0.3)
    return plate


def follow(material: Any, role: str, target: Any) -> None:
    wave = getattr(material.hologram.recording, role)
    wave.target, wave.follows = target, True
    refresh(material)
    bpy.context.view_layer.update()


def world_socket(material: Any, name: str) -> np.ndarray:
    return np.array(nodes.input_socket(hologram_node(material), name).default_value)


def in_recording(plate: Any, target: Any) -> np.ndarray:
    """The target's place in the frame of the recording, which is that of the plate."""
    return np.array(plate.matrix_world.inverted() @ target.matrix_world.translation)


def test_point_follows_its_object(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    for frame in (1, 6, 11):
        bpy.context.scene.frame_set(frame)
        place = np.array(lamp.matrix_world.translation)
        found = world_socket(material, "object_world_origin")
        np.testing.assert_allclose(found, place, rtol=SOCKETS)
        axes = np.array(lamp.matrix_world.to_3x3().normalized())
        for column, axis in enumerate("xy"):
            found = world_socket(material, f"object_world_{axis}")
            np.testing.assert_allclose(found, axes[:, column], atol=4 * SOCKETS)
        wave = read_spec(material).recording.object
        np.testing.assert_allclose(wave.position_mm, in_recording(plate, lamp), rtol=1e-5)
        assert wave.beam == "diverging"


def test_plane_wave_shines_as_lamps_do(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    follow(material, "reference", lamp)
    wave = read_spec(material).recording.reference
    turned = plate.matrix_world.to_3x3().inverted() @ lamp.matrix_world.to_3x3()
    shines = -np.array(turned.col[2].normalized())
    np.testing.assert_allclose(wave.direction, shines, atol=4 * SOCKETS)


def test_wave_that_is_kept_as_text_follows_too(plate: Any, lamp: Any) -> None:
    """Its numbers are those in the frame of the object."""
    material = plate.data.materials[0]
    wave = material.hologram.recording.object
    wave.kind = "extended"
    wave.details = (
        '{"shape": {"shape": "disc", "diameter_mm": 0.5}, "position_mm": [0, 0, -3], "index": 1.0}'
    )
    follow(material, "object", lamp)
    found = read_spec(material).recording.object
    place = lamp.matrix_world.to_3x3().normalized() @ np_vector(0.0, 0.0, -3.0)
    place = plate.matrix_world.inverted() @ (lamp.matrix_world.translation + place)
    np.testing.assert_allclose(found.position_mm, np.array(place), rtol=1e-5)


def np_vector(*values: float) -> Any:
    from mathutils import Vector

    return Vector(values)


LINE_FOCI = '{"first_mm": [1, 2, -9], "second_mm": [0, 1, -31], "line_direction": [1, 0.2, 0]}'


@pytest.mark.render
@pytest.mark.parametrize("kind", ["point", "astigmatic"])
@pytest.mark.parametrize(
    ("frame", "scale"),
    [(1, (1.0, 1.0, 1.0)), (7, (1.0, 1.0, 1.0)), (7, (-2.0, 2.0, 2.0)), (7, (0.5, 0.5, -0.5))],
)
def test_picture_is_that_of_the_numbers(
    plate: Any, lamp: Any, frame: int, scale: tuple[float, float, float], kind: str
) -> None:
    """Where the rays of a camera go, beside numpy with the numbers that are read back."""
    material, scene = plate.data.materials[0], bpy.context.scene
    plate.scale = scale
    material.hologram.recording.object.kind = kind
    material.hologram.recording.object.details = LINE_FOCI
    follow(material, "object", lamp)
    follow(material, "reference", lamp.parent)
    material.hologram.recording.reference.kind = "plane"
    refresh(material)
    _look_down(scene)
    scene.frame_set(frame)
    answer = render_layers(scene, (COMBINED,))[COMBINED].reshape(-1, 3).astype(float)
    plate.data.materials[0] = nodes.script_material("place", position_shader(), {})
    place = render_layers(scene, (COMBINED,))[COMBINED].reshape(-1, 3).astype(float)
    plate.data.materials[0] = material

    to_plate = np.array(plate.matrix_world.inverted())
    here = place @ to_plate[:3, :3].T + to_plate[:3, 3]
    here[:, 2] = 0.0
    axes = to_plate[:3, :3] / np.linalg.norm(to_plate[:3, :3], axis=1, keepdims=True)
    heading = axes @ (0.0, 0.0, -1.0)
    spec = read_spec(material)
    expected = fan(spec, here, np.broadcast_to(heading, here.shape), 532.0, [Branch(1)])
    found = answer @ axes.T
    gone = np.isnan(expected.directions[:, 0]).any(axis=1) | (answer[:, 0] == MISSED)
    assert not gone.all()
    error = np.linalg.norm(found - expected.directions[:, 0], axis=1)[~gone]
    cosine = np.abs(expected.directions[~gone, 0, 2])
    assert (error < np.maximum(DIRECTIONS, GRAZING / cosine)).all()


def _look_down(scene: Any) -> None:
    set_up(scene, samples=1, seed=0, spectral=False, max_bounces=8)
    scene.render.resolution_x = scene.render.resolution_y = 8
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", 20.0
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.camera.location = (3.0, -4.0, 30.0)
    scene.collection.objects.link(scene.camera)
    scene.world = bpy.data.worlds.new("World")
    tree = nodes.new_tree(scene.world)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    node = nodes.add_script_node(tree, direction_world_shader(), {})
    tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
    scene.world.cycles.sampling_method = "NONE"


def test_deleted_object_leaves_the_last_place_and_a_message(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    bpy.context.scene.frame_set(4)
    before = world_socket(material, "object_world_origin")
    assert np.linalg.norm(before) > 1.0
    bpy.data.objects.remove(lamp)
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(9)
    np.testing.assert_array_equal(world_socket(material, "object_world_origin"), before)
    message = r"recording\.object\.target: must be an object of the scene, got null"
    with pytest.raises(SpecError, match=message):
        read_spec(material)
    with pytest.raises(SpecError, match=message):
        refresh(material)
    assert material.hologram.problem.startswith("recording.object.target")
    np.testing.assert_array_equal(world_socket(material, "object_world_origin"), before)


def test_object_out_of_the_scene_still_has_its_place(plate: Any, lamp: Any) -> None:
    """As after Delete in the window, where our pointer keeps it; or in an appended material."""
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    assert material.hologram.problem == ""
    before = world_socket(material, "object_world_origin")
    bpy.context.scene.collection.objects.unlink(lamp)
    bpy.context.view_layer.update()
    told = "recording.object.target: Lamp is in no scene; its last place counts"
    assert material.hologram.problem == told
    refresh(material)
    bpy.context.view_layer.update()
    assert material.hologram.problem == told
    np.testing.assert_array_equal(world_socket(material, "object_world_origin"), before)


def test_mirrored_source_is_refused(plate: Any, lamp: Any) -> None:
    lamp.scale = (-1.0, 1.0, 1.0)
    with pytest.raises(SpecError, match=r"recording\.object\.target: must not be mirrored"):
        bpy.context.view_layer.update()
        follow(plate.data.materials[0], "object", lamp)


def test_flat_carrier_is_a_problem_and_no_crash(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    plate.scale = (0.0, 1.0, 1.0)
    material.hologram.recording.wavelength_nm = 600.0
    refresh_changed()
    assert material.hologram.problem == "object Plate: must not be scaled to nothing"


def test_problem_is_told_without_a_refresh(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    bpy.data.objects.remove(lamp)
    bpy.context.view_layer.update()
    assert material.hologram.problem.startswith("recording.object.target")


def test_following_ends(plate: Any, lamp: Any) -> None:
    """The numbers of the properties count again, and no driver stays."""
    material = plate.data.materials[0]
    follow(material, "object", lamp)
    assert material.node_tree.animation_data.drivers
    material.hologram.recording.object.follows = False
    refresh(material)
    assert not material.node_tree.animation_data.drivers
    assert read_spec(material).recording.object.position_mm == (10.0, 5.0, -100.0)


def test_source_behind_optics_cannot_follow(plate: Any, lamp: Any) -> None:
    material = plate.data.materials[0]
    material.hologram.recording.object.kind = "system"
    with pytest.raises(SpecError, match=r"recording\.object\.follows: must be off"):
        follow(material, "object", lamp)


def test_saved_file_follows_without_the_add_on(plate: Any, lamp: Any, tmp_path: Path) -> None:
    import hoe_addon

    material = plate.data.materials[0]
    follow(material, "object", lamp)
    name, target = material.name, lamp.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "follows.blend"))
    hoe_addon.unregister()
    try:
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "follows.blend"))
        bpy.context.scene.frame_set(8)
        found = world_socket(bpy.data.materials[name], "object_world_origin")
        place = bpy.data.objects[target].matrix_world.translation
        np.testing.assert_allclose(found, np.array(place), rtol=SOCKETS)
        assert not math.isclose(found[2], 0.0)
    finally:
        hoe_addon.register()


def test_a_table_refuses_a_source_that_follows(plate: Any, lamp: Any) -> None:
    """It would keep the shares of the place where the source once was."""
    material = plate.data.materials[0]
    shader = hologram_node(material).script
    material.hologram.efficiency.common_details = '{"lookup": {"form": "table"}}'
    wave = material.hologram.recording.object
    wave.target, wave.follows = lamp, True
    with pytest.raises(SpecError, match="a table is made for fixed sources, but the object wave"):
        refresh(material)
    assert hologram_node(material).script == shader
