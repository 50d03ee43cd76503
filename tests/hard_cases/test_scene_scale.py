# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of 1e-3 mm to 1e5 mm, and a device 1e5 mm from the origin of its scene."""

import math

import numpy as np
import pytest

from hoe_addon.blender.build import meshes
from hoe_addon.blender.shaders import nodes
from hoe_addon.core import tracer
from hoe_addon.core.orders import Branch
from hoe_addon.core.units import mm_to_m
from hoe_addon.model.medium import medium_from
from hoe_addon.shading.source import specialised
from tests.hard_cases.mapped_rays import PLANE, RECORDING, SPHERE, Element, exactly, in_numpy
from tests.hard_cases.ray_scene import Floats, RayScene, float32, ray_scene
from tests.hard_cases.test_guide import (
    DRIFT,
    ENERGY,
    HALF_ULP,
    HALF_ULPS_PER_HIT,
    Case,
    in_cycles,
    starts,
    unfolded,
)
from tests.hard_cases.test_transforms import DIRECTION, ROUNDING, misses, moved, rays_to, turned

EXTENT_MM = 20.0
"""Side of the element at scale 1."""

SCALES = {f"{size:g} mm": size / EXTENT_MM for size in (1e-3, 1e-1, 20.0, 1e3, 1e5)}
SURFACES = {"plane": PLANE, "sphere": SPHERE}

GAP = 1e-5
"""Gap of two elements over their side; a start is off its surface by a seventh of this."""

CROSSING = 1000
"""Rays through two close elements."""

SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))

STEEPEST = 85.0
"""Degrees. Near grazing rays start farther along; they still meet what is one gap away."""

PLACE_ULPS = 8.0
"""Halves of the last place of the largest coordinate by which Cycles misplaces a hit on an element
far from the world's origin: of its corners, of the start of the ray, of the sum over the corners,
and of the way back into the object, two each."""

BEND_PER_MM = 1.5 * (600.0 / 532.0) / 55.0
"""rad of an order's tangential part per mm of misplacement: the object wave of `RECORDING` turns by
1 rad in its distance of more than 55 mm, along and across; in glass a wave lags 1.5 times."""


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("size", SCALES)
def test_numpy_at_every_scale(size: str, surface: str, rng: np.random.Generator) -> None:
    element = Element(SURFACES[surface], RECORDING, Branch(1), SCALES[size])
    matrix = np.eye(4)
    origin, direction = (values[:40] for values in rays_to(matrix, rng))
    origin = float32(origin * SCALES[size])
    right = exactly(element, matrix, origin, direction)
    found = in_numpy(element, matrix, origin, direction)
    met = np.isfinite(right[:, 0])
    assert met.sum() > 10
    assert misses(found, right, matrix)[met].max() < ROUNDING


@pytest.mark.render
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("size", SCALES)
def test_cycles_at_every_scale(size: str, surface: str, rng: np.random.Generator) -> None:
    element = Element(SURFACES[surface], RECORDING, Branch(1), SCALES[size])
    matrix = np.eye(4)
    origin, direction = rays_to(matrix, rng)
    origin = float32(origin * SCALES[size])
    with ray_scene() as scene:
        element.in_cycles(scene, (matrix,))
        found = scene.leave(origin, direction)
    right = exactly(element, matrix, origin, direction)
    met = np.isfinite(right[:, 0])
    np.testing.assert_array_equal(np.isfinite(found.direction[:, 0]), met)
    assert misses(found.direction, right, matrix)[met].max() < DIRECTION


@pytest.mark.render
def test_a_tiny_element_may_be_built_larger(rng: np.random.Generator) -> None:
    """With units_per_mm a scene of 1e-3 mm gets the coordinates of one of 20 mm."""
    element = Element(PLANE, RECORDING, Branch(1), 1e-3 / EXTENT_MM)
    larger = Element(PLANE, RECORDING, Branch(1))
    origin, direction = rays_to(np.eye(4), rng)
    with ray_scene() as scene:
        element.in_cycles(scene, (np.eye(4),), units_per_mm=1.0 / element.scale)
        found = scene.leave(origin, direction)
    right = exactly(larger, np.eye(4), origin, direction)
    met = np.isfinite(right[:, 0])
    assert misses(found.direction, right, np.eye(4))[met].max() < DIRECTION


def plates(scene: RayScene, gap: float, scale: float) -> Floats:
    """Two clear plates, one behind the other, turned; their common matrix."""
    clear = nodes.script_material("clear", specialised("hoe_dielectric", {}), {"inside_a": 1.0})
    matrix = turned(0.5, -0.8, 2.0)
    side = EXTENT_MM * scale
    for height in (0.0, gap):
        corners = [(x * side / 2, y * side / 2, height) for x, y in SQUARE]
        mesh = meshes.from_polygons("plate", corners, [(0, 1, 2, 3)])
        scene.add(mesh, clear).matrix_basis = matrix.T.tolist()
    scene.scene.view_layers[0].update()
    return matrix


