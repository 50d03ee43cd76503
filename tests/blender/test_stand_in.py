# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where no shader runs, something plain is seen: never black, never pink."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
import pytest

from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.pictures.render_settings import write_float_exr
from hoe_addon.blender.props.sync import hologram_node, refresh, refresh_changed
from hoe_addon.blender.shaders import osl, stand_in
from hoe_addon.blender.shaders.materials import dielectric_material, thin_lens_material
from hoe_addon.core.errors import MissingOslError
from hoe_addon.model.document import find_device, load_device

type Make = Callable[..., Any]

PRESET = "two_hologram_ar"
SHADERS = ("ShaderNodeScript",)


@pytest.fixture
def device(registered: Any) -> Any:
    """A light guide with everything that a window would have of it."""
    spec = load_device(PRESET, ['render.effects=["all"]', "room.kind=none"])
    return build_device(registered, spec, find_device(PRESET).parent)


def seen(material: Any, engine: str) -> str:
    """Kind of the node that an engine shows."""
    output = material.node_tree.get_output_node(engine)
    return output.inputs["Surface"].links[0].from_node.bl_idname


def with_shaders() -> list[Any]:
    return [
        material
        for material in bpy.data.materials
        if any(node.bl_idname in SHADERS for node in material.node_tree.nodes)
    ]


def test_every_material_of_a_device_has_a_plain_look(device: Any) -> None:
    materials = with_shaders()
    assert {each.name for each in materials} == {
        "Guide",
        "in_coupler",
        "out_coupler",
        "Ideal Lens",
        "Display",
        "Spectral Filter",
    }
    for material in materials:
        assert seen(material, "CYCLES") == "ShaderNodeScript", material.name
        assert seen(material, "EEVEE") not in SHADERS, material.name


def test_looks(device: Any) -> None:
    looks = {each.name: each for each in with_shaders()}
    assert seen(looks["Spectral Filter"], "EEVEE") == "ShaderNodeBsdfTransparent"
    assert looks["Spectral Filter"].diffuse_color[3] == 0.0
    assert 0.0 < looks["in_coupler"].diffuse_color[3] < 1.0
    assert looks["in_coupler"].surface_render_method == "BLENDED"
    shown = looks["Display"].node_tree.nodes["Stand-In"].inputs["Emission Color"]
    assert shown.links[0].from_node.bl_idname == "ShaderNodeTexImage"


def test_lens_and_glass(registered: Any, make_material: Make, lens: dict[str, Any]) -> None:
    from hoe_addon.blender.shaders.spectral import spectral_scene
    from hoe_addon.core.spectrum import line
    from hoe_addon.core.wavelength_sampling import by_significance

    laser = [line(532e-9, 1e-9)]
    spectral = spectral_scene(by_significance(laser, floor=0.5), laser, 532.0)
    for material in (
        thin_lens_material(10.0),
        dielectric_material("glass", "N-BK7", 1.0, spectral),
        make_material(lens),
    ):
        assert seen(material, "EEVEE") == "ShaderNodeBsdfPrincipled"
        assert seen(material, "CYCLES") == "ShaderNodeScript"


def test_switched_off_and_on(device: Any) -> None:
    scene = device.scene
    scene.cycles.shading_system = False
    stand_in.settle(scene)
    assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())
    assert not any(seen(each, "EEVEE") in SHADERS for each in with_shaders())
    stand_in.settle(scene)
    scene.cycles.shading_system = True
    stand_in.settle(scene)
    assert all(seen(each, "CYCLES") in SHADERS for each in with_shaders())
    for material in with_shaders():
        assert len([n for n in material.node_tree.nodes if n.name.startswith("Stand-In")]) == 2


def test_a_setting_is_followed_by_itself(device: Any) -> None:
    scene = device.scene
    scene.cycles.shading_system = False
    scene.update_tag()
    bpy.context.view_layer.update()
    assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())
    scene.cycles.shading_system = True
    scene.update_tag()
    bpy.context.view_layer.update()
    assert all(seen(each, "CYCLES") in SHADERS for each in with_shaders())


def test_a_gpu_without_osl(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(osl, "device_without_osl", lambda _scene: "HIP")
    stand_in.settle(device.scene)
    assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())


