# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide's mesh, the eye and its filter: geometry as the document has it."""

import json
import math
from collections import Counter
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.build.element import ERROR_PROPERTY, hologram_element, surface_of
from hoe_addon.blender.build.eye import add_eye, set_pupil
from hoe_addon.blender.build.guide import add_guide, patch_frame
from hoe_addon.blender.shaders import nodes
from hoe_addon.blender.shaders.materials import hologram_material
from hoe_addon.blender.shaders.spectral import SpectralScene, spectral_scene
from hoe_addon.core.errors import SpecError
from hoe_addon.core.spectrum import line
from hoe_addon.core.units import m_to_mm, mm_to_m
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.device_parts import EyeSpec
from hoe_addon.model.document import device_from, find_device, hologram_from, load_device
from hoe_addon.model.element import element_mesh, element_shape
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.resources import preset_paths
from hoe_addon.shading.hologram import hologram_shader

PRESET = "two_hologram_ar"
LENS = Path(__file__).parents[1] / "documents" / "lens.json"

FLOAT32 = 1e-6
"""Relative: Blender keeps coordinates and settings as float32, 6e-8, and areas are sums of them."""


def one_more_patch(**changes: Any) -> LightGuideSpec:
    """The preset with a third patch on the world's side, whose edges are nobody else's."""
    document = json.loads(preset_paths()[PRESET].read_text(encoding="utf-8"))
    patch = document["holograms"][1] | {
        "name": "world_side",
        "face": "world",
        "center_mm": [3.3, -1.7],
        "size_mm": [5.5, 7.1],
    }
    document["holograms"].append(patch | changes)
    return device_from(document)


LAYOUTS = {
    "preset": load_device(PRESET),
    "both faces": one_more_patch(),
    "edges nearly equal": one_more_patch(center_mm=[0.0, 1e-10], size_mm=[28.0, 20.0]),
    "to the rim": one_more_patch(center_mm=[6.0, 0.0], size_mm=[48.0, 24.0]),
}


@pytest.fixture
def spectral(clean_scene: bpy.types.Scene) -> SpectralScene:
    laser = [line(532e-9, 1e-9)]
    return spectral_scene(by_significance(laser, floor=0.5), laser, 532.0)


@pytest.fixture(params=LAYOUTS, ids=lambda name: name)
def plate(
    request: pytest.FixtureRequest, clean_scene: bpy.types.Scene, spectral: SpectralScene
) -> tuple[LightGuideSpec, bpy.types.Object]:
    spec = LAYOUTS[request.param]
    return spec, add_guide(clean_scene.collection, spec.guide, spec.holograms, spectral)


type Plate = tuple[LightGuideSpec, bpy.types.Object]


def corners_of(mesh: bpy.types.Mesh) -> NDArray[np.float64]:
    return np.array([tuple(vertex.co) for vertex in mesh.vertices], dtype=np.float64)


def area_by_slot(mesh: bpy.types.Mesh, z: float | None = None) -> Counter[int]:
    """Area of each material; with z, of the faces in that plane only."""
    areas: Counter[int] = Counter()
    for polygon in mesh.polygons:
        if z is None or math.isclose(polygon.center.z, z, rel_tol=FLOAT32):
            areas[polygon.material_index] += polygon.area
    return areas


def test_plate_is_watertight(plate: Plate) -> None:
    """Every edge has exactly two faces, which run along it in opposite directions."""
    mesh = plate[1].data
    ways = Counter(
        (start, end)
        for polygon in mesh.polygons
        for start, end in pairwise([*polygon.vertices, polygon.vertices[0]])
    )
    assert set(ways.values()) == {1}
    assert {(end, start) for start, end in ways} == set(ways)
    assert len(mesh.edges) == len(ways) // 2
    # One closed body without a hole: Euler's formula.
    assert len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons) == 2


def test_plate_has_no_corner_inside_an_edge(plate: Plate) -> None:
    """A T-junction would leave a slit of float32 width for a ray to slip through."""
    mesh = plate[1].data
    corners = corners_of(mesh)
    for edge in mesh.edges:
        start, end = corners[list(edge.vertices)]
        along = end - start
        length = np.linalg.norm(along)
        assert length > 1e-3
        share = (corners - start) @ along / length**2
        apart = np.linalg.norm(corners - start - share[:, None] * along, axis=1)
        inside = (share > FLOAT32) & (share < 1.0 - FLOAT32) & (apart < 1e-3)
        assert not inside.any()


