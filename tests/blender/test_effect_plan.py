# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a plan leaves out is not set up, and what it keeps is."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from msgspec import structs

from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.pictures.diffracted import is_plain, is_worth_it
from hoe_addon.blender.pictures.view import View, view_metrics
from hoe_addon.blender.shaders import nodes
from hoe_addon.model.device import DeviceSpec
from hoe_addon.model.document import load_device
from hoe_addon.model.effects import EffectPlan, plan_effects
from hoe_addon.model.efficiency import ConstantSpec, KinoformSpec, ShareTable
from hoe_addon.model.hologram import SideMedia
from hoe_addon.model.scene import SceneSpec
from hoe_addon.shading.hologram import hologram_shader

SIGHT = "holographic_sight"
EVERYTHING = ("all",)
TABLES = 1e-3
"""Error of RGB: the tables of the spectrum keep colours of narrow lines to 1e-4 in u'v'."""

ONE_ORDER = ConstantSpec(table=ShareTable(T={"1": 0.9}, R={}))


def document(name: str, *changes: str) -> DeviceSpec:
    return load_device(name, ["room.kind=none", *changes])


def without(spec: DeviceSpec, *effects: str) -> DeviceSpec:
    """The document, with what its user leaves out."""
    changes = tuple(f"-{each}" for each in effects)
    return structs.replace(spec, render=structs.replace(spec.render, effects=changes))


def build(scene: bpy.types.Scene, spec: DeviceSpec, plan: EffectPlan | None = None) -> DeviceScene:
    return build_device(scene, spec, Path(), plan)


def text_of(item: str) -> str:
    """The shader that an object's material runs."""
    script = nodes.script_node(bpy.data.objects[item].active_material).script
    return script.as_string()


def test_everything_is_built_as_the_document_says(clean_scene: bpy.types.Scene) -> None:
    spec = document(SIGHT)
    spec = structs.replace(spec, render=structs.replace(spec.render, effects=EVERYTHING))
    device = build(clean_scene, spec)
    assert device.plan.left_out == ()
    assert device.spec == spec
    assert clean_scene.render.use_motion_blur
    assert device.spectral.drawn
    assert device.camera.dof.use_dof
    assert len(device.eye.children) == 1
    assert clean_scene.cycles.transparent_max_bounces == spec.render.max_bounces


def test_own_plan_is_the_default(clean_scene: bpy.types.Scene) -> None:
    spec = document(SIGHT)
    assert build(clean_scene, spec).plan == plan_effects(spec)


def test_without_dispersion_nothing_draws_wavelengths(clean_scene: bpy.types.Scene) -> None:
    device = build(clean_scene, without(document(SIGHT), "dispersion"))
    assert not clean_scene.render.use_motion_blur
    assert not device.spectral.drawn
    assert not device.eye.children
    assert "Spectral Filter" not in bpy.data.materials
    scripts = [node for node in device.spectral.group.nodes if node.bl_idname == "ShaderNodeScript"]
    assert not scripts
    assert "#define HOE_ONE_WAVELENGTH 1" in text_of("reticle")
    assert "#define HOE_EMISSION_RED" not in text_of("reticle").split("// SPDX")[0]


def test_one_wavelength_is_that_of_the_picture(clean_scene: bpy.types.Scene) -> None:
    """The reticle is red only, so the window sees red light."""
    device = build(clean_scene, without(document(SIGHT), "dispersion"))
    (value,) = (node for node in device.spectral.group.nodes if node.type == "VALUE")
    assert value.outputs[0].default_value == pytest.approx(640.0, abs=1.0)


def test_one_wavelength_keeps_the_colours_of_the_display(clean_scene: bpy.types.Scene) -> None:
    """Each primary gives the RGB that its spectrum has on average."""
    device = build(clean_scene, without(document(SIGHT), "dispersion"))
    script = nodes.script_node(bpy.data.objects["reticle"].active_material)
    found = [nodes.input_socket(script, f"preview_{name}") for name in ("red", "green", "blue")]
    rgb = np.sum([socket.default_value for socket in found], axis=0)
    np.testing.assert_allclose(rgb, 1.0, atol=TABLES)  # they mix D65
    assert device.spectral.tables.emission.shape[0] == 3