def test_an_opened_file_is_settled(
    device: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = str(tmp_path / "device.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    with monkeypatch.context() as patch:
        patch.setattr("_cycles.with_osl", False)
        bpy.ops.wm.open_mainfile(filepath=path)
        assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())
        for material in bpy.data.materials:
            assert material.hologram.problem == "", "its shader is whole, only not shown"
        bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert all(seen(each, "CYCLES") in SHADERS for each in with_shaders())


def test_a_refresh_keeps_the_plain_look(
    make_material: Make, lens: dict[str, Any], registered: Any
) -> None:
    material = make_material(lens)
    material.hologram.recording.object.kind = "plane"
    refresh(material)
    assert seen(material, "EEVEE") == "ShaderNodeBsdfPrincipled"
    assert seen(material, "CYCLES") == "ShaderNodeScript"


def test_a_shader_added_while_osl_is_off_goes_to_the_right_output(registered: Any) -> None:
    """The factory scene has OSL switched off; the shader is made all the same."""
    material = bpy.data.materials.new("fresh")
    material.hologram.enabled = True
    refresh(material)
    stand_in.settle(registered)
    assert seen(material, "CYCLES") == "ShaderNodeBsdfPrincipled"
    registered.cycles.shading_system = True
    stand_in.settle(registered)
    assert seen(material, "CYCLES") == "ShaderNodeScript"


def test_numbers_are_edited_without_osl(
    make_material: Make, lens: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change that needs another text says so, and the last shader stays."""
    material = make_material(lens)
    text = hologram_node(material).script.name
    osl.compiled.cache_clear()
    monkeypatch.setattr("_cycles.with_osl", False)
    material.hologram.recording.wavelength_nm = 600.0
    refresh_changed()
    assert material.hologram.problem == ""
    sockets = {each.identifier: each.default_value for each in hologram_node(material).inputs}
    assert sockets["recording_wavelength_nm"] == 600.0
    material.hologram.recording.object.kind = "plane"
    refresh_changed()
    assert "without Open Shading Language" in material.hologram.problem
    assert hologram_node(material).script.name == text
    material.hologram.recording.object.kind = "point"
    refresh_changed()
    assert material.hologram.problem == ""


def test_a_new_hologram_without_osl_has_a_plain_look(
    registered: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    osl.compiled.cache_clear()
    monkeypatch.setattr("_cycles.with_osl", False)
    material = bpy.data.materials.new("fresh")
    material.hologram.enabled = True
    with pytest.raises(MissingOslError):
        refresh(material)
    stand_in.settle(registered)
    assert seen(material, "EEVEE") == "ShaderNodeBsdfPrincipled"
    assert material.node_tree.nodes["Stand-In"].inputs["Alpha"].default_value < 1.0
    assert seen(material, "CYCLES") == "ShaderNodeBsdfPrincipled"
    assert hologram_node(material) is None


@pytest.mark.render
def test_a_render_without_osl_is_not_black(device: Any, tmp_path: Path) -> None:
    scene = device.scene
    world = bpy.data.worlds.new("sky")
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
    scene.world = world
    scene.render.resolution_x, scene.render.resolution_y = 24, 14
    scene.cycles.samples = 4
    scene.cycles.shading_system = False
    path = tmp_path / "plain.exr"
    write_float_exr(scene, path)
    bpy.ops.render.render(write_still=True)
    pixels = oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., :3]
    assert np.median(pixels) > 0.1
    red, green, blue = pixels.reshape(-1, 3).mean(axis=0)
    assert min(red, green, blue) > 0.8 * max(red, green, blue), "neither pink nor coloured"


def test_undo_brings_no_shader_back_where_none_runs(device: Any) -> None:
    """As in a window: the look follows after the step of the setting is kept."""
    scene = device.scene
    bpy.ops.ed.undo_push(message="before")
    scene.cycles.shading_system = False
    bpy.ops.ed.undo_push(message="off")
    stand_in.settle(scene)
    bpy.data.objects["Eye"].location.x += 1.0
    bpy.ops.ed.undo_push(message="moved")
    bpy.ops.ed.undo()
    assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())
    bpy.ops.ed.undo()
    assert all(seen(each, "CYCLES") in SHADERS for each in with_shaders())
    bpy.ops.ed.redo()
    assert not any(seen(each, "CYCLES") in SHADERS for each in with_shaders())
