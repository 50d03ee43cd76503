# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clear bodies: a light-guide slab, dispersive glass of any shape, an ideal lens."""

import math
from collections.abc import Iterable

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

from ...core.errors import HoeError
from ...model.device import GuideSpec
from ...model.medium import MediumRef
from ..build import meshes
from ..build.guide import add_guide
from ..ids import Role
from ..shaders.materials import dielectric_material, thin_lens_material
from . import elements
from .leaving import guest_of

_BALL_DIVISIONS = 6
"""Some 40 000 corners: the interpolated normal is off by less than 1e-4."""


def add_slab(
    scene: bpy.types.Scene,
    size_mm: tuple[float, float] = (50.0, 30.0),
    thickness_mm: float = 2.0,
    medium: MediumRef = "N-BK7",
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a clear plate with a black rim; holograms may be put on its faces.

    Args:
        scene: The scene; it begins to hold a document.
        size_mm: Width and height.
        thickness_mm: Distance of its faces.
        medium: What it is made of.
        matrix: Where its middle stands, its faces to +z and -z; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        SpecError: A number breaks a rule, or there is no such medium.
    """
    relief_mm = 1.0
    spec = GuideSpec(medium=medium, thickness_mm=thickness_mm, size_mm=size_mm, relief_mm=relief_mm)
    with guest_of(scene) as settings:
        elements.begin(scene)
        item = add_guide(collection or scene.collection, spec, (), elements.spectrum(scene))
        item.name = item.data.name = "Slab"
        item.data.transform(Matrix.Translation((0.0, 0.0, relief_mm + thickness_mm / 2.0)))
        elements.call(item, Role.SLAB, medium=medium, size_mm=size_mm, thickness_mm=thickness_mm)
        elements.put(scene, item, matrix, collection)
        elements.settle(scene)
    return item, tuple(settings)


def add_ideal_lens(
    scene: bpy.types.Scene,
    focal_length_mm: float = 100.0,
    diameter_mm: float = 25.0,
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a thin lens without any error.

    Args:
        scene: The scene; it begins to hold a document.
        focal_length_mm: Focal length; below 0 for a diverging lens.
        diameter_mm: Diameter.
        matrix: Where it stands, its axis along z; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        HoeError: A length makes no lens.
    """
    if not (math.isfinite(focal_length_mm) and focal_length_mm != 0.0):
        raise HoeError(f"focal length: must be a length other than 0 mm, got {focal_length_mm:g}")
    if not diameter_mm > 0.0:
        raise HoeError(f"diameter: must be above 0 mm, got {diameter_mm:g}")
    with guest_of(scene) as settings:
        elements.begin(scene)
        item = meshes.add(
            collection or scene.collection,
            meshes.disk("Ideal Lens", diameter_mm),
            thin_lens_material(focal_length_mm),
        )
        elements.call(
            item, Role.IDEAL_LENS, focal_length_mm=focal_length_mm, diameter_mm=diameter_mm
        )
        elements.put(scene, item, matrix, collection)
        elements.settle(scene)
    return item, tuple(settings)


def add_glass(
    scene: bpy.types.Scene,
    shape: str = "prism",
    size_mm: float = 30.0,
    medium: MediumRef = "N-BK7",
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a body of dispersive glass.

    Args:
        scene: The scene; it begins to hold a document.
        shape: ``prism``, of 60 degrees with its edges along y, or ``ball``.
        size_mm: Side of the prism, which is as high, or diameter of the ball.
        medium: What it is made of.
        matrix: Where its middle stands; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        HoeError: There is no such medium.
    """
    with guest_of(scene) as settings:
        elements.begin(scene)
        mesh = _ball(size_mm) if shape == "ball" else _prism(size_mm)
        item = meshes.add(collection or scene.collection, mesh)
        _make_glass(scene, item, medium)
        elements.put(scene, item, matrix, collection)
        elements.settle(scene)
    return item, tuple(settings)


def make_glass(
    scene: bpy.types.Scene, items: Iterable[bpy.types.Object], medium: MediumRef = "N-BK7"
) -> tuple[str, ...]:
    """Make mesh objects of dispersive glass; holograms on their faces stay.

    Args:
        scene: The scene; it begins to hold a document.
        items: Closed meshes with normals that point out.
        medium: What they are made of.

    Returns:
        Names of the render settings that were changed.

    Raises:
        HoeError: An object is no closed body, or is something else already; nothing is changed.
    """
    chosen = list(items)
    for item in chosen:
        _check_body(item)
    with guest_of(scene) as settings:
        elements.begin(scene)
        for item in chosen:
            _make_glass(scene, item, medium)
        elements.settle(scene)
    return tuple(settings)


def _make_glass(scene: bpy.types.Scene, item: bpy.types.Object, medium: MediumRef) -> None:
    glass = dielectric_material(f"{item.name} Glass", medium, "air", elements.spectrum(scene))
    if not item.material_slots:
        item.data.materials.append(glass)
    for slot in item.material_slots:
        if slot.material is None or not slot.material.hologram.enabled:
            slot.material = glass
    elements.call(item, Role.GLASS, medium=medium)


def _check_body(item: bpy.types.Object) -> None:
    mesh = elements.own_mesh(item, Role.GLASS)
    if _volume(mesh) <= 0.0:
        raise HoeError(
            f"object {item.name}: must be a closed body with its normals outside; in Edit Mode "
            "choose Mesh > Normals > Recalculate Outside"
        )


def _volume(mesh: bpy.types.Mesh) -> float:
    """Volume that a mesh encloses; 0 where it is open, below 0 where its normals point in."""
    shape = bmesh.new()
    try:
        shape.from_mesh(mesh)
        if not shape.faces or not all(edge.is_contiguous for edge in shape.edges):
            return 0.0
        return shape.calc_volume(signed=True)
    finally:
        shape.free()


def _ball(diameter: float) -> bpy.types.Mesh:
    shape = bmesh.new()
    try:
        bmesh.ops.create_icosphere(shape, subdivisions=_BALL_DIVISIONS, radius=diameter / 2.0)
        mesh = bpy.data.meshes.new("Glass Ball")
        shape.to_mesh(mesh)
    finally:
        shape.free()
    mesh.shade_smooth()
    return mesh


def _prism(side: float) -> bpy.types.Mesh:
    """A triangle with one corner up (+z), drawn out along y, around its centre of gravity."""
    radius = side / math.sqrt(3.0)
    angle = np.radians([90.0, 210.0, 330.0])
    profile = np.stack((radius * np.cos(angle), 0.0 * angle, radius * np.sin(angle)), axis=1)
    half = np.asarray((0.0, side / 2.0, 0.0))
    corners = np.concatenate((profile - half, profile + half))
    sides = [(k, k + 3, (k + 1) % 3 + 3, (k + 1) % 3) for k in range(3)]
    return meshes.from_polygons("Prism", corners.tolist(), [(0, 1, 2), (5, 4, 3), *sides])
