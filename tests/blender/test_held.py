# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene gives back the document that it was built from, also after something has changed."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon import resources
from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.document.held import device_of, document_of, spectrum_of, whole
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.ids import Role
from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import load_device, to_document
from hoe_addon.model.effects import plan_effects

PLACE_MM = 1e-4
"""Places are float32 in the scene: 1e-7 of at most a metre."""

type Build = Callable[..., DeviceScene]


@pytest.fixture
def build(registered: Any) -> Build:
    """Build a preset as a window does, and let the scene hold it."""

    def made(name: str, *changes: str) -> DeviceScene:
        spec = load_device(name, ["render.size=[64, 48]", *changes])
        device = build_device(bpy.context.scene, whole(spec), resources.PRESETS_DIR)
        device = DeviceScene(**{**vars(device), "spec": spec})
        hold(device)
        return device

    return made


def assert_alike(found: Any, wanted: Any, path: str = "") -> None:
    """Equal, but for the rounding of float32."""
    if isinstance(wanted, dict):
        assert found.keys() == wanted.keys(), path
        for name in wanted:
            assert_alike(found[name], wanted[name], f"{path}.{name}")
    elif isinstance(wanted, list):
        assert len(found) == len(wanted), path
        for place, item in enumerate(wanted):
            assert_alike(found[place], item, f"{path}[{place}]")
    elif isinstance(wanted, float | int) and not isinstance(wanted, bool):
        assert math.isclose(found, wanted, rel_tol=3e-7, abs_tol=PLACE_MM), (path, found, wanted)
    else:
        assert found == wanted, path


def unnamed(document: dict[str, Any]) -> dict[str, Any]:
    """A hologram on an element is called as its material is."""
    for element in document.get("elements", ()):
        if "hologram" in element:
            element["hologram"].pop("name")
    return document


@pytest.mark.parametrize("name", resources.preset_paths())
def test_scene_gives_its_document_back(build: Build, name: str) -> None:
    device = build(name)
    found, wanted = (unnamed(to_document(s)) for s in (document_of(device.scene), device.spec))
    assert_alike(found, wanted)


@pytest.mark.parametrize("name", ["two_hologram_ar", "holographic_sight"])
def test_device_is_found_again(build: Build, name: str) -> None:
    built = build(name)
    found = device_of(built.scene)
    for part in ("root", "elements", "eye", "panel", "room"):
        assert getattr(found, part) == getattr(built, part), part
    assert found.spectral.group == built.spectral.group
    assert found.spectral.tables.emission.tolist() == built.spectral.tables.emission.tolist()
    assert spectrum_of(found.spec, found.spectral.group).group == built.spectral.group


def test_document_follows_objects_and_properties(build: Build) -> None:
    scene = build("holographic_sight").scene
    item = next(o for o in scene.objects if o.hologram.role == "display")
    item.location.x += 3.0
    item.hologram.display.luminance_cd_m2 = 77.0
    scene.hologram.eye.pupil_diameter_mm = 2.5
    scene.cycles.seed = 5
    spec = document_of(scene)
    element = spec.element(item.name)
    assert element.display.luminance_cd_m2 == 77.0
    assert element.position_mm[0] == pytest.approx(item.location.x, abs=PLACE_MM)
    assert (spec.eye.pupil_diameter_mm, spec.render.seed) == (2.5, 5)


def test_moved_device_has_the_same_document(build: Build) -> None:
    device = build("two_hologram_ar")
    before = to_document(document_of(device.scene))
    device.root.location = (100.0, -30.0, 12.0)
    device.root.rotation_euler = (0.3, 0.2, 1.0)
    assert_alike(to_document(document_of(device.scene)), before)


def test_what_the_document_does_not_know_turns_all_effects_on(build: Build) -> None:
    scene = build("holographic_sight").scene
    assert document_of(scene).render.effects == ()
    lamp = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    scene.collection.objects.link(lamp)
    assert document_of(scene).render.effects == ("all",)
    lamp.hide_render = True
    assert document_of(scene).render.effects == ()


@pytest.mark.parametrize(
    ("sides", "percentage", "size"),
    [((64, 48), 50, (32, 24)), ((100, 101), 29, (29, 29)), ((64, 48), 150, (96, 72))],
)
def test_size_is_what_blender_renders(
    build: Build, sides: tuple[int, int], percentage: int, size: tuple[int, int]
) -> None:
    scene = build("point_lens").scene
    scene.render.resolution_x, scene.render.resolution_y = sides
    scene.render.resolution_percentage = percentage
    assert document_of(scene).render.size == size


def test_too_small_a_picture_is_told(build: Build) -> None:
    scene = build("point_lens").scene
    scene.render.resolution_percentage = 1
    with pytest.raises(SpecError, match=r"^render\.size"):
        document_of(scene)


def test_choice_for_a_hologram_of_another_name_is_left_out(build: Build) -> None:
    scene = build("point_lens", 'render.effects=["-levels", "lens:+fresnel"]').scene
    lens = scene.objects["lens"]
    assert document_of(scene).render.effects == ("-levels", "lens:+fresnel")
    lens.name = "my lens"
    spec = document_of(scene)
    assert spec.render.effects == ("-levels",)
    plan_effects(spec)
    lens.name = "lens"
    assert document_of(scene).render.effects == ("-levels", "lens:+fresnel")


def test_scaled_element_is_told(build: Build) -> None:
    scene = build("holographic_sight").scene
    item = next(o for o in scene.objects if o.hologram.role == "card" or o.hologram.role == "block")
    item.scale = (2.0, 1.0, 1.0)
    with pytest.raises(SpecError, match=rf"{item.name}.scale: must be 1; apply the scale"):
        document_of(scene)


def test_missing_parts_are_told(build: Build) -> None:
    scene = build("two_hologram_ar").scene
    bpy.data.objects.remove(scene.hologram.eye.camera)
    assert document_of(scene).eye.position_mm == (0.0, 0.0, 0.0)
    with pytest.raises(SpecError, match=r"^eye: must be a camera"):
        device_of(scene)
    with pytest.raises(SpecError, match="holds no device"):
        document_of(bpy.data.scenes.new("Empty"))


@pytest.mark.parametrize(
    ("name", "hologram", "path"),
    [
        ("hud_combiner", "combiner", "combiner.hologram"),
        ("two_hologram_ar", "out_coupler", "holograms[1] (out_coupler)"),
        ("diffractive_achromat", "achromat lens back", "achromat lens.back.hologram"),
    ],
)
def test_a_mistake_in_a_hologram_says_in_which(
    build: Build, name: str, hologram: str, path: str
) -> None:
    scene = build(name).scene
    properties = bpy.data.materials[hologram].hologram
    for part in (properties.recording, properties.characteristic):
        part.wavelength_nm = math.nan
    with pytest.raises(SpecError) as caught:
        document_of(scene)
    told = rf"{re.escape(path)}: \w+\.wavelength_nm: must be "
    assert re.match(told, str(caught.value))


def test_document_survives_a_file(build: Build, tmp_path: Path) -> None:
    scene = build("two_hologram_ar").scene
    before = to_document(document_of(scene))
    path = str(tmp_path / "device.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert to_document(document_of(bpy.context.scene)) == before


def test_element_that_is_no_mesh_is_told(registered: Any) -> None:
    scene = add_scene("point_lens")
    scene.hologram.root.hologram.role = Role.DISPLAY
    with pytest.raises(SpecError, match=r'must be a mesh to be a display; delete it, got "EMPTY"'):
        document_of(scene)
