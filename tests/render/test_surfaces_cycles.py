# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms on curved surfaces and meshes in Cycles, ray by ray against numpy."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from numpy.typing import NDArray

from hoe_addon.blender.build.element import ERROR_PROPERTY, hologram_element
from hoe_addon.blender.build.meshes import NORMAL_ATTRIBUTE
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.blender.shaders import materials, nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.blender.shaders.spectral import spectral_scene
from hoe_addon.core.ray_law import Status
from hoe_addon.core.shapes import Conic, MeshShape
from hoe_addon.core.shapes.refine import refined
from hoe_addon.core.shapes.tessellate import rectangle_mesh
from hoe_addon.core.units import m_to_mm, mm_to_m
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.document import hologram_from
from hoe_addon.model.element import element_mesh, element_shape
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable
from hoe_addon.shading.probe import direction_world_shader, ray_camera_shader
from hoe_addon.shading.source import ShaderSource

pytestmark = pytest.mark.render

DIRECTION = 2e-6
"""rad; as for planes in test_trace_cycles: a curved hit is solved from its facet in float32."""

GRAZING = 3e-7
"""rad times cos, as for planes."""

LIMIT_BAND = 2e-6
"""Half width, in (n' cos')^2, of the band where float32 cannot tell the side of evanescence."""

EFFICIENCY = 1.1e-5
HIT_MM = 3e-5
"""float32 at 50 mm is good to 4e-6 mm; a slanting hit adds the cosine."""

PLACED = 2.0
"""Twice as much is allowed where the object is turned, for the float32 matrix."""

PACKED = 100.0
"""Cycles packs normals into 32 bits: 3e-5 rad, which a reflection doubles and glass refracts."""

SURFACES: dict[str, dict[str, Any]] = {
    "round plane": {"shape": "plane", "size_mm": [56, 56], "outline": "ellipse"},
    "sphere": {"shape": "sphere", "size_mm": [40, 40], "radius_mm": 50},
    "sphere the other way": {"shape": "sphere", "size_mm": [40, 40], "radius_mm": -32},
    "nearly flat sphere": {"shape": "sphere", "size_mm": [40, 40], "radius_mm": 1e9},
    "conic": {"shape": "conic", "size_mm": [40, 40], "radius_mm": 40, "conic": -1.2},
    "cylinder": {"shape": "cylinder", "size_mm": [40, 40], "radius_mm": -60, "axis": "x"},
    "asphere": {
        "shape": "asphere",
        "size_mm": [40, 40],
        "radius_mm": 60,
        "conic": -0.5,
        "coefficients": [1e-6, 1e-10],
    },
    "round asphere": {
        "shape": "asphere",
        "size_mm": [56, 56],
        "radius_mm": 70,
        "outline": "ellipse",
    },
}
CROSSINGS = ShaderSource(
    "hoe_test_crossings",
    "shader hoe_test_crossings(output closure color result = 0)"
    ' { int n = 0; getattribute("path:transparent_depth", n); result = n * emission(); }',
)


def hologram(surface: dict[str, Any], **changes: Any) -> HologramSpec:
    document = {
        "schema": 1,
        "name": "curved",
        "surface": surface,
        "media": {"back": 1.0, "front": "N-BK7"},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "point", "position_mm": [10, 5, -100]},
            "reference": {"kind": "plane", "direction": [0.1, 0, 1]},
        },
        "efficiency": {
            "model": "constant",
            "table": {"T": {"0": 0.4, "1": 0.3, "-1": 0.1}, "R": {"1": 0.1}},
        },
        "orders": [-1, 0, 1],
    }
    return hologram_from(document | changes)


def sphere_mesh(cells: int, radius_mm: float = 50.0, **changes: Any) -> dict[str, Any]:
    mesh = rectangle_mesh(Conic(radius_mm), 40.0, 40.0, cells, cells)
    return {
        "shape": "mesh",
        "vertices_mm": mesh.vertices.tolist(),
        "faces": mesh.faces.tolist(),
        "normals": mesh.normals.tolist(),
    } | changes