def rays_between(scale: float, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Starts and directions of rays that meet two near plates around z = 0."""
    place = np.column_stack((rng.uniform(-9.0, 9.0, (CROSSING, 2)), np.zeros(CROSSING)))
    tilt = np.tan(np.radians(rng.uniform(0.0, STEEPEST, CROSSING)))
    azimuth = rng.uniform(0.0, 2.0 * np.pi, CROSSING)
    side = np.where(rng.random(CROSSING) < 0.5, -1.0, 1.0)
    direction = np.column_stack((tilt * np.cos(azimuth), tilt * np.sin(azimuth), side))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    return scale * (place - 0.5 * direction), direction


@pytest.mark.parametrize("size", SCALES)
def test_numpy_meets_close_elements_once(size: str, rng: np.random.Generator) -> None:
    origin, direction = rays_between(SCALES[size], rng)
    side = float(mm_to_m(EXTENT_MM * SCALES[size]))
    aperture = tracer.Aperture(tracer.Rectangle(side, side))
    air = medium_from(1.0)
    clear = [
        tracer.Dielectric(
            frame=tracer.Frame.at((0.0, 0.0, height)),
            aperture=aperture,
            index_back=air,
            index_front=air,
        )
        for height in (0.0, GAP * side)
    ]
    for sign in (-1.0, 1.0):
        going = direction[:, 2] * sign > 0.0
        rays = tracer.Rays.of(mm_to_m(origin[going]), direction[going], 532e-9)
        everywhere = tracer.Aperture(tracer.Rectangle(math.inf, math.inf))
        behind = tracer.Frame.at((0.0, 0.0, sign * side))
        walk = tracer.walk_tree(rays, clear, tracer.Receiver(frame=behind, aperture=everywhere))
        np.testing.assert_array_equal(walk.landed.interactions, 2)
        assert len(walk.landed.interactions) == going.sum()


@pytest.mark.render
@pytest.mark.parametrize("size", SCALES)
def test_cycles_meets_close_elements_once(size: str, rng: np.random.Generator) -> None:
    """A start skips nothing that is farther than `GAP`, and meets nothing twice."""
    origin, direction = rays_between(SCALES[size], rng)
    with ray_scene() as scene:
        matrix = plates(scene, GAP * EXTENT_MM * SCALES[size], SCALES[size])[:3, :3]
        met = scene.crossings(origin @ matrix.T, direction @ matrix.T)
    np.testing.assert_array_equal(met, 2.0)


THINNEST = 1e-4
EDGE_START = 5e-5
"""Scene units. A start beside an edge of a triangle is so far off its surface at every scale:
Cycles moves one that is nearer than 3.2e-5. Parts as thin are built larger, by units_per_mm."""

EDGE_STARTS = 3
"""Most hits of 300 that may be so near an edge: 2e-6 to 6e-5 of the faces are."""

GUIDES = {
    f"{thickness:g} mm thick, {degrees:g} degrees": Case(degrees, thickness_mm=thickness)
    for thickness in (THINNEST, 1e-2, 1e3)
    for degrees in (60.0, 89.0)
}


@pytest.mark.render
@pytest.mark.parametrize("name", GUIDES)
def test_guide_at_every_scale(name: str, rng: np.random.Generator) -> None:
    """A guide of 50 um reflects as often, and takes rays as far across, as one of kilometres."""
    case = GUIDES[name]
    place, direction = starts(case, rng)
    right = unfolded(case, place, direction)
    with ray_scene(1024) as scene:
        found, weight = in_cycles(scene, case, place, direction)
    shift = HALF_ULPS_PER_HIT * HALF_ULP * case.extent_mm * right.reflections
    shift += EDGE_STARTS * EDGE_START
    assert np.all(np.abs(found.across_mm - right.across_mm) < shift)
    sign = np.where((found.reflections - right.reflections) % 2 == 1, -1.0, 1.0)
    np.testing.assert_allclose(found.direction[:, 0], right.direction[:, 0], atol=DRIFT)
    np.testing.assert_allclose(found.direction[:, 2], sign * right.direction[:, 2], atol=DRIFT)
    np.testing.assert_allclose(weight, 1.0, atol=ENERGY)


@pytest.mark.render
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("far_mm", [1e3, 1e4, 1e5])
def test_far_from_the_origin(far_mm: float, surface: str, rng: np.random.Generator) -> None:
    """A device that stands far away: float32 misplaces hits, and that is all that is lost."""
    element = Element(SURFACES[surface], RECORDING, Branch(1))
    placed = moved(far_mm, -0.7 * far_mm, 0.9 * far_mm) @ turned(0.5, -0.8, 2.0)
    origin, direction = rays_to(placed, rng)
    with ray_scene() as scene:
        item = element.in_cycles(scene, (placed,))
        matrix = np.array(item.matrix_world, dtype=np.float64)
        found = scene.leave(origin, direction)
    right = exactly(element, matrix, origin, direction)
    both = np.isfinite(right[:, 0]) & np.isfinite(found.direction[:, 0])
    misplaced = PLACE_ULPS * HALF_ULP * far_mm
    assert both.sum() > 100
    assert misses(found.direction, right, matrix)[both].max() < DIRECTION + BEND_PER_MM * misplaced
