# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each trouble is found, told in one sentence, and mended by its click."""

import statistics
import time
from collections.abc import Callable
from typing import Any

import bpy
import pytest

from hoe_addon.blender import readiness
from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.props.device import VERSION
from hoe_addon.blender.props.made import is_stale
from hoe_addon.blender.props.sync import hologram_node, refresh_changed
from hoe_addon.blender.readiness import Mend, mend, troubles
from hoe_addon.blender.shaders import osl
from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import find_device, load_device

PRESET = "two_hologram_ar"

DRAWN_S = 100e-6
"""Time of the processor that a panel may spend on it; 25 us measured."""


@pytest.fixture
def scene(registered: Any) -> Any:
    """A light guide as the window holds it."""
    spec = load_device(PRESET, ['render.effects=["all"]', "room.kind=none"])
    device = build_device(registered, spec, find_device(PRESET).parent)
    hold(device)
    return device.scene


def the_trouble(scene: Any) -> Any:
    (found,) = troubles(scene)
    return found


def test_a_scene_without_holograms_has_no_trouble(registered: Any) -> None:
    assert registered.render.engine != "CYCLES"
    assert troubles(registered) == ()
    hologram = bpy.data.materials.new("elsewhere")
    hologram.hologram.enabled = hologram.use_fake_user = True
    assert troubles(registered) == (), "it is in no object of this scene"


def test_a_built_scene_is_ready(scene: Any) -> None:
    assert troubles(scene) == ()


def spoil_engine(scene: Any) -> None:
    scene.render.engine = "BLENDER_EEVEE"


def spoil_osl(scene: Any) -> None:
    scene.cycles.shading_system = False


def spoil_motion_blur(scene: Any) -> None:
    scene.render.use_motion_blur = False


def spoil_shutter(scene: Any) -> None:
    scene.render.motion_blur_shutter_curve.curves[0].points[0].location[1] = 0.5


def spoil_rolling(scene: Any) -> None:
    scene.cycles.rolling_shutter_type = "TOP"


def spoil_denoising(scene: Any) -> None:
    scene.cycles.use_denoising = True


def spoil_adaptive(scene: Any) -> None:
    scene.cycles.use_adaptive_sampling = True


def spoil_clamp(scene: Any) -> None:
    scene.cycles.sample_clamp_indirect = 10.0


def spoil_bounces(scene: Any) -> None:
    scene.cycles.transparent_max_bounces = 8


def spoil_camera(scene: Any) -> None:
    other = bpy.data.objects.new("other", bpy.data.cameras.new("other"))
    scene.collection.objects.link(other)
    scene.camera = other


def spoil_shader(scene: Any) -> None:
    """As in a script, where no timer runs."""
    bpy.data.materials["in_coupler"].hologram.recording.wavelength_nm = 600.0
    for _ in range(2):
        if bpy.app.timers.is_registered(readiness.changes._tell):
            bpy.app.timers.unregister(readiness.changes._tell)


CASES: list[tuple[Callable[[Any], None], Mend, str]] = [
    (spoil_engine, Mend.ENGINE, "Cycles"),
    (spoil_osl, Mend.OSL, "Open Shading Language is off"),
    (spoil_motion_blur, Mend.WAVELENGTHS, "shutter"),
    (spoil_shutter, Mend.WAVELENGTHS, "shutter"),
    (spoil_rolling, Mend.WAVELENGTHS, "shutter"),
    (spoil_denoising, Mend.COLOURS, "Denoising"),
    (spoil_adaptive, Mend.COLOURS, "adaptive sampling"),
    (spoil_clamp, Mend.COLOURS, "clamping"),
    (spoil_bounces, Mend.BOUNCES, "loses light"),
    (spoil_camera, Mend.CAMERA, "not the eye"),
    (spoil_shader, Mend.REFRESH, "in_coupler: the shader is older"),
]


@pytest.mark.parametrize(
    ("spoil", "kind", "words"),
    CASES,
    ids=[case[0].__name__.removeprefix("spoil_") for case in CASES],
)
def test_found_told_and_mended(
    scene: Any, spoil: Callable[[Any], None], kind: Mend, words: str
) -> None:
    spoil(scene)
    found = the_trouble(scene)
    assert found.mend == kind
    assert words in found.words
    assert found.words.endswith(".")
    assert found.button
    mend(scene, found)
    assert troubles(scene) == ()