def random_rays(
    spec: HologramSpec,
    rng: np.random.Generator,
    count: int,
    *,
    least_cos: float = 0.05,
    half: float = 19.0,
) -> RayTable:
    """Rays to random points of the surface, from both sides, steep and grazing."""
    shape = element_shape(spec)
    x, y = mm_to_m(rng.uniform(-half, half, (2, count)))
    points = np.stack((x, y, shape.sag(x, y)), axis=1)
    normal = shape.normal(points)
    aside = np.cross(normal, rng.normal(size=(count, 3)))
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    cos = rng.uniform(least_cos, 1.0, (count, 1)) * rng.choice([-1.0, 1.0], (count, 1))
    direction = cos * normal + np.sqrt(1.0 - cos**2) * aside
    origin = m_to_mm(points) - direction * rng.uniform(0.5, 5.0, (count, 1))
    return RayTable(
        origin,
        direction,
        rng.uniform(380.0, 780.0, count),
        rng.choice([-1, 1], count),
        rng.random(count) < 0.5,
    )


def compare(spec: HologramSpec, rays: RayTable) -> None:
    cycles, exact = trace_cycles(spec, rays), trace(spec, rays)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.5
    normal = element_shape(spec).normal(mm_to_m(exact.hit_mm))
    cos = np.abs(np.sum(exact.direction * normal, axis=1))
    angle = np.linalg.norm(cycles.direction - exact.direction, axis=1)
    allowed = np.maximum(DIRECTION, GRAZING / cos)
    assert np.all(angle[both] <= allowed[both]), np.max(angle[both] / allowed[both])
    differ = cycles.status != exact.status
    assert np.all(np.where(exact.status == Status.OK, cos**2, 0.0)[differ] < LIMIT_BAND)
    assert differ.sum() <= 2
    assert np.max(np.abs(cycles.efficiency[both] - exact.efficiency[both])) < EFFICIENCY
    assert np.nanmax(np.abs(cycles.hit_mm - exact.hit_mm)) < HIT_MM


@pytest.mark.parametrize("name", SURFACES)
def test_formula_surfaces(name: str, rng: np.random.Generator) -> None:
    spec = hologram(SURFACES[name])
    compare(spec, random_rays(spec, rng, 1000))


@pytest.mark.slow
def test_mesh_with_given_normals(rng: np.random.Generator) -> None:
    """Cycles and numpy have the same facets: they agree to float32, not only to 1e-4."""
    spec = hologram(sphere_mesh(24))
    compare(spec, random_rays(spec, rng, 1000))


@pytest.mark.slow
def test_mesh_of_a_sphere_is_as_good_as_it_says(rng: np.random.Generator) -> None:
    """Cycles on the refined mesh against the sphere itself, for incidence up to 45 degrees."""
    sphere = hologram(SURFACES["sphere"])
    rays = random_rays(sphere, rng, 500, least_cos=np.sqrt(0.5))
    exact = trace(sphere, rays)
    normal = element_shape(sphere).normal(mm_to_m(exact.hit_mm))
    steep = np.abs(np.sum(exact.direction * normal, axis=1)) > np.sqrt(0.5)
    errors, stated = [], []
    for refine in (False, True):
        mesh = hologram(sphere_mesh(24, refine=refine))
        found = trace_cycles(mesh, rays)
        both = steep & (exact.status == Status.OK) & (found.status == Status.OK)
        assert both.sum() > 100
        errors.append(np.linalg.norm(exact.direction - found.direction, axis=1)[both].max())
        stated.append(element_mesh(mesh).direction_error)
    assert errors[0] < stated[0]
    assert errors[1] < stated[1] < 1e-4
    assert errors[0] > 3.0 * errors[1]


def test_windshield_file(rng: np.random.Generator, tmp_path: Path) -> None:
    """A leaning, doubly curved sheet from an .obj file that has no normals."""
    along = np.linspace(-60.0, 60.0, 33)
    x, y = (axis.ravel() for axis in np.meshgrid(along, 0.6 * along))
    z = 0.5 * y + x**2 / 700.0 + y**2 / 900.0
    lines = [f"v {a!r} {b!r} {c!r}" for a, b, c in np.stack((x, y, z), axis=1).tolist()]
    number = np.arange(1, 33 * 33 + 1).reshape(33, 33)
    for a, b, c, d in zip(
        *(p.ravel() for p in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])),
        strict=True,
    ):
        lines.append(f"f {a} {b} {c} {d}")
    path = tmp_path / "shield.obj"
    path.write_text("\n".join(lines))
    spec = hologram({"shape": "mesh", "file": str(path)})
    compare(spec, random_rays(spec, rng, 600, half=30.0))


