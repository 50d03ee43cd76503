# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""No light is made or lost by our surfaces, and pictures repeat."""

import math
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Euler
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import materials, nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.blender.shaders.spectral import SpectralScene, spectral_scene
from hoe_addon.core.efficiency import meet
from hoe_addon.core.fresnel import reflectance_unpolarised
from hoe_addon.core.media import by_name
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import nm_to_m
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import efficiencies, fan, incident_direction
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.medium import medium_from
from hoe_addon.shading.probe import direction_world_shader, position_shader, ray_camera_shader
from hoe_addon.shading.source import ShaderSource

pytestmark = pytest.mark.render

FLOAT32 = 2e-6
"""Some 30 roundings of float32, for sums of weights near 1."""

DROPPED = 1e-5
"""Cycles leaves out a closure whose weight is below this."""

SHARE = 1.1e-5
"""Error of one efficiency in float32, as in test_trace_cycles; a sum has one for each order."""

SIGMAS = 3.0
GUIDED_ENERGY = 1e-4
GUIDED_DIRECTION = 1e-4
ONCE = 2e-6
"""rad; a second diffraction would turn the ray by tenths of a radian."""

GLASS = 1.8

UPPER_HALF = ShaderSource(
    "hoe_test_half",
    "shader hoe_test_half(output closure color result = 0)"
    " { result = (I[2] < 0.0 ? 1.0 : 0.0) * emission(); }",
)
CROSSINGS = ShaderSource(
    "hoe_test_crossings",
    "shader hoe_test_crossings(output closure color result = 0)"
    ' { int n = 0; getattribute("path:transparent_depth", n); result = n * emission(); }',
)


class Bench:
    """A camera that is a list of rays, one a row, around whatever stands in the scene."""

    def __init__(self, scene: bpy.types.Scene, wavelength_nm: float = 550.0) -> None:
        self.scene = scene
        self.spectral: SpectralScene = spectral_scene(by_significance(), (), wavelength_nm)
        camera = bpy.data.cameras.new("Rays")
        camera.type = "CUSTOM"
        camera.custom_mode = "INTERNAL"
        camera.clip_start = 1e-6
        scene.camera = bpy.data.objects.new("Rays", camera)
        scene.collection.objects.link(scene.camera)
        self.white_world()

    def wavelength(self, wavelength_nm: float) -> None:
        node = next(n for n in self.spectral.group.nodes if n.bl_idname == "ShaderNodeScript")
        nodes.set_values(node, {"preview_wavelength_nm": wavelength_nm})

    def white_world(self) -> None:
        tree = self._world_tree()
        background = tree.nodes.new("ShaderNodeBackground")
        background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        tree.links.new(background.outputs[0], tree.nodes["World Output"].inputs["Surface"])

    def shader_world(self, source: ShaderSource) -> None:
        tree = self._world_tree()
        node = nodes.add_script_node(tree, source, {})
        answer = nodes.output_socket(node, "result")
        tree.links.new(answer, tree.nodes["World Output"].inputs["Surface"])

    def rays(self, origin: Any, direction: Any) -> None:
        """Take these rays, in the scene's frame, the first one in the top row."""
        start, way = np.broadcast_arrays(np.asarray(origin, float), np.asarray(direction, float))
        flip = np.array((1.0, 1.0, -1.0))
        source = ray_camera_shader((start * flip)[::-1], (way * flip)[::-1])
        self.scene.camera.data.custom_bytecode = compiled(source)
        self.scene.camera.data.custom_bytecode_hash = source.digest
        self.scene.render.resolution_y = len(start)

    def render(
        self, *, width: int = 1, samples: int = 1, seed: int = 0, spectral: bool = False
    ) -> NDArray[np.float64]:
        """One row of pixels for each ray."""
        set_up(self.scene, samples=samples, seed=seed, spectral=spectral, max_bounces=1024)
        self.scene.cycles.pixel_filter_type = "BOX"
        self.scene.render.resolution_x = width
        return render_layers(self.scene, (COMBINED,))[COMBINED].astype(np.float64)

    def add(
        self, mesh: bpy.types.Mesh, material: bpy.types.Material, **place: Any
    ) -> bpy.types.Object:
        return meshes.add(self.scene.collection, mesh, material, **place)

    def glass(self) -> bpy.types.Material:
        return materials.dielectric_material("Glass", GLASS, 1.0, self.spectral)

    def _world_tree(self) -> bpy.types.NodeTree:
        world = bpy.data.worlds.new("World")
        world.cycles.sampling_method = "NONE"
        self.scene.world = world
        tree = nodes.new_tree(world)
        tree.nodes.new("ShaderNodeOutputWorld").name = "World Output"
        return tree