def test_a_device_that_cannot_run_osl(scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    scene.cycles.device = "GPU"

    def kind_of(asked: Any) -> str | None:
        return "HIP" if asked.cycles.device == "GPU" else None

    monkeypatch.setattr(readiness, "device_without_osl", kind_of)
    monkeypatch.setattr(osl, "device_without_osl", kind_of)
    found = the_trouble(scene)
    assert (found.mend, found.button) == (Mend.DEVICE, "Render on CPU")
    assert "HIP" in found.words
    mend(scene, found)
    assert scene.cycles.device == "CPU"
    assert troubles(scene) == ()


def test_a_build_without_osl(scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("_cycles.with_osl", False)
    found = the_trouble(scene)
    assert found.mend is None
    assert "blender.org" in found.words
    osl.compiled.cache_clear()
    material = bpy.data.materials["in_coupler"]
    material.hologram.pattern = "characteristic"
    refresh_changed()
    assert "without Open Shading Language" in material.hologram.problem
    assert the_trouble(scene) == found, "told once"


def test_one_wavelength_needs_no_shutter_and_no_filter(scene: Any) -> None:
    scene.hologram.render.mode = "preview"
    spoil_motion_blur(scene)
    spoil_denoising(scene)
    spoil_camera(scene)
    assert troubles(scene) == ()


def test_an_eye_without_filter(scene: Any) -> None:
    for child in scene.camera.children:
        bpy.data.objects.remove(child)
    found = the_trouble(scene)
    assert found.mend is None
    assert "Add > Hologram > Eye" in found.words


def test_a_problem_of_a_hologram(scene: Any) -> None:
    material = bpy.data.materials["in_coupler"]
    material.hologram.frame.x = (0.0, 0.0, 0.0)
    refresh_changed()
    found = the_trouble(scene)
    assert found.mend is None
    assert found.words.startswith("in_coupler: frame: must have two unit axes")
    material.hologram.frame.x = (1.0, 0.0, 0.0)
    refresh_changed()
    assert troubles(scene) == ()


def test_a_newer_file_has_this_trouble_only(scene: Any) -> None:
    spoil_engine(scene)
    scene.hologram.version = VERSION + 1
    found = the_trouble(scene)
    assert found.mend is None
    assert "newer version" in found.words


def test_what_is_worst_comes_first(scene: Any) -> None:
    spoil_denoising(scene)
    spoil_engine(scene)
    assert [each.mend for each in troubles(scene)] == [Mend.ENGINE, Mend.COLOURS]


def test_reading_compiles_and_writes_nothing(scene: Any) -> None:
    osl.compiled.cache_clear()
    node = hologram_node(bpy.data.materials["in_coupler"])
    before = node.script.name
    spoil_shader(scene)
    troubles(scene)
    assert osl.compiled.cache_info().misses == 0
    assert node.script.name == before


def test_quick_enough_to_be_drawn(scene: Any) -> None:
    seconds = []
    for _ in range(20):
        start = time.process_time()
        for _ in range(10):
            troubles(scene)
        seconds.append((time.process_time() - start) / 10)
    assert statistics.median(seconds) < DRAWN_S


def test_holograms_of_other_scenes_are_not_told(scene: Any) -> None:
    other = bpy.data.scenes.new("other")
    broken = bpy.data.materials["in_coupler"].copy()
    meshes.add(other.collection, meshes.rectangle("Plate", 40.0, 40.0), broken)
    broken.hologram.frame.x = (0.0, 0.0, 0.0)
    refresh_changed()
    assert broken.hologram.problem
    assert troubles(scene) == ()
    assert any(broken.hologram.problem in trouble.words for trouble in troubles(other))


def test_a_patch_that_no_face_has_yet_is_told(scene: Any) -> None:
    bare = bpy.data.materials["in_coupler"].copy()
    scene.hologram.patches[0].material = bare
    bare.hologram.problem = "broken"
    assert "broken" in the_trouble(scene).words


def test_refresh_mends_the_others_where_one_fails(scene: Any) -> None:
    """The first of them by name fails."""
    invalid, stale = (bpy.data.materials[name] for name in ("in_coupler", "out_coupler"))
    spoil_shader(scene)
    invalid.hologram.frame.x = (0.0, 0.0, 0.0)
    stale.hologram.recording.wavelength_nm = 600.0
    if bpy.app.timers.is_registered(readiness.changes._tell):
        bpy.app.timers.unregister(readiness.changes._tell)
    refresh = next(each for each in troubles(scene) if each.mend == Mend.REFRESH)
    with pytest.raises(SpecError, match="frame: must have two unit axes"):
        mend(scene, refresh)
    assert not is_stale(stale)
    assert readiness.changes.is_changed(invalid)
    assert not readiness.changes.is_changed(stale)
    assert invalid.hologram.problem
