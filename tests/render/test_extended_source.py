# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Extended sources in Cycles: the shader's random numbers, and the blur that they make."""

import json
import math
from pathlib import Path

import bpy
import msgspec
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import mm_to_m
from hoe_addon.core.waves import ExtendedSource
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable, TraceResult
from hoe_addon.model.waves import WaveSpec
from hoe_addon.shading.source import ShaderSource

pytestmark = pytest.mark.render

SIGMA = 4.5
"""Standard deviations of chi-square; seeds are fixed, 1e-5 of others would fail."""

SIDE = 192
"""Pixels; 36864 numbers in a picture."""

NUMBERS = """
shader hoe_test_numbers(int pick = 0, output closure color result = 0)
{
    color first = color(hoe_random(0, 0), hoe_random(0, 1), hoe_random(0, 2));
    color second = color(hoe_random(1, 0), hoe_random(1, 1), time);
    result = (pick ? second : first) * emission();
}
"""

DOCUMENTS = json.loads(
    (Path(__file__).parents[1] / "documents" / "waves.json").read_text(encoding="utf-8")
)
STAR_RAYS = 4000
BLUR = 2e-4
"""Of the source's size: float32 directions (2e-6 rad) over 60 mm, against half a 2 mm width."""


def assert_even(counts: np.ndarray) -> None:
    """Pearson's chi-square by its normal approximation."""
    expected = counts.sum() / counts.size
    assert expected >= 5.0
    freedom = counts.size - 1
    chi_square = np.sum((counts - expected) ** 2) / expected
    assert abs(chi_square - freedom) < SIGMA * math.sqrt(2.0 * freedom)


def assert_independent(first: np.ndarray, second: np.ndarray) -> None:
    """Each pair is even on a square: so both are even, and neither tells of the other."""
    counts, *_ = np.histogram2d(first.ravel(), second.ravel(), bins=16, range=[[0, 1], [0, 1]])
    assert counts.sum() == first.size
    assert_even(counts)


def pictures(scene: bpy.types.Scene, *, spectral: bool, seed: int) -> np.ndarray:
    """Six numbers per pixel, shape ``(SIDE, SIDE, 6)``: object's three, reference's two, time."""
    set_up(scene, samples=1, seed=seed, spectral=spectral, max_bounces=4)
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    header = resources.osl_path("hoe_random.h").read_text(encoding="utf-8")
    source = ShaderSource("hoe_test_numbers", header + NUMBERS)
    material = nodes.script_material("numbers", source, {})
    element = meshes.add(scene.collection, meshes.rectangle("numbers", 20.0, 20.0))
    element.data.materials.append(material)
    camera = bpy.data.cameras.new("numbers")
    camera.type = "ORTHO"
    camera.ortho_scale = 10.0
    scene.camera = bpy.data.objects.new("numbers", camera)
    scene.camera.location = (0.3, 0.7, 5.0)
    scene.collection.objects.link(scene.camera)
    node = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeScript")
    found = []
    for pick in (0, 1):
        nodes.set_values(node, {"pick": pick})
        found.append(render_layers(scene, (COMBINED,))[COMBINED])
    return np.concatenate(found, axis=2)


@pytest.mark.parametrize("spectral", [True, False], ids=["rendered", "preview"])
def test_numbers_are_even_and_independent(clean_scene: bpy.types.Scene, spectral: bool) -> None:
    numbers = pictures(clean_scene, spectral=spectral, seed=3)
    draws = numbers[..., :5]
    assert draws.min() >= 0.0
    assert draws.max() < 1.0
    for place in range(5):
        counts, _ = np.histogram(draws[..., place], bins=256, range=(0, 1))
        assert_even(counts)
        # Neighbouring pixels.
        assert_independent(draws[:, :-1, place], draws[:, 1:, place])
        assert_independent(draws[:-1, :, place], draws[1:, :, place])
        for other in range(place):
            assert_independent(draws[..., place], draws[..., other])
    if spectral:
        # Ray time, which is the wavelength, must not choose the point of the source.
        for place in range(5):
            assert_independent(draws[..., place], np.clip(numbers[..., 5], 0.0, 1.0))
    else:
        assert np.all(numbers[..., 5] == 0.5)


def test_samples_of_one_pixel_are_independent(clean_scene: bpy.types.Scene) -> None:
    first = pictures(clean_scene, spectral=True, seed=1)
    second = pictures(clean_scene, spectral=True, seed=2)
    for place in range(5):
        assert_independent(first[..., place], second[..., place])


def star(name: str, role: str) -> HologramSpec:
    plane = {"kind": "plane", "direction": [0.1, -0.2, 1]}
    recording = {"object": plane, "reference": plane} | {role: DOCUMENTS[name]}
    return hologram_from(
        {
            "schema": 1,
            "name": "star",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"back": 1.0, "front": 1.0},
            "recording": {"wavelength_nm": 532, **recording},
            "efficiency": {"model": "constant", "table": {"T": {"1": 0.5, "-1": 0.5}}},
            "orders": [-1, 1],
        }
    )


def star_rays(rng: np.random.Generator, order: int) -> RayTable:
    """A plane wave on a region of 0.2 mm."""
    points = np.column_stack([rng.uniform(-0.1, 0.1, (STAR_RAYS, 2)), np.zeros(STAR_RAYS)])
    travel = np.array([0.1, -0.2, 1.0]) / np.linalg.norm([0.1, -0.2, 1.0])
    return RayTable(
        points - 5.0 * travel,
        np.broadcast_to(travel, (STAR_RAYS, 3)),
        np.full(STAR_RAYS, 532.0),
        np.full(STAR_RAYS, order),
        np.zeros(STAR_RAYS, dtype=bool),
    )