def hologram(efficiency: dict[str, Any], orders: Sequence[int], **changes: Any) -> HologramSpec:
    document = {
        "schema": 1,
        "name": "grating",
        "surface": {"shape": "plane", "size_mm": [40, 40]},
        "media": {"back": 1.0, "front": "N-BK7"},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "plane", "direction": [0.5, 0.1, 0.86]},
            "reference": {"kind": "plane", "direction": [0, 0, 1]},
        },
        "efficiency": efficiency,
        "orders": list(orders),
    }
    return hologram_from(document | changes)


CONSTANT = {
    "model": "constant",
    "table": {
        "T": {"0": 0.3, "1": 0.25, "-1": 0.1, "2": 0.05},
        "R": {"0": 0.05, "1": 0.1, "-2": 0.02},
    },
}
FULL = {
    "model": "constant",
    "table": {"T": {"0": 0.5, "1": 0.25}, "R": {"-1": 0.25}},
    "total_internal_reflection": True,
}
KINOFORM = {"model": "kinoform", "levels": 8, "design_wavelength_nm": 532, "relief": "PMMA"}
CASES = {
    "constant": (CONSTANT, range(-2, 3)),
    "all light": (FULL, range(-1, 2)),
    "kinoform": (KINOFORM, range(-4, 5)),
    "continuous": (KINOFORM | {"levels": 0}, range(-2, 4)),
    "the same depth for all": (KINOFORM | {"angle_dependent": False}, range(-4, 5)),
}


