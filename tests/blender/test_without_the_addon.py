# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A .blend gives the same picture where the add-on has never been."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.pictures.render_settings import set_up, write_float_exr
from hoe_addon.blender.props.sync import refresh_changed
from hoe_addon.model.document import find_device, load_device

pytestmark = [pytest.mark.render, pytest.mark.slow]

type Make = Callable[..., Any]

ELSEWHERE = """
import sys, bpy
path, picture, *frames = sys.argv[1:]
bpy.ops.wm.open_mainfile(filepath=path)
assert not hasattr(bpy.types.Material, "hologram")
assert not any(name.split(".")[0] == "hoe_addon" for name in sys.modules)
scene = bpy.context.scene
for frame in frames:
    scene.frame_set(int(frame))
    scene.render.filepath = picture.replace("FRAME", frame)
    bpy.ops.render.render(write_still=True)
"""


def rendered_elsewhere(blend: Path, frames: tuple[int, ...], folder: Path) -> list[NDArray[Any]]:
    """Pictures that another process makes, which cannot find the add-on."""
    target = folder / "elsewhere_FRAME.exr"
    command = [sys.executable, "-I", "-c", ELSEWHERE, str(blend), str(target)]
    done = subprocess.run(
        [*command, *map(str, frames)], cwd=folder, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return [pixels(folder / f"elsewhere_{frame}.exr") for frame in frames]


def rendered_here(scene: Any, frames: tuple[int, ...], folder: Path) -> list[NDArray[Any]]:
    found = []
    for frame in frames:
        scene.frame_set(frame)
        path = folder / f"here_{frame}.exr"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        found.append(pixels(path))
    return found


def pixels(path: Path) -> NDArray[Any]:
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., :3]


def compare(scene: Any, frames: tuple[int, ...], folder: Path) -> list[NDArray[Any]]:
    """Save, and render in both places."""
    blend = folder / "scene.blend"
    write_float_exr(scene, folder / "unused.exr")
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    here = rendered_here(scene, frames, folder)
    for mine, theirs in zip(here, rendered_elsewhere(blend, frames, folder), strict=True):
        assert mine.max() > 0.0
        np.testing.assert_array_equal(theirs, mine)
    return here


def test_a_device(registered: Any, tmp_path: Path) -> None:
    spec = load_device("two_hologram_ar", ['render.effects=["all"]', "room.kind=none"])
    device = build_device(registered, spec, find_device("two_hologram_ar").parent)
    hold(device)
    scene = device.scene
    scene.render.resolution_x, scene.render.resolution_y = 32, 18
    scene.cycles.samples = 16
    material = bpy.data.materials["out_coupler"]
    material.hologram.recording.wavelength_nm = 530.0  # edited as in a window
    refresh_changed()
    compare(scene, (1,), tmp_path)


def test_a_source_that_moves(make_material: Make, lens: dict[str, Any], tmp_path: Path) -> None:
    """Drivers carry it, without Python of ours."""
    scene = bpy.context.scene
    set_up(scene, samples=4, seed=3, spectral=False, max_bounces=8)
    scene.render.resolution_x, scene.render.resolution_y = 24, 24
    shares = {"model": "constant", "table": {"T": {"1": 1.0}}}
    material = make_material(lens | {"efficiency": shares, "orders": [1]})
    meshes.add(scene.collection, meshes.rectangle("Plate", 40.0, 40.0), material)
    lamp = bpy.data.objects.new("lamp", None)
    scene.collection.objects.link(lamp)
    for frame, x in ((1, -60.0), (5, 60.0)):
        lamp.location = (x, 0.0, -100.0)
        lamp.keyframe_insert("location", frame=frame)
    wave = material.hologram.recording.object
    wave.follows, wave.target = True, lamp
    refresh_changed()
    assert material.hologram.problem == ""
    scene.world = _coloured_world()
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    camera.location = (0.0, 0.0, 60.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    first, last = compare(scene, (1, 5), tmp_path)
    assert np.abs(first - last).max() > 0.05, "the source moves what is seen"


def _coloured_world() -> Any:
    """Another colour in every direction."""
    world = bpy.data.worlds.new("directions")
    tree = world.node_tree
    place = tree.nodes.new("ShaderNodeTexCoord")
    background = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeBackground")
    tree.links.new(place.outputs["Generated"], background.inputs["Color"])
    return world