def test_start_on_the_surface_behind_it_and_beside_it() -> None:
    spec = hologram(SURFACES["sphere"])
    sag = m_to_mm(float(element_shape(spec).sag(0.012, 0.0)))
    origin = np.array([[12.0, 0, sag - 1e-6], [12, 0, sag + 1.0], [12, 0, sag - 1e4], [25, 0, -1]])
    direction = np.tile((0.0, 0.0, 1.0), (4, 1))
    zeros = np.zeros(4, dtype=np.int64)
    rays = RayTable(origin, direction, np.full(4, 532.0), zeros, zeros == 1)
    cycles, exact = trace_cycles(spec, rays), trace(spec, rays)
    assert exact.status.tolist() == [0, Status.MISS, 0, Status.MISS]
    assert cycles.status.tolist() == exact.status.tolist()
    np.testing.assert_allclose(cycles.hit_mm, exact.hit_mm, atol=HIT_MM)


class Room:
    """One element in a scene of its own, and a camera that is a list of rays."""

    def __init__(self, scene: bpy.types.Scene, spec: HologramSpec, matrix: Matrix) -> None:
        self.scene = scene
        spectral = spectral_scene(by_significance(), (), 532.0)
        material = materials.hologram_material(spec, spectral)
        self.element = hologram_element(scene.collection, spec, material)
        self.element.matrix_world = matrix
        camera = bpy.data.cameras.new("Rays")
        camera.type = "CUSTOM"
        camera.custom_mode = "INTERNAL"
        camera.clip_start = 1e-6
        scene.camera = bpy.data.objects.new("Rays", camera)
        scene.collection.objects.link(scene.camera)
        self.world = bpy.data.worlds.new("World")
        self.world.cycles.sampling_method = "NONE"
        scene.world = self.world

    def answers(self, world: ShaderSource, origin: Any, direction: Any) -> NDArray[np.float64]:
        """What the world's shader says to each ray that leaves, shape (rays, 3)."""
        tree = nodes.new_tree(self.world)
        output = tree.nodes.new("ShaderNodeOutputWorld")
        node = nodes.add_script_node(tree, world, {})
        tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
        flip = np.array((1.0, 1.0, -1.0))
        source = ray_camera_shader((origin * flip)[::-1], (direction * flip)[::-1])
        self.scene.camera.data.custom_bytecode = compiled(source)
        self.scene.camera.data.custom_bytecode_hash = source.digest
        set_up(self.scene, samples=1, seed=0, spectral=False, max_bounces=64)
        self.scene.cycles.pixel_filter_type = "BOX"
        self.scene.render.resolution_x, self.scene.render.resolution_y = 1, len(origin)
        return render_layers(self.scene, (COMBINED,))[COMBINED][:, 0, :].astype(np.float64)