def fan_of_rays(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Directions onto both sides, straight and almost grazing among them."""
    cos = np.concatenate(([1.0, -1.0, 1e-3, -1e-3], rng.uniform(-1.0, 1.0, count - 4)))
    phi = rng.uniform(0.0, 2.0 * np.pi, count)
    sin = np.sqrt(1.0 - cos**2)
    return np.stack((sin * np.cos(phi), sin * np.sin(phi), cos), axis=1)


def clear_of_limits(
    spec: HologramSpec, direction: NDArray[np.float64], wavelength_nm: float
) -> NDArray[np.bool_]:
    """Rays with no order so near to evanescence that float32 could take it for the other."""
    changes = [
        efficiencies(spec, direction, wavelength_nm * factor, spec.orders) > 0.0
        for factor in (1.0 - 1e-4, 1.0 + 1e-4)
    ]
    return np.all(changes[0] == changes[1], axis=(-2, -1))


def branch_sum(
    spec: HologramSpec, direction: NDArray[np.float64], wavelength_nm: float
) -> NDArray[np.float64]:
    """Sum of what a walk against the light gets back; the shader keeps it at 1 at most.

    Each order counts with the share of the light that takes it into the reverse of the walked ray.
    """
    listed = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    out = fan(spec, (0.0, 0.0, 0.0), direction, wavelength_nm, listed)
    up, wavelength = (0.0, 0.0, 1.0), nm_to_m(wavelength_nm)
    media = [medium_from(side).index(wavelength) for side in (spec.media.back, spec.media.front)]
    pattern = pattern_from(spec.pattern)
    light = meet(pattern, np.zeros(3), None, up, direction, wavelength, (media[0], media[1]))[1]
    model, total = spec.efficiency.model(), np.zeros(len(direction))
    for column, way in enumerate(listed):
        back = light.reversed(way.steps, reflected=way.reflected)
        share = model.shares((way,), back)[:, 0]
        total += np.where(out.status[:, column] == Status.OK, share, 0.0)
    if spec.efficiency.total_internal_reflection:
        # A bare reflection is its own reverse.
        total += out.weights[:, len(listed) :].sum(axis=1)
    return np.minimum(total, 1.0)


@pytest.mark.parametrize("case", CASES)
def test_hologram_returns_the_sum_of_its_efficiencies(
    clean_scene: Any, rng: np.random.Generator, case: str
) -> None:
    """In a white world every order brings back its efficiency, so no sample has noise."""
    efficiency, orders = CASES[case]
    spec = hologram(efficiency, orders)
    bench = Bench(clean_scene)
    material = materials.hologram_material(spec, bench.spectral)
    bench.add(meshes.rectangle("Element", *spec.surface.size_mm), material)
    direction = fan_of_rays(rng, 400)
    bench.rays(-5.0 * direction, direction)
    for wavelength_nm in (405.0, 532.0, 650.0):
        bench.wavelength(wavelength_nm)
        pixels = bench.render(samples=4)[:, 0, :]
        expected = branch_sum(spec, direction, wavelength_nm)
        assert np.all(pixels <= 1.0 + FLOAT32)
        assert np.all(pixels >= 0.0)
        clear = clear_of_limits(spec, direction, wavelength_nm)
        assert clear.mean() > 0.95
        allowed = len(orders) * max(SHARE, DROPPED)
        assert np.max(np.abs(pixels[clear] - expected[clear, None])) < allowed
        if efficiency is not FULL and not getattr(spec.efficiency, "angle_dependent", False):
            # These models are reciprocal.
            shares = efficiencies(spec, direction, wavelength_nm, spec.orders)
            assert np.allclose(shares.sum(axis=(-2, -1)), expected, atol=1e-12)


def test_hologram_is_finite_in_a_spectral_picture(
    clean_scene: Any, rng: np.random.Generator
) -> None:
    """Every wavelength, many samples: finite and never above 1 (render_layers refuses NaN)."""
    spec = hologram(KINOFORM, range(-4, 5))
    bench = Bench(clean_scene)
    material = materials.hologram_material(spec, bench.spectral)
    bench.add(meshes.rectangle("Element", *spec.surface.size_mm), material)
    direction = fan_of_rays(rng, 200)
    bench.rays(-5.0 * direction, direction)
    pixels = bench.render(width=8, samples=16, spectral=True)
    assert np.all(np.isfinite(pixels))
    assert np.all(pixels <= 1.0 + FLOAT32)


def test_lossless_box_returns_everything(clean_scene: Any, rng: np.random.Generator) -> None:
    """Rays from outside onto a closed body: all of them come out again."""
    bench = Bench(clean_scene)
    bench.add(box("Slab", 20.0, 20.0, 0.5), bench.glass())
    direction = fan_of_rays(rng, 200)
    direction = direction[np.abs(direction[:, 2]) > 0.05]
    origin = np.concatenate((rng.uniform(-5, 5, (len(direction), 2)), [[0.0]] * len(direction)), 1)
    bench.rays(origin - 15.0 * direction, direction)
    pixels = bench.render(width=8, samples=16)
    assert np.max(np.abs(pixels - 1.0)) < FLOAT32


def test_plate_returns_everything_beyond_the_critical_angle(
    clean_scene: Any, rng: np.random.Generator
) -> None:
    """Rays that start inside, guided or not, leave through the faces or the open rim."""
    bench = Bench(clean_scene)
    add_plate(bench, 20.0, 0.5)
    direction = fan_of_rays(rng, 200)
    direction = direction[(np.abs(direction[:, 2]) < 0.95) & (np.abs(direction[:, 2]) > 0.01)]
    assert np.mean(np.abs(direction[:, 2]) < math.sqrt(1.0 - GLASS**-2)) > 0.5
    bench.rays((0.0, 0.0, 0.1), direction)
    pixels = bench.render(width=8, samples=16)
    assert np.max(np.abs(pixels - 1.0)) < FLOAT32


def test_fresnel_reflectance_of_one_face(clean_scene: Any) -> None:
    """Reflected light goes to the bright half of the world, refracted light to the dark half."""
    medium = by_name("N-BK7")
    bench = Bench(clean_scene)
    material = materials.dielectric_material("Face", "N-BK7", 1.0, bench.spectral)
    bench.add(meshes.rectangle("Face", 40.0, 40.0), material)
    outside = np.array([0.0, 20.0, 45.0, 56.6, 70.0, 80.0, 88.0])
    inside = np.array([0.0, 15.0, 30.0, 38.0, 40.0, 45.0, 80.0])
    width, samples = 64, 256
    for from_inside, angles in ((False, outside), (True, inside)):
        # The bright half is the one that the rays come from.
        bench.shader_world(UPPER_HALF if not from_inside else lower_half())
        direction = incident_direction(angles, 30.0, from_front=not from_inside)
        bench.rays(-5.0 * direction, direction)
        for wavelength_nm in (420.0, 532.0, 650.0):
            bench.wavelength(wavelength_nm)
            pixels = bench.render(width=width, samples=samples)[..., 0]
            index = float(medium.index(wavelength_nm * 1e-9))
            pair = (index, 1.0) if from_inside else (1.0, index)
            expected = reflectance_unpolarised(np.cos(np.radians(angles)), *pair)
            # A choice per sample: independent ones scatter so, Cycles' stratified ones less.
            sigma = np.sqrt(expected * (1.0 - expected) / (width * samples))
            error = np.abs(pixels.mean(axis=1) - expected)
            assert np.all(error <= SIGMAS * sigma + FLOAT32)


def test_same_seed_same_picture(clean_scene: Any) -> None:
    bench = Bench(clean_scene)
    bench.shader_world(UPPER_HALF)
    bench.add(meshes.rectangle("Face", 40.0, 40.0), bench.glass())
    direction = incident_direction(np.linspace(0.0, 80.0, 16), 0.0, from_front=True)
    bench.rays(-5.0 * direction, direction)
    first, again = (bench.render(width=16, samples=4, seed=7, spectral=True) for _ in range(2))
    other = bench.render(width=16, samples=4, seed=8, spectral=True)
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0), (123.4, -56.7, 89.0)])
@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.4, -0.7, 0.3)])
@pytest.mark.parametrize("order", [0, 1])
def test_ray_at_a_shared_edge_is_diffracted_once(
    clean_scene: Any,
    place: tuple[float, float, float],
    tilt: tuple[float, float, float],
    order: int,
) -> None:
    """Pixel centres on the diagonal of a rectangle, where its two triangles meet."""
    side = 32
    table = {"T": {str(order): 0.5}, "R": {str(order): 0.5}}
    spec = hologram({"model": "constant", "table": table}, [order], media={})
    bench = Bench(clean_scene)
    material = materials.hologram_material(spec, bench.spectral)
    element = bench.add(meshes.rectangle("Element", 8.0, 8.0), material, location=place)
    element.rotation_euler = tilt
    turn = np.array(Euler(tilt).to_matrix())
    camera = bpy.data.cameras.new("Straight")
    camera.type, camera.ortho_scale = "ORTHO", 8.0
    clean_scene.camera = bpy.data.objects.new("Straight", camera)
    clean_scene.collection.objects.link(clean_scene.camera)
    clean_scene.camera.location = np.asarray(place) + turn @ (0.0, 0.0, 10.0)
    clean_scene.camera.rotation_euler = tilt
    clean_scene.render.resolution_y = side

    pixels = bench.render(width=side)
    assert np.max(np.abs(pixels - 1.0)) < FLOAT32
    bench.wavelength(600.0)
    bench.shader_world(direction_world_shader())
    local = bench.render(width=side) @ turn
    down = np.array((0.0, 0.0, -1.0))
    ways = [Branch(order, reflected=side) for side in (False, True)]
    expected = fan(spec, (0.0, 0.0, 0.0), down, 600.0, ways).directions
    apart = np.linalg.norm(local[..., None, :] - expected, axis=-1).min(axis=-1)
    assert np.max(apart) < ONCE
    bench.shader_world(CROSSINGS)
    assert np.all(bench.render(width=side) == 1.0)
    if not any((*place, *tilt)):
        element.data.materials[0] = nodes.script_material("Position", position_shader(), {})
        hit = bench.render(width=side)
        assert np.sum(np.abs(hit[..., 0] - hit[..., 1]) < 1e-6) == side


@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.4, -0.7, 0.3)])
def test_a_hundred_internal_reflections(clean_scene: Any, tilt: tuple[float, ...]) -> None:
    """In through a hologram on a 0.3 mm plate, out through its open rim."""
    thickness, end = 0.3, 100.0
    bench = Bench(clean_scene)
    root = bpy.data.objects.new("Root", None)
    root.rotation_euler = tilt
    root.location = (3.0, 4.0, 5.0)
    clean_scene.collection.objects.link(root)
    turn = np.array(Euler(tilt).to_matrix())
    # Recorded so that straight light at 532 nm goes on at asin(0.84) = 57 degrees in the plate.
    object_wave = {"kind": "plane", "direction": [0.84, 0.0, math.sqrt(1.0 - 0.84**2)]}
    recording = {
        "wavelength_nm": 532,
        "object": object_wave | {"index": GLASS},
        "reference": {"kind": "plane", "direction": [0, 0, 1]},
    }
    full = {"model": "constant", "table": {"T": {"1": 1.0}}}
    media = {"back": 1.0, "front": GLASS}
    spec = hologram(full, [1], media=media, recording=recording)
    entrance = materials.hologram_material(spec, bench.spectral)
    # The entrance is a strip of the lower face, too short for a second hit.
    bench.add(strip("Entrance", -0.2, 0.2), entrance, parent=root)
    bench.add(strip("Lower", 0.2, end), bench.glass(), parent=root)
    lower = clean_scene.collection.objects["Lower"]
    lower.data.flip_normals()
    upper = bench.add(strip("Upper", -0.2, end), bench.glass(), parent=root)
    upper.location.z = thickness

    start = np.array(((0.0, 0.0, -1.0), (0.1, 1.0, -1.0), (-0.1, -2.0, -1.0)))
    place = np.array(root.location)
    bench.rays(start @ turn.T + place, (turn @ (0.0, 0.0, 1.0))[None, :])
    for wavelength_nm in (480.0, 532.0, 600.0):
        bench.wavelength(wavelength_nm)
        bench.white_world()
        energy = bench.render(width=4, samples=4)
        assert np.max(np.abs(energy - 1.0)) < GUIDED_ENERGY
        bench.shader_world(CROSSINGS)
        hits = bench.render()[:, 0, 0]
        bench.shader_world(direction_world_shader())
        leaving = (bench.render()[:, 0, :]) @ turn
        sine = 0.84 * wavelength_nm / 532.0
        cosine = math.sqrt(1.0 - sine**2)
        assert np.all(hits > 100)
        # After an odd number of reflections, the entrance being no reflection, it goes down.
        upward = np.where((hits - 1) % 2 == 1, -1.0, 1.0)
        expected = np.stack((0.0 * hits + sine, 0.0 * hits, upward * cosine), axis=1)
        assert np.max(np.linalg.norm(leaving - expected, axis=1)) < GUIDED_DIRECTION


def lower_half() -> ShaderSource:
    text = UPPER_HALF.text.replace("I[2] < 0.0", "I[2] > 0.0").replace("_half", "_lower")
    return ShaderSource("hoe_test_lower", text)


def box(name: str, x: float, y: float, z: float) -> bpy.types.Mesh:
    """A closed body around the origin, its normals outward."""
    corners = [(a * x / 2, b * y / 2, c * z / 2) for c in (-1, 1) for b in (-1, 1) for a in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return meshes.from_polygons(name, corners, faces)


def strip(name: str, start: float, end: float) -> bpy.types.Mesh:
    """A rectangle from start to end along x, 20 mm along y, its normal +z."""
    corners = [(start, -10.0, 0.0), (end, -10.0, 0.0), (end, 10.0, 0.0), (start, 10.0, 0.0)]
    return meshes.from_polygons(name, corners, [(0, 1, 2, 3)])


def add_plate(bench: Bench, side: float, thickness: float) -> None:
    """Two faces of one plate, their normals outward, without a rim."""
    upper = bench.add(meshes.rectangle("Upper", side, side), bench.glass())
    upper.location.z = thickness / 2.0
    lower = bench.add(meshes.rectangle("Lower", side, side), bench.glass())
    lower.location.z = -thickness / 2.0
    lower.data.flip_normals()