def on_source(
    result: TraceResult, centre: tuple[float, float, float], axes: np.ndarray
) -> np.ndarray:
    """Where the outgoing rays, taken back, meet the plane of the source, in half widths."""
    assert (result.status == Status.OK).all()
    normal = np.cross(axes[0], axes[1])
    points = mm_to_m(result.hit_mm)
    away = np.array(centre) - points
    along = (away @ normal) / (result.direction @ normal)
    place = points + result.direction * along[:, None] - np.array(centre)
    return np.stack([place @ axis / np.dot(axis, axis) for axis in axes], axis=-1)


@pytest.mark.parametrize("engine", [trace, trace_cycles])
@pytest.mark.parametrize("role", ["object", "reference"])
def test_star_is_blurred_by_a_disc(engine, role: str, rng: np.random.Generator) -> None:
    shape = source_shape("disc")
    rays = star_rays(rng, 1 if role == "object" else -1)
    place = on_source(engine(star("disc", role), rays), shape.centre, np.array([shape.x, shape.y]))
    squared = np.sum(place**2, axis=1)
    assert squared.max() < 1.0 + BLUR
    counts, *_ = np.histogram2d(
        squared,
        np.arctan2(place[:, 1], place[:, 0]),
        bins=10,
        range=[[0, 1 + BLUR], [-np.pi, np.pi]],
    )
    assert counts.sum() == STAR_RAYS
    assert_even(counts)


@pytest.mark.parametrize("engine", [trace, trace_cycles])
def test_star_is_blurred_by_a_rectangle(engine, rng: np.random.Generator) -> None:
    shape = source_shape("rectangle")
    result = engine(star("rectangle", "object"), star_rays(rng, 1))
    place = on_source(result, shape.centre, np.array([shape.x, shape.y]))
    assert np.abs(place).max() < 1.0 + BLUR
    edge = 1 + BLUR
    counts, *_ = np.histogram2d(*place.T, bins=10, range=[[-edge, edge]] * 2)
    assert counts.sum() == STAR_RAYS
    assert_even(counts)


@pytest.mark.parametrize("engine", [trace, trace_cycles])
def test_star_is_blurred_by_a_line(engine, rng: np.random.Generator) -> None:
    shape = source_shape("line")
    result = engine(star("line", "object"), star_rays(rng, 1))
    across = np.cross(shape.x, (0.0, 0.0, 1.0))
    place = on_source(result, shape.centre, np.array([shape.x, across]))
    assert np.abs(place[:, 0]).max() < 1.0 + BLUR
    np.testing.assert_allclose(place[:, 1], 0.0, atol=BLUR)
    counts, _ = np.histogram(place[:, 0], bins=50, range=(-1 - BLUR, 1 + BLUR))
    assert counts.sum() == STAR_RAYS
    assert_even(counts)


@pytest.mark.parametrize("engine", [trace, trace_cycles])
def test_star_is_blurred_by_a_flat_mesh(engine, rng: np.random.Generator) -> None:
    """Two triangles of unequal area in one plane: the big one gets four fifths of the rays."""
    mesh = {
        "kind": "extended",
        "shape": {
            "shape": "mesh",
            "vertices_mm": [[0, 0, 0], [4, 0, 0], [0, 2, 0], [0, -1, 0], [-2, 0, 0]],
            "faces": [[0, 1, 2], [0, 4, 3]],
        },
        "position_mm": [1, 2, -60],
        "normal": [0.1, 0.2, 1],
    }
    document = msgspec.to_builtins(star("disc", "object"))
    document["recording"]["object"] = mesh
    spec = hologram_from({k: v for k, v in document.items() if v is not None})
    axes = msgspec.convert(mesh, WaveSpec).axes() / 1000.0
    result = engine(spec, star_rays(rng, 1))

    place = on_source(result, (0.001, 0.002, -0.06), axes[:2])
    big = (place.min(axis=1) >= -BLUR) & (place @ (1 / 4, 1 / 2) <= 1 + BLUR)
    small = (place.max(axis=1) <= BLUR) & (place @ (-1 / 2, -1.0) <= 1 + BLUR)
    assert np.all(big | small)
    share, spread = big.mean(), math.sqrt(0.8 * 0.2 / STAR_RAYS)
    assert share == pytest.approx(0.8, abs=SIGMA * spread)
    # Even over the big one: 16 triangles of equal area.
    a, b = place[big, 0] / 4.0, place[big, 1] / 2.0
    upper = (4 * a) % 1.0 + (4 * b) % 1.0 > 1.0
    cell = (4 * a).astype(int) * 8 + (4 * b).astype(int) * 2 + upper
    _, counts = np.unique(cell, return_counts=True)
    assert counts.size == 16
    assert_even(counts)


def test_numpy_draws_the_same_rays_again(rng: np.random.Generator) -> None:
    spec, rays = star("disc", "object"), star_rays(rng, 1)
    first, again = trace(spec, rays), trace(spec, rays)
    assert np.array_equal(first.direction, again.direction)
    assert len(np.unique(first.direction[:, 0])) > 0.99 * STAR_RAYS


def source_shape(name: str) -> object:
    source = wave_from(msgspec.convert(DOCUMENTS[name], WaveSpec))
    assert isinstance(source, ExtendedSource)
    return source.shape