def test_normals_of_the_plate_point_outward(plate: Plate) -> None:
    spec, item = plate
    mesh = item.data
    guide = spec.guide
    middle = (guide.face_z_mm("eye") + guide.face_z_mm("world")) / 2.0
    centre = np.array([*guide.center_mm, middle])
    for polygon in mesh.polygons:
        outward = np.array(polygon.center) - centre
        assert np.dot(np.array(polygon.normal), outward) > 0.0
        assert np.abs(np.array(polygon.normal)).max() == pytest.approx(1.0, abs=FLOAT32)


def test_volume_of_the_plate(plate: Plate) -> None:
    """By the divergence theorem, so that a missing or turned face would show."""
    spec, item = plate
    volume = sum(
        polygon.area * np.dot(np.array(polygon.normal), np.array(polygon.center)) / 3.0
        for polygon in item.data.polygons
    )
    width, height = spec.guide.size_mm
    assert volume == pytest.approx(width * height * spec.guide.thickness_mm, rel=1e-5)


def test_patches_have_the_area_of_the_document_on_their_face(plate: Plate) -> None:
    spec, item = plate
    guide, mesh = spec.guide, item.data
    width, height = guide.size_mm
    for face in ("eye", "world"):
        areas = area_by_slot(mesh, guide.face_z_mm(face))
        wanted = {
            2 + number: math.prod(patch.size_mm)
            for number, patch in enumerate(spec.holograms)
            if patch.face == face
        }
        bare = areas.pop(0, 0.0)
        assert areas == pytest.approx(wanted, rel=FLOAT32)
        whole = width * height
        assert bare == pytest.approx(whole - sum(wanted.values()), abs=FLOAT32 * whole)
    rim = 2.0 * (width + height) * guide.thickness_mm
    assert area_by_slot(mesh)[1] == pytest.approx(rim, rel=FLOAT32)


def test_patches_lie_where_the_document_has_them(plate: Plate) -> None:
    spec, item = plate
    corners = corners_of(item.data)
    for number, patch in enumerate(spec.holograms):
        chosen = [p for p in item.data.polygons if p.material_index == 2 + number]
        own = corners[sorted({corner for p in chosen for corner in p.vertices})]
        low, high = own[:, :2].min(axis=0), own[:, :2].max(axis=0)
        np.testing.assert_allclose((low + high) / 2.0, patch.center_mm, atol=1e-5)
        np.testing.assert_allclose(high - low, patch.size_mm, atol=1e-5)
        np.testing.assert_allclose(own[:, 2], spec.guide.face_z_mm(patch.face), rtol=FLOAT32)


def test_material_slots_are_surface_rim_and_patches(plate: Plate) -> None:
    spec, item = plate
    names = [slot.material.name for slot in item.material_slots]
    assert names == ["Guide", "Guide Rim", *(patch.name for patch in spec.holograms)]


def test_frame_of_a_patch_has_its_normal_outward() -> None:
    """On the world's side it is turned by 180 degrees about y."""
    spec = LAYOUTS["both faces"]
    for patch in spec.holograms:
        frame = patch_frame(spec.guide, patch)
        outward = 1.0 if patch.face == "eye" else -1.0
        np.testing.assert_array_equal(np.cross(frame.x, frame.y), (0.0, 0.0, outward))
        assert frame.y == (0.0, 1.0, 0.0)
        assert frame.origin == (*patch.center_mm, spec.guide.face_z_mm(patch.face))
    assert {patch.face for patch in spec.holograms} == {"eye", "world"}


@pytest.mark.parametrize(("diameter", "sides"), [(19.0, 128), (1.0, 3), (0.01, 64)])
def test_a_disk_has_the_area_of_its_circle(
    clean_scene: bpy.types.Scene, diameter: float, sides: int
) -> None:
    (polygon,) = meshes.disk("disk", diameter, sides).polygons
    assert polygon.area == pytest.approx(math.pi * diameter**2 / 4.0, rel=FLOAT32)
    assert tuple(polygon.normal) == pytest.approx((0.0, 0.0, 1.0))


CURVED = {
    "round plane": {"shape": "plane", "size_mm": [30, 20], "outline": "ellipse"},
    "sphere": {"shape": "sphere", "size_mm": [30, 20], "radius_mm": -40},
    "round conic": {
        "shape": "conic",
        "size_mm": [30, 20],
        "radius_mm": 30,
        "conic": -1,
        "outline": "ellipse",
    },
    "mesh": {
        "shape": "mesh",
        "vertices_mm": [[-15, -10, 0], [15, -10, 0], [15, 10, 0], [-15, 10, 0]],
        "faces": [[0, 1, 2], [0, 2, 3]],
        "normals": [[-0.02, 0, 1], [0.02, 0, 1], [0.02, 0, 1], [-0.02, 0, 1]],
    },
}


