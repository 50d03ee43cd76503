# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of optical elements, in scene units, each wound so that its normal is +z."""

from collections.abc import Sequence

import bpy
import numpy as np

from ...core.shapes import MeshShape
from ..marks import mark

NORMAL_ATTRIBUTE = "hoe_normal"
"""Attribute of the exact normals at the corners, which the hologram's shader interpolates. Take it
away after editing such a mesh by hand: the shader then uses Blender's normals."""

_FREE_NORMALS = "custom_normal"
"""Name by which Blender knows normals that are stored as plain vectors."""


def rectangle(name: str, width: float, height: float) -> bpy.types.Mesh:
    """A rectangle around the origin in the plane z = 0."""
    x, y = width / 2.0, height / 2.0
    return from_polygons(
        name, [(-x, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (-x, y, 0.0)], [(0, 1, 2, 3)]
    )


def disk(name: str, diameter: float, sides: int = 128) -> bpy.types.Mesh:
    """A regular polygon of the area of the disk, around the origin in the plane z = 0."""
    angle = np.arange(sides) * (2.0 * np.pi / sides)
    # A polygon of this radius has exactly the area of the circle.
    radius = diameter / 2.0 * np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides)))
    corners = np.stack((radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle), axis=1)
    return from_polygons(name, corners.tolist(), [tuple(range(sides))])


def from_polygons(
    name: str, corners: Sequence[Sequence[float]], polygons: Sequence[Sequence[int]]
) -> bpy.types.Mesh:
    """A mesh from corners and polygons.

    Args:
        name: Name of the datablock.
        corners: Points.
        polygons: Corner numbers, counter-clockwise seen from outside.

    Returns:
        The mesh, validated.
    """
    mesh = mark(bpy.data.meshes.new(name))
    mesh.from_pydata([tuple(corner) for corner in corners], [], [tuple(p) for p in polygons])
    mesh.validate()
    return mesh


def smooth(name: str, shape: MeshShape, units: float) -> bpy.types.Mesh:
    """A mesh with smooth normals.

    Args:
        name: Name of the datablock.
        shape: Its triangles and normals.
        units: Scene units in one metre.

    Returns:
        The mesh: its normals are there twice, as Blender's own, and as the attribute
        `NORMAL_ATTRIBUTE`, since Cycles rounds Blender's to some 3e-5 rad.
    """
    mesh = mark(bpy.data.meshes.new(name))
    count = len(shape.faces)
    mesh.vertices.add(len(shape.vertices))
    mesh.vertices.foreach_set("co", (shape.vertices * units).astype(np.float32).ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", shape.faces.astype(np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.validate()
    mesh.shade_smooth()
    for attribute_name in (NORMAL_ATTRIBUTE, _FREE_NORMALS):
        attribute = mesh.attributes.new(attribute_name, "FLOAT_VECTOR", "POINT")
        attribute.data.foreach_set("vector", shape.normals.astype(np.float32).ravel())
    return mesh


def add(
    collection: bpy.types.Collection,
    mesh: bpy.types.Mesh,
    *materials: bpy.types.Material,
    parent: bpy.types.Object | None = None,
    location: Sequence[float] = (0.0, 0.0, 0.0),
) -> bpy.types.Object:
    """Put a mesh into a collection as an object.

    Args:
        collection: Where it is linked.
        mesh: The mesh; it gets the materials.
        materials: Materials by slot.
        parent: Object whose frame the location is in.
        location: Where, in scene units.

    Returns:
        The object.
    """
    for material in materials:
        mesh.materials.append(material)
    item = bpy.data.objects.new(mesh.name, mesh)
    item.location = location
    item.parent = parent
    collection.objects.link(item)
    return item
