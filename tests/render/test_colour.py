# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours in a real render, seen through the spectral filter past no hologram."""

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.eye import add_eye
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import materials, nodes
from hoe_addon.blender.shaders.spectral import SpectralScene, spectral_scene
from hoe_addon.core import colour
from hoe_addon.core.spectrum import Spectrum, display_primaries, line
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.device_parts import EyeSpec
from hoe_addon.shading.source import ShaderSource

pytestmark = pytest.mark.render

SIDE = 16
"""Pixels along an edge: 256 independent means, enough to measure their scatter to 5 %."""

SIGMAS = 4.0
"""A right value is missed by so much once in 16,000 comparisons of one number."""

ROUNDING = 2e-5
"""float32 of tables, time and sums; also the floor where the scatter is zero."""

LINE_COLOUR = 0.01
"""Share of the largest channel: the colour of a single line is promised within 1 %."""

TABLES = 2e-3
"""Share of the largest channel: 512 cells with straight lines between, and Rec. 709's rounding."""

LUMINANCE = 2.5
EMITTERS = ((1.0, 1.0, 1.0), (1.0, 0.2, 0.05), (0.1, 0.9, 0.3), (0.02, 0.1, 3.0))


@dataclass(frozen=True)
class Measured:
    """Mean colour of the pixels and its standard error, from their scatter."""

    rgb: NDArray[np.float64]
    error: NDArray[np.float64]

    def agrees(self, expected: Any, slack: float = 0.0) -> bool:
        wanted = np.asarray(expected)
        allowed = SIGMAS * self.error + (ROUNDING + slack) * np.max(np.abs(wanted))
        return bool(np.all(np.abs(self.rgb - wanted) <= allowed))


class Stage:
    """An eye that looks at a wall 100 mm away, through the shipped filter."""

    def __init__(self, scene: bpy.types.Scene, spectra: tuple[Spectrum, ...]) -> None:
        self.scene = scene
        self.spectral: SpectralScene = spectral_scene(by_significance(spectra), spectra, 550.0)
        eye = EyeSpec(pupil_diameter_mm=4.0, field_deg=10.0)
        scene.camera = add_eye(scene.collection, eye, self.spectral)
        self.filter = scene.camera.children[0]
        self.wall = meshes.add(scene.collection, meshes.rectangle("Wall", 100.0, 100.0))
        self.wall.location.z = -100.0
        scene.render.resolution_x = scene.render.resolution_y = SIDE
        scene.cycles.pixel_filter_type = "BOX"

    def show(self, material: bpy.types.Material) -> None:
        self.wall.data.materials.clear()
        self.wall.data.materials.append(material)

    def measure(self, *, spectral: bool = True, samples: int = 512, seed: int = 3) -> Measured:
        set_up(self.scene, samples=samples, seed=seed, spectral=spectral, max_bounces=8)
        pixels = render_layers(self.scene, (COMBINED,))[COMBINED].astype(np.float64)
        flat = pixels.reshape(-1, 3)
        return Measured(flat.mean(axis=0), flat.std(axis=0, ddof=1) / np.sqrt(len(flat)))


def emitter(rgb: tuple[float, float, float]) -> bpy.types.Material:
    """Stock Cycles emission, as an artist would make it: a Principled surface."""
    material = bpy.data.materials.new("Emitter")
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
    surface.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    surface.inputs["Specular IOR Level"].default_value = 0.0
    surface.inputs["Emission Color"].default_value = (*rgb, 1.0)
    surface.inputs["Emission Strength"].default_value = 1.0
    tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    return material


def paint(rgb: tuple[float, float, float]) -> bpy.types.Material:
    material = bpy.data.materials.new("Paint")
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (*rgb, 1.0)
    tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    return material


def display(
    stage: Stage, primaries: tuple[Spectrum, Spectrum, Spectrum], drive: tuple[float, float, float]
) -> bpy.types.Material:
    image = materials.picture("Drive", np.full((2, 2, 3), drive, dtype=np.float32))
    stage.wall.data.uv_layers.new(name="UVMap")
    return materials.display_material(image, primaries, "D65", LUMINANCE, stage.spectral)


def line_rgb(wavelength_nm: float) -> NDArray[np.float64]:
    """Linear RGB of monochromatic light of luminance 1, straight from the CIE's table."""
    xyz = colour.xyz_bar(wavelength_nm * 1e-9)
    return colour.XYZ_TO_LINEAR_REC709 @ (xyz / xyz[1])


def primaries_rgb(primaries: tuple[Spectrum, ...]) -> NDArray[np.float64]:
    """Rows: linear RGB of each primary at its share of white; by a plain sum at 0.01 nm steps."""
    wavelength = np.arange(360.0, 830.0, 0.01) * 1e-9
    xyz_bar = colour.xyz_bar(wavelength)
    xyz = np.array([spectrum(wavelength) @ xyz_bar for spectrum in primaries])
    x, y = 0.31272, 0.32903  # CIE 15, D65 for the 2 degree observer
    shares = np.linalg.solve(xyz.T, [x / y, 1.0, (1.0 - x - y) / y])
    return (shares[:, None] * xyz) @ colour.XYZ_TO_LINEAR_REC709.T