def curved(name: str) -> HologramSpec:
    document = json.loads(LENS.read_text(encoding="utf-8"))
    return hologram_from(document | {"surface": CURVED[name]})


@pytest.mark.parametrize("name", CURVED)
def test_an_element_lies_on_its_surface(clean_scene: bpy.types.Scene, name: str) -> None:
    """In scene units; its triangles cover the outline and face the front."""
    spec = curved(name)
    item = hologram_element(clean_scene.collection, spec, units_per_mm=0.1, location=(1, 2, 3))
    assert tuple(item.location) == (1.0, 2.0, 3.0)
    corners = corners_of(item.data) * 10.0
    shape = element_shape(spec)
    expected = m_to_mm(shape.sag(*mm_to_m(corners[:, :2].T)))
    if name != "mesh":
        np.testing.assert_allclose(corners[:, 2], expected, atol=1e-5)
    area = sum(polygon.area * polygon.normal.z for polygon in item.data.polygons) * 100.0
    whole = 600.0 * (math.pi / 4.0 if name.startswith("round") else 1.0)
    assert area == pytest.approx(whole, rel=1.2e-4)
    assert 0.0 <= item[ERROR_PROPERTY] <= 1e-4
    assert (item[ERROR_PROPERTY] == 0.0) == (name == "round plane")


def test_the_mesh_of_an_object_becomes_a_surface(clean_scene: bpy.types.Scene) -> None:
    """With its modifiers; and what has no faces is refused."""
    ball = hologram_element(clean_scene.collection, curved("sphere"), units_per_mm=0.1)
    ball.modifiers.new("Cut", "TRIANGULATE")
    surface = surface_of(ball, units_per_mm=0.1)
    exact = element_mesh(curved("sphere")).mesh
    shape = surface.core_shape()
    np.testing.assert_allclose(shape.vertices, exact.vertices, atol=1e-8)
    np.testing.assert_allclose(shape.normals, exact.normals, atol=FLOAT32)
    assert len(shape.faces) == len(exact.faces)
    bare = meshes.add(clean_scene.collection, meshes.from_polygons("bare", [(0, 0, 0)], []))
    with pytest.raises(SpecError, match="faces: must not be empty"):
        surface_of(bare)


@pytest.mark.parametrize("name", ["sphere", "mesh"])
def test_normals_of_an_element_are_there_twice(clean_scene: bpy.types.Scene, name: str) -> None:
    """As Blender's own, for all shaders, and in full precision, for the hologram's."""
    spec = curved(name)
    mesh = hologram_element(clean_scene.collection, spec).data
    exact = element_mesh(spec).mesh.normals
    own = np.array([tuple(vertex.normal) for vertex in mesh.vertices])
    stored = np.empty(exact.size, dtype=np.float32)
    mesh.attributes[meshes.NORMAL_ATTRIBUTE].data.foreach_get("vector", stored)
    np.testing.assert_allclose(stored.reshape(-1, 3), exact, atol=FLOAT32)
    np.testing.assert_allclose(own, exact, atol=FLOAT32)
    assert all(polygon.use_smooth for polygon in mesh.polygons)