TURNED = Matrix.Translation((5.0, -3.0, 8.0)) @ Matrix.Rotation(0.7, 4, (0.3, 0.5, 0.8))
PLACES = {
    "turned": TURNED,
    "mirrored": TURNED @ Matrix.Diagonal((-1.0, 1.0, 1.0, 1.0)),
    "twice as large": TURNED @ Matrix.Scale(2.0, 4),
}


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("kind", ["plane", "sphere", "mesh", "mesh without exact normals"])
def test_the_object_may_be_moved_turned_mirrored_and_scaled(
    place: str, kind: str, clean_scene: Any, rng: np.random.Generator
) -> None:
    """Its recording goes with it: rays in its own frame are those of the document."""
    surface = {
        "plane": {"shape": "plane", "size_mm": [40, 40]},
        "sphere": SURFACES["sphere"],
        "mesh": sphere_mesh(24),
        "mesh without exact normals": sphere_mesh(24),
    }[kind]
    shares = {"model": "constant", "table": {"T": {"1": 1.0}}}
    spec = hologram(surface, efficiency=shares, orders=[1])
    rays = random_rays(spec, rng, 200, least_cos=0.6, half=15.0)
    wave = np.full(200, 532.0)
    ones = np.ones(200, dtype=np.int64)
    exact = trace(spec, RayTable(rays.origin_mm, rays.direction, wave, ones, ones == 0))
    matrix = np.array(PLACES[place])
    origin = rays.origin_mm @ matrix[:3, :3].T + matrix[:3, 3]
    turn = matrix[:3, :3] / np.cbrt(abs(np.linalg.det(matrix[:3, :3])))
    room = Room(clean_scene, spec, PLACES[place])
    allowed = PLACED
    if kind == "mesh without exact normals":
        data = room.element.data
        data.attributes.remove(data.attributes[NORMAL_ATTRIBUTE])
        allowed = PACKED
    found = room.answers(direction_world_shader(), origin, rays.direction @ turn.T)
    expected = exact.direction @ turn.T
    chosen = (exact.status == Status.OK) & once(spec, exact.hit_mm, exact.direction)
    assert chosen.mean() > 0.6
    normal = element_shape(spec).normal(mm_to_m(exact.hit_mm))
    cos = np.abs(np.sum(exact.direction * normal, axis=1))[chosen]
    angle = np.linalg.norm(found[chosen] - expected[chosen], axis=1)
    assert np.all(angle <= allowed * np.maximum(DIRECTION, GRAZING / cos))