@pytest.mark.parametrize("rgb", EMITTERS)
def test_emitter_keeps_its_colour(clean_scene: Any, rgb: tuple[float, float, float]) -> None:
    stage = Stage(clean_scene, display_primaries("led_rgb"))
    stage.show(emitter(rgb))
    seen = stage.measure()
    assert np.all(seen.error < 5e-3 * max(rgb))
    stage.filter.hide_render = True
    plain = stage.measure(spectral=False)
    assert plain.agrees(rgb)
    assert seen.agrees(plain.rgb)


def test_lit_surface_keeps_its_colour(clean_scene: Any) -> None:
    """Noise of the light and of the wavelength together; the two renders have other seeds."""
    stage = Stage(clean_scene, display_primaries("led_rgb"))
    stage.show(paint((0.8, 0.4, 0.1)))
    lamp = bpy.data.lights.new("Lamp", "AREA")
    lamp.energy, lamp.size, lamp.color = 5e5, 40.0, (1.0, 0.8, 0.6)
    holder = bpy.data.objects.new("Lamp", lamp)
    holder.location = (60.0, 0.0, 50.0)
    clean_scene.collection.objects.link(holder)
    seen = stage.measure()
    stage.filter.hide_render = True
    plain = stage.measure(spectral=False, seed=4)
    assert plain.rgb.min() > 0.05
    # The lamp is nearer to one side of the wall: its gradient is in the scatter, not in the means.
    assert np.all(seen.error < 0.02 * plain.rgb.max())
    noise = np.hypot(seen.error, plain.error)
    assert np.all(np.abs(seen.rgb - plain.rgb) <= SIGMAS * noise)


@pytest.mark.parametrize("name", ["led_rgb", "laser_rgb"])
def test_time_is_no_emitter_of_other_colours(clean_scene: Any, name: str) -> None:
    """White stays white whatever the spectra that the sampling was made for."""
    stage = Stage(clean_scene, display_primaries(name))
    stage.show(emitter((1.0, 1.0, 1.0)))
    assert stage.measure().agrees((1.0, 1.0, 1.0))


@pytest.mark.parametrize("wavelength_nm", [460.0, 532.0, 590.0, 630.0])
def test_single_line_has_its_colour(clean_scene: Any, wavelength_nm: float) -> None:
    others = [nm for nm in (630.0, 532.0, 460.0) if nm != wavelength_nm]
    # 590 nm takes the place of the red, so that the three still mix the white.
    chosen = (wavelength_nm, *others[-2:])
    primaries = tuple(line(nm * 1e-9, 1e-9) for nm in chosen)
    stage = Stage(clean_scene, primaries)
    stage.show(display(stage, primaries, (1.0, 0.0, 0.0)))
    seen = stage.measure()
    share = colour.white_balance(primaries)[0]
    expected = LUMINANCE * share * line_rgb(wavelength_nm)
    scale = np.max(np.abs(expected))
    # The noise must be small beside the promise, or the test would say nothing.
    assert np.all(SIGMAS * seen.error < 0.5 * LINE_COLOUR * scale)
    assert np.all(np.abs(seen.rgb - expected) <= LINE_COLOUR * scale)


@pytest.mark.parametrize("name", ["led_rgb", "laser_rgb", "oled_rgb"])
def test_display_has_its_colours(clean_scene: Any, name: str) -> None:
    primaries = display_primaries(name)
    stage = Stage(clean_scene, primaries)
    rows = LUMINANCE * primaries_rgb(primaries)
    drives = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0))
    for drive in drives:
        stage.show(display(stage, primaries, drive))
        assert stage.measure().agrees(np.asarray(drive) @ rows, TABLES)
        preview = stage.measure(spectral=False, samples=4)
        assert np.all(preview.error < ROUNDING)
        assert preview.agrees(np.asarray(drive) @ rows, TABLES)


def test_preview_filter_is_clear(clean_scene: Any) -> None:
    stage = Stage(clean_scene, display_primaries("led_rgb"))
    stage.show(emitter((0.5, 0.25, 2.0)))
    seen = stage.measure(spectral=False, samples=4)
    assert np.allclose(seen.rgb, (0.5, 0.25, 2.0), rtol=1e-6)
    assert np.all(seen.error < 1e-6)


def test_time_is_uniform(clean_scene: Any) -> None:
    """One sample a pixel shows single times; a change of Cycles' shutter table shows here."""
    side = 512
    stage = Stage(clean_scene, ())
    stage.filter.hide_render = True
    text = "shader hoe_test_time(output closure color result = 0) { result = time * emission(); }"
    stage.show(nodes.script_material("Time", ShaderSource("hoe_test_time", text), {}))
    set_up(clean_scene, samples=1, seed=1, spectral=True, max_bounces=8)
    clean_scene.render.resolution_x = clean_scene.render.resolution_y = side
    time = render_layers(clean_scene, (COMBINED,))[COMBINED][..., 0].ravel().astype(np.float64)
    unit = np.sort((time * 256.0 - 0.5) / 254.0)
    count = unit.size
    # Both ends of the range are reached and not passed: 20 mean gaps, and float32 of the table.
    assert -1e-5 < unit[0] < 20.0 / count
    assert 1.0 - 20.0 / count < unit[-1] < 1.0 + 1e-5
    # Kolmogorov and Smirnov: independent times exceed this distance once in 3,000 seeds.
    distance = np.max(np.abs(unit - (np.arange(count) + 0.5) / count))
    assert distance < 2.1 / np.sqrt(count)
    assert abs(unit.mean() - 0.5) < SIGMAS * np.sqrt(1.0 / 12.0 / count)
    assert not np.any(time == 0.5)