def test_spectral_scene_still_has_its_preview(clean_scene: bpy.types.Scene) -> None:
    """Blender's viewport has no motion blur: the text must know what to do then."""
    spec = document("grating_rainbow")
    device = build(clean_scene, spec)
    assert device.spectral.drawn
    assert "HOE_ONE_WAVELENGTH 1" not in text_of("lamp")
    group = device.spectral.group
    (script,) = (node for node in group.nodes if node.label == "hoe wavelength")
    socket = nodes.input_socket(script, "preview_wavelength_nm")
    assert socket.default_value == pytest.approx(spec.render.preview_wavelength_nm)


def test_without_the_pupil_there_is_no_depth_of_field(clean_scene: bpy.types.Scene) -> None:
    device = build(clean_scene, without(document(SIGHT), "pupil"))
    assert not device.camera.dof.use_dof


def test_given_plan_is_followed(clean_scene: bpy.types.Scene) -> None:
    spec = document(SIGHT)
    device = build(clean_scene, spec, plan_effects(without(spec, "dispersion")))
    assert not device.spectral.drawn
    assert device.spec == spec


def test_left_out_orders_have_no_closure(clean_scene: bpy.types.Scene) -> None:
    spec = document(SIGHT)
    assert isinstance(spec, SceneSpec)
    hologram = structs.replace(spec.hologram("window").hologram, orders=(1,), efficiency=ONE_ORDER)
    build(clean_scene, spec, EffectPlan((), 0.0, {}, {"window": hologram}))
    assert text_of("window").endswith(hologram_shader(hologram).text)
    assert "#define HOE_EACH_ORDER(X) X(1, HOE_TRANSMITTED, efficiency_t_p1)\n" in text_of("window")


def test_wavelengths_count_after_diffraction(clean_scene: bpy.types.Scene) -> None:
    """What is seen straight on has its colour at once; every source of light knows of it."""
    device = build(clean_scene, load_device(SIGHT))
    assert text_of("window").startswith("#define HOE_PLAIN 1")
    assert text_of("reticle").startswith("#define HOE_FILTER_AT_LIGHTS 1")
    assert text_of("Spectral Filter").startswith("#define HOE_FILTER_AT_LIGHTS 1")
    (sun,) = (item.data for item in clean_scene.objects if item.type == "LIGHT")
    for tree in (sun.node_tree, clean_scene.world.node_tree):
        assert any(getattr(node, "node_tree", None) == device.spectral.group for node in tree.nodes)
    kinds = {node.bl_idname for node in bpy.data.materials["Portal Counter"].node_tree.nodes}
    assert "ShaderNodeBsdfRayPortal" in kinds


@pytest.mark.parametrize(
    ("name", "changes", "worth"),
    [
        (SIGHT, (), True),
        (SIGHT, ('render.effects=["all"]',), False),
        (SIGHT, ("render.mode=preview",), False),
        ("grating_rainbow", (), False),
        ("point_lens", (), False),
        ("two_hologram_ar", (), False),
    ],
)
def test_scenes_that_gain_by_it(name: str, changes: tuple[str, ...], worth: bool) -> None:
    assert is_worth_it(load_device(name, changes)) is worth


@pytest.mark.parametrize(
    ("change", "plain"),
    [
        ({}, True),
        ({"media": SideMedia(back="N-BK7")}, False),
        ({"orders": (1,), "efficiency": ONE_ORDER}, False),
        ({"efficiency": KinoformSpec(levels=0, design_wavelength_nm=532, relief="PMMA")}, False),
    ],
    ids=["thin", "two media", "no order 0", "shares by wavelength"],
)
def test_order_0_that_is_alike_at_all_wavelengths(change: dict[str, Any], plain: bool) -> None:
    spec = document(SIGHT)
    assert isinstance(spec, SceneSpec)
    hologram = spec.hologram("window").hologram
    assert is_plain(structs.replace(hologram, **change)) is plain


def test_report_says_what_was_left_out(clean_scene: bpy.types.Scene) -> None:
    device = build(clean_scene, without(document(SIGHT), "pupil"))
    black = np.zeros((4, 4, 3), dtype=np.float32)
    said = view_metrics(device, View(black, black, 0.0))["effects"]
    assert said["promised_relative_error"] == device.plan.promise > 0.0
    left = {each["effect"]: each for each in said["left_out"]}
    assert left["pupil"]["overridden"]
    assert left["pupil"]["predicted_relative_error"] > 0.0
    assert left["pupil"]["why"]
    assert "haze" not in left  # the window does not scatter