def once(
    spec: HologramSpec, hit_mm: NDArray[np.float64], direction: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Which rays do not meet the element a second time."""
    onward = element_shape(spec).intersect(mm_to_m(hit_mm + 0.05 * direction), direction)
    return np.isnan(onward)


@pytest.mark.parametrize("cells", [8, 40])
def test_rays_near_grazing_neither_leak_nor_get_stuck(
    cells: int, clean_scene: Any, rng: np.random.Generator
) -> None:
    """In order 0 between equal media each ray crosses the facets as often as a straight line.

    The bowl is deep and its facets coarse: many rays come in, or leave, within the angle between
    a facet and the smooth normal, where one says front and the other back.
    """
    surface = sphere_mesh(cells, 29.0, refine=False)
    efficiency = {"model": "constant", "table": {"T": {"0": 1.0}}}
    spec = hologram(surface, efficiency=efficiency, orders=[0], media={"back": 1.0, "front": 1.0})
    rays = random_rays(spec, rng, 1500, least_cos=1e-3)
    direction = rays.direction
    room = Room(clean_scene, spec, Matrix.Identity(4))
    found = room.answers(CROSSINGS, rays.origin_mm, direction)[:, 0]
    assert found.max() < 6, "a ray that is stuck crosses again and again"
    assert np.all(found >= 1.0)
    expected, steep = crossings(spec, rays.origin_mm, direction)
    assert np.all(found[steep] == expected[steep])
    assert steep.mean() > 0.3
    assert np.count_nonzero(~steep) > 10
    leaving = room.answers(direction_world_shader(), rays.origin_mm, direction)
    assert np.abs(np.linalg.norm(leaving, axis=1) - 1.0).max() < 1e-5
    assert np.abs(leaving - direction)[steep].max() < DIRECTION


def ball(parts: int) -> dict[str, Any]:
    """A closed sphere of 20 mm, from the faces of an octahedron, with its exact normals."""
    points = np.concatenate((np.eye(3), -np.eye(3)))
    faces = [(a, b, c) for a in (0, 3) for b in (1, 4) for c in (2, 5)]
    faces = [f if (sum(v > 2 for v in f) % 2 == 0) else (f[0], f[2], f[1]) for f in faces]
    fine = refined(MeshShape(points, np.array(faces), points), parts)
    normals = fine.vertices / np.linalg.norm(fine.vertices, axis=1, keepdims=True)
    return {
        "shape": "mesh",
        "vertices_mm": (20.0 * normals).tolist(),
        "faces": fine.faces.tolist(),
        "normals": normals.tolist(),
        "refine": False,
    }


@pytest.mark.parametrize("parts", [3, 12])
@pytest.mark.parametrize("side", ["T", "R"])
def test_a_closed_body_has_an_inside_and_an_outside(
    parts: int, side: str, clean_scene: Any, rng: np.random.Generator
) -> None:
    """All rays, the most grazing too, go in and out of it, or are reflected once, by its facets."""
    spec = hologram(
        ball(parts),
        efficiency={"model": "constant", "table": {side: {"0": 1.0}}},
        orders=[0],
        media={"back": 1.0, "front": 1.0},
        recording={
            "wavelength_nm": 532,
            "object": {"kind": "plane", "direction": [0, 0, 1]},
            "reference": {"kind": "plane", "direction": [0, 0, 1]},
        },
    )
    direction = unit(rng.normal(size=(1500, 3)))
    aside = unit(np.cross(direction, rng.normal(size=(1500, 3))))
    # Half of the rays pass within two percent of the rim, where facets and normals disagree.
    offset = 20.0 * np.where(rng.random((1500, 1)) < 0.5, rng.uniform(0.97, 1.0, (1500, 1)), 0.6)
    origin = offset * aside - 60.0 * direction
    room = Room(clean_scene, spec, Matrix.Identity(4))
    found = room.answers(CROSSINGS, origin, direction)[:, 0]
    hits = np.isfinite(element_mesh(spec).mesh.intersect(mm_to_m(origin), direction))
    assert 0.5 < hits.mean() < 1.0
    assert np.all(found[~hits] == 0.0)
    assert np.all(found[hits] == (2.0 if side == "T" else 1.0))


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def crossings(
    spec: HologramSpec, origin_mm: NDArray[np.float64], direction: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """How often straight rays cross the facets, and which do so clear of the smooth tangent."""
    mesh = element_mesh(spec).mesh
    count = np.zeros(len(origin_mm), dtype=np.int64)
    steep = np.ones(len(origin_mm), dtype=bool)
    start, going = mm_to_m(origin_mm), np.ones(len(origin_mm), dtype=bool)
    while going.any():
        hit = mesh.hit(start, direction)
        going &= np.isfinite(hit.distance)
        place = start + np.nan_to_num(hit.distance)[:, None] * direction
        corner = mesh.vertices[mesh.faces[hit.triangle]]
        facet = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        facet /= np.linalg.norm(facet, axis=1, keepdims=True)
        cos = np.sum(direction * facet, axis=1)
        smooth = np.sum(direction * mesh.normal(place), axis=1)
        clear = (cos * smooth > 0.0) & (np.abs(cos) > 1e-3)
        steep &= ~going | clear
        count += going
        start = place + 1e-7 * direction
    return count, steep


@pytest.mark.parametrize("name", ["sphere the other way", "cylinder", "asphere"])
def test_a_white_world_stays_white(name: str, clean_scene: Any) -> None:
    """All light in order 0 between equal media: every pixel is 1, also along the facets' edges."""
    efficiency = {"model": "constant", "table": {"T": {"0": 1.0}}}
    spec = hologram(
        SURFACES[name], efficiency=efficiency, orders=[0], media={"back": 1.0, "front": 1.0}
    )
    room = Room(clean_scene, spec, Matrix.Rotation(1.35, 4, "X"))
    assert 0.0 < room.element[ERROR_PROPERTY] <= 1e-4
    camera = bpy.data.cameras.new("View")
    camera.lens = 60.0
    room.scene.camera = bpy.data.objects.new("View", camera)
    room.scene.collection.objects.link(room.scene.camera)
    room.scene.camera.location = (0.0, 0.0, 70.0)
    background = nodes.new_tree(room.world)
    output = background.nodes.new("ShaderNodeOutputWorld")
    light = background.nodes.new("ShaderNodeBackground")
    light.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    background.links.new(light.outputs[0], output.inputs["Surface"])
    set_up(room.scene, samples=4, seed=1, spectral=False, max_bounces=64)
    room.scene.render.resolution_x = room.scene.render.resolution_y = 96
    picture = render_layers(room.scene, (COMBINED,))[COMBINED]
    np.testing.assert_allclose(picture, 1.0, atol=1e-5)