def test_the_material_of_a_mesh_asks_for_its_normals(
    clean_scene: bpy.types.Scene, spectral: SpectralScene
) -> None:
    """And no longer when the surface is another one."""
    material = hologram_material(curved("mesh"), spectral)
    (feeder,) = [n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeAttribute"]
    assert feeder.attribute_name == meshes.NORMAL_ATTRIBUTE
    assert feeder.outputs["Vector"].links[0].to_socket.identifier == "attribute_hoe_normal"
    nodes.set_script(nodes.script_node(material), hologram_shader(curved("sphere")))
    kinds = {node.bl_idname for node in material.node_tree.nodes}
    assert "ShaderNodeAttribute" not in kinds


def eye(diameter: float, field: float, focus: float | None = None) -> EyeSpec:
    return EyeSpec(pupil_diameter_mm=diameter, field_deg=field, focus_mm=focus)


EYES = [
    pytest.param(eye(diameter, field), id=f"{diameter} mm, {field} degrees")
    for diameter, field in [
        *product((4.0, 0.5, 10.0), (32.0, 100.0)),
        (1e-3, 19.0),  # a pinhole
        (4.0, 0.01),  # a telescope
        (1e-4, 0.01),
        (100.0, 170.0),
    ]
]


@pytest.mark.parametrize("spec", EYES)
def test_camera_has_pupil_and_field_of_the_eye(clean_scene: bpy.types.Scene, spec: EyeSpec) -> None:
    camera = bpy.data.cameras.new("Eye")
    set_pupil(camera, spec)
    radius = camera.lens * 1e-3 / (2.0 * camera.dof.aperture_fstop)
    assert radius == pytest.approx(spec.pupil_diameter_mm / 2.0, rel=FLOAT32)
    assert camera.dof.use_dof
    assert camera.sensor_fit == "HORIZONTAL"
    field = 2.0 * math.degrees(math.atan(camera.sensor_width / 2.0 / camera.lens))
    assert field == pytest.approx(spec.field_deg, rel=FLOAT32)


def test_focus_is_infinite_unless_it_is_given(clean_scene: bpy.types.Scene) -> None:
    camera = bpy.data.cameras.new("Eye")
    set_pupil(camera, eye(4.0, 32.0, 500.0))
    assert camera.dof.focus_distance == 500.0
    set_pupil(camera, eye(4.0, 32.0))
    # The blur that is left is one pupil over this distance: far below any pixel.
    assert 4.0 / camera.dof.focus_distance < math.radians(1.0 / 3600.0)
    assert camera.clip_end >= camera.dof.focus_distance


@pytest.mark.parametrize("field", [5.0, 32.0, 60.0, 100.0])
@pytest.mark.parametrize("diameter", [0.01, 4.0, 10.0])
@pytest.mark.parametrize("focus", [None, 250.0])
def test_filter_covers_the_view_from_every_corner_of_the_pupil(
    clean_scene: bpy.types.Scene,
    spectral: SpectralScene,
    field: float,
    diameter: float,
    focus: float | None,
) -> None:
    """For pictures up to twice as high as they are wide."""
    spec = eye(diameter, field, focus)
    camera = add_eye(clean_scene.collection, spec, spectral)
    (screen,) = camera.children
    tallest = 2.0
    slope = math.tan(math.radians(field) / 2.0) * np.array([1.0, tallest])
    distance = -screen.location.z
    assert distance > camera.data.clip_start
    extent = np.abs(corners_of(screen.data)[:, :2]).min(axis=0)
    far = camera.data.dof.focus_distance
    for pupil in product((-1, 0, 1), repeat=2):
        for corner in product((-1, 1), repeat=2):
            start = np.array(pupil) * diameter / 2.0
            aim = np.array(corner) * slope * far
            there = start + (aim - start) * distance / far
            assert np.all(np.abs(there) <= extent)


def test_filter_is_seen_by_camera_rays_only(
    clean_scene: bpy.types.Scene, spectral: SpectralScene
) -> None:
    camera = add_eye(clean_scene.collection, eye(4.0, 32.0), spectral)
    (screen,) = camera.children
    assert screen.visible_camera
    kinds = ("diffuse", "glossy", "transmission", "shadow", "volume_scatter")
    assert not any(getattr(screen, f"visible_{kind}") for kind in kinds)
    assert not screen.hide_render


def test_device_stands_upright_and_the_eye_looks_along_y(clean_scene: bpy.types.Scene) -> None:
    spec = load_device(PRESET, ["eye.position_mm=[3, 2, 1]", "room.kind=none"])
    device = build_device(clean_scene, spec, find_device(PRESET).parent)
    bpy.context.view_layer.update()
    world = np.array(device.eye.matrix_world)
    np.testing.assert_allclose(world[:3, 3], (3.0, -1.0, 2.0), atol=1e-5)
    np.testing.assert_allclose(-world[:3, 2], (0.0, 1.0, 0.0), atol=FLOAT32)
    np.testing.assert_allclose(world[:3, 1], (0.0, 0.0, 1.0), atol=FLOAT32)
    # The front of the display faces the guide, from one focal length behind the lens.
    panel = np.array(device.panel.matrix_world)
    (polygon,) = device.panel.data.polygons
    np.testing.assert_allclose(
        panel[:3, :3] @ np.array(polygon.normal), (0.0, 1.0, 0.0), atol=FLOAT32
    )
    relief, lens = spec.guide.relief_mm, spec.lens
    depth = relief - lens.distance_mm - lens.focal_length_mm
    in_x = spec.patch(spec.source.patch).center_mm[0]
    np.testing.assert_allclose(panel[:3, 3], (in_x, depth, 0.0), atol=1e-5)
