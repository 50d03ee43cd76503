# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays exactly at edges and corners of triangles, elements in contact, walls that meet a face."""

from itertools import product

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.guide import add_guide
from hoe_addon.blender.shaders import nodes
from hoe_addon.blender.shaders.spectral import spectral_scene
from hoe_addon.core.orders import Branch
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.device import GuideSpec, PatchSpec
from hoe_addon.model.efficiency.constant import ConstantSpec, ShareTable
from hoe_addon.model.recording import RecordingSpec
from hoe_addon.model.waves import PlaneWaveSpec
from hoe_addon.shading.source import specialised
from tests.hard_cases.mapped_rays import PLANE, Element, exactly, in_numpy
from tests.hard_cases.ray_scene import Floats, RayScene, float32, ray_scene
from tests.hard_cases.test_transforms import DIRECTION, ROUNDING, misses, moved, scaled, turned

CELLS = 8
"""A power of two, so that float32 holds the corners of the grid."""

CONSTANT = {
    "object": {"kind": "plane", "direction": [0.2, 0.1, 1]},
    "reference": {"kind": "plane", "direction": [0, 0, 1]},
}
LINES = Element(PLANE, CONSTANT, Branch(1))
OTHER_LINES = Element(PLANE, CONSTANT, Branch(-1))

PLACED = {
    "upright": np.eye(4),
    "moved": moved(12.0, -7.0, 3.0),
    "turned": moved(12.0, -7.0, 3.0) @ turned(0.5, -0.8, 2.0),
    "mirrored": turned(0.5, -0.8, 2.0) @ scaled(-1.0, 1.0, 1.0),
    "1e-3 of the size": scaled(2.0**-10, 2.0**-10, 2.0**-10),
    "8e3 of the size": turned(0.5, -0.8, 2.0) @ scaled(8192.0, 8192.0, 8192.0),
    "far away": moved(1e5, -7e4, 9e4),
}

NEAR = (0.0, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4)
"""Distances from an edge, over the size: on it, within its rounding, within a start's clearance."""


def grid(triangles: bool) -> bpy.types.Mesh:
    """A square of 20 mm in cells, which are quadrangles that Blender cuts, or fans of triangles."""
    steps = np.arange(CELLS + 1) * (20.0 / CELLS) - 10.0
    corners = [(x, y, 0.0) for y in steps.tolist() for x in steps.tolist()]
    across = CELLS + 1
    rings = [
        (row * across + column + np.array((0, 1, across + 1, across))).tolist()
        for row, column in product(range(CELLS), range(CELLS))
    ]
    if not triangles:
        return meshes.from_polygons("grid", corners, rings)
    faces: list[tuple[int, int, int]] = []
    for ring in rings:
        x, y, _ = np.mean([corners[number] for number in ring], axis=0).tolist()
        corners.append((x, y, 0.0))
        faces += [(ring[k - 1], ring[k], len(corners) - 1) for k in range(4)]
    return meshes.from_polygons("fans", corners, faces)


def rays_to_edges() -> tuple[Floats, Floats]:
    """Rays to corners, edges and diagonals of the grid and near them, from both sides."""
    half = 10.0 / CELLS
    steps = np.arange(1, 2 * CELLS) * half - 10.0
    place = np.array([(x, y, 0.0) for x in steps for y in steps])
    beside = np.array([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)])
    place = np.concatenate([place + 10.0 * near * way for near in NEAR for way in beside])
    ways = np.array([(0.0, 0.0, 1.0), (0.5, 0.25, 1.0), (-2.0, 1.0, 0.5)])
    # The steepest one has no order out of glass.
    ways = np.concatenate((ways[:2], -ways))
    place, way = place[:: len(ways)], ways[np.arange(len(place[:: len(ways)])) % len(ways)]
    return place - 4.0 * way, way


def sent(matrix: Floats) -> tuple[Floats, Floats]:
    """The rays of `rays_to_edges` in the world, as float32 has them."""
    origin, direction = rays_to_edges()
    direction = direction @ matrix[:3, :3].T
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    return float32(origin @ matrix[:3, :3].T + matrix[:3, 3]), float32(direction)


def put(scene: RayScene, element: Element, matrix: Floats, *, triangles: bool) -> Floats:
    """The grid with this hologram; its matrix as Blender has it."""
    item = scene.add(grid(triangles), element.material(once=False))
    item.matrix_basis = matrix.T.tolist()
    scene.scene.view_layers[0].update()
    return np.array(item.matrix_world, dtype=np.float64)


@pytest.mark.parametrize("name", PLACED)
def test_numpy_at_edges(name: str) -> None:
    """What the renders below are compared with, against 50 digits."""
    origin, direction = (values[::20] for values in sent(PLACED[name]))
    for element in (LINES, OTHER_LINES):
        right = exactly(element, PLACED[name], origin, direction)
        found = in_numpy(element, PLACED[name], origin, direction)
        assert misses(found, right, PLACED[name]).max() < ROUNDING


@pytest.mark.render
@pytest.mark.parametrize("triangles", [False, pytest.param(True, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", PLACED)
def test_edges_and_corners_diffract_once(name: str, triangles: bool) -> None:
    origin, direction = sent(PLACED[name])
    with ray_scene() as scene:
        matrix = put(scene, LINES, PLACED[name], triangles=triangles)
        crossed = scene.crossings(origin, direction)
        found = scene.leave(origin, direction).direction
    np.testing.assert_array_equal(crossed, 1.0)
    right = in_numpy(LINES, matrix, origin, direction)
    assert misses(found, right, matrix).max() < DIRECTION


@pytest.mark.render
@pytest.mark.parametrize(
    "triangles", [(False, True), pytest.param((False, False), marks=pytest.mark.slow)]
)
@pytest.mark.parametrize("name", PLACED)
def test_of_elements_in_contact_one_acts(name: str, triangles: tuple[bool, bool]) -> None:
    """Which one is left open; never both, and neither one twice."""
    origin, direction = sent(PLACED[name])
    with ray_scene() as scene:
        matrix = put(scene, LINES, PLACED[name], triangles=triangles[0])
        put(scene, OTHER_LINES, PLACED[name], triangles=triangles[1])
        crossed = scene.crossings(origin, direction)
        found = scene.leave(origin, direction).direction
    np.testing.assert_array_equal(crossed, 1.0)
    wrong = [
        misses(found, in_numpy(element, matrix, origin, direction), matrix)
        for element in (LINES, OTHER_LINES)
    ]
    assert np.min(wrong, axis=0).max() < DIRECTION


@pytest.mark.render
@pytest.mark.parametrize("side", [1e-3, 20.0, 1e5])
def test_the_diagonal_of_a_turned_plate_is_met_once(side: float, rng: np.random.Generator) -> None:
    """Blender cuts a rectangle in two; large ones were met twice there by 3 rays of 100."""
    clear = nodes.script_material("clear", specialised("hoe_dielectric", {}), {"inside_a": 1.0})
    place = side * rng.uniform(-0.45, 0.45, (1000, 1)) * np.array((1.0, 1.0, 0.0))
    tilt, azimuth = np.radians(rng.uniform(50.0, 60.0, 1000)), rng.uniform(0.0, 6.0, 1000)
    sine = np.sin(tilt)
    way = np.column_stack((sine * np.cos(azimuth), sine * np.sin(azimuth), -np.cos(tilt)))
    matrix = turned(0.5, -0.8, 2.0)
    with ray_scene() as scene:
        item = scene.add(meshes.rectangle("plate", side, side), clear)
        item.matrix_basis = matrix.T.tolist()
        scene.scene.view_layers[0].update()
        start = (place - 0.25 * side * way) @ matrix[:3, :3].T
        crossed = scene.crossings(start, way @ matrix[:3, :3].T)
    np.testing.assert_array_equal(crossed, 1.0)


def guide() -> tuple[GuideSpec, tuple[PatchSpec, ...]]:
    """A plate with patches on both faces, whose edges cut the faces."""
    spec = GuideSpec(
        medium=1.5, outside=1.0, thickness_mm=0.3, size_mm=(40.0, 24.0), relief_mm=20.0
    )
    recording = RecordingSpec(
        wavelength_nm=532.0,
        object=PlaneWaveSpec(direction=(0.2, 0.1, 1.0)),
        reference=PlaneWaveSpec(direction=(0.0, 0.0, 1.0)),
    )
    folds = ConstantSpec(table=ShareTable(T={"0": 1.0}), total_internal_reflection=True)
    return spec, tuple(
        PatchSpec(
            name=f"{face} {x}",
            face=face,
            center_mm=(x, y),
            size_mm=(9.0, 7.0),
            recording=recording,
            efficiency=folds,
        )
        for face, x, y in (("world", -10.0, 2.0), ("eye", 3.0, -4.0), ("eye", 13.0, 5.0))
    )


def rays_in(item: bpy.types.Object, spec: GuideSpec) -> tuple[Floats, Floats]:
    """Rays inside the plate to corners and edges of its faces, and to places beside them."""
    mesh = item.data
    assert isinstance(mesh, bpy.types.Mesh)
    corners = np.array([tuple(vertex.co) for vertex in mesh.vertices])
    ends = np.array([tuple(edge.vertices) for edge in mesh.edges])
    along = [corners[ends[:, 0]] * (1 - t) + corners[ends[:, 1]] * t for t in (0.0, 0.25, 0.5)]
    place = np.concatenate(along)
    place = place[np.isin(place[:, 2], corners[:, 2])]
    place = np.concatenate([place * (1.0 + near, 1.0 + near, 1.0) for near in NEAR])
    width, height = spec.size_mm
    place[:, 0] = place[:, 0].clip(-width / 2, width / 2)
    place[:, 1] = place[:, 1].clip(-height / 2, height / 2)
    upward = np.where(place[:, 2] == corners[:, 2].max(), 1.0, -1.0)
    azimuth = np.arange(len(place)) * 2.4
    tilt = np.tan(np.radians(np.resize((45.0, 60.0, 75.0), len(place))))
    way = np.column_stack((tilt * np.cos(azimuth), tilt * np.sin(azimuth), upward))
    # From inside the plate: those that would start beyond its rim go the other way.
    start = place - 0.5 * spec.thickness_mm * way
    outside = (np.abs(start[:, 0]) > width / 2) | (np.abs(start[:, 1]) > height / 2)
    way[outside, :2] *= -1.0
    start = place - 0.5 * spec.thickness_mm * way
    way /= np.linalg.norm(way, axis=1)[:, None]
    inside = (np.abs(start[:, 0]) < width / 2) & (np.abs(start[:, 1]) < height / 2)
    return start[inside], way[inside]


@pytest.mark.render
def test_no_light_leaves_a_guide_where_faces_and_rim_meet() -> None:
    """Beyond the critical angle all light ends on the black rim, wherever it is reflected."""
    spec, patches = guide()
    with ray_scene(1024) as scene:
        spectral = spectral_scene(by_significance(), (), 532.0)
        item = add_guide(scene.scene.collection, spec, patches, spectral)
        rays = rays_in(item, spec)
        leaked = np.abs(scene.rays(*rays)).max(axis=1)
    assert len(leaked) > 500
    np.testing.assert_array_equal(leaked, 0.0)
