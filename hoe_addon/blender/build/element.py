# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh object of a hologram of any shape."""

from collections.abc import Sequence

import bpy
import numpy as np

from ...core.units import m_to_mm
from ...model.element import ElementMesh, element_mesh
from ...model.hologram import HologramSpec
from ...model.mesh_surface import MeshSurface
from ...model.surface import PlaneSurface
from . import meshes

ERROR_PROPERTY = "hoe_direction_error_rad"
"""Custom property of the object: the error that its facets add to directions, as stated in
``model.element``."""


def hologram_element(
    collection: bpy.types.Collection,
    spec: HologramSpec,
    *materials: bpy.types.Material,
    units_per_mm: float = 1.0,
    parent: bpy.types.Object | None = None,
    location: Sequence[float] = (0.0, 0.0, 0.0),
) -> bpy.types.Object:
    """Make the mesh of a hologram as an object.

    A curved one gets facets until directions are right to 1e-4 rad, as far as
    ``model.element.MAX_TRIANGLES`` allows; the error that is left is the custom property
    `ERROR_PROPERTY`. The object may be moved, turned, mirrored, scaled, and sheared by its parents.

    Args:
        collection: Where it is linked.
        spec: The hologram.
        materials: Materials by slot; the hologram's own is made by ``hologram_material``.
        units_per_mm: Scene units in one mm, as for the material.
        parent: Object whose frame the location is in.
        location: Where, in scene units.

    Returns:
        The object; its frame is that of the hologram.
    """
    made, error = element_datablock(spec, units_per_mm)
    item = meshes.add(collection, made, *materials, parent=parent, location=location)
    item[ERROR_PROPERTY] = error
    return item


def surface_of(item: bpy.types.Object, units_per_mm: float = 1.0) -> MeshSurface:
    """Take the mesh of an object, with its modifiers, as the surface of a hologram.

    Args:
        item: A mesh object; its own frame becomes that of the hologram.
        units_per_mm: Scene units in one mm.

    Returns:
        The surface, with the object's smooth normals, for a document.

    Raises:
        FieldError: If it has no faces, or is folded so that a normal points to a face's back.
    """
    evaluated = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        triangles = mesh.loop_triangles
        corners = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        normals, faces = np.empty_like(corners), np.empty(3 * len(triangles), dtype=np.int32)
        mesh.vertices.foreach_get("co", corners)
        mesh.vertex_normals.foreach_get("vector", normals)
        triangles.foreach_get("vertices", faces)
    finally:
        evaluated.to_mesh_clear()
    return MeshSurface(
        vertices_mm=(corners.astype(np.float64) / units_per_mm).reshape(-1, 3).tolist(),
        faces=faces.reshape(-1, 3).tolist(),
        normals=normals.reshape(-1, 3).tolist(),
    )


def element_datablock(
    spec: HologramSpec, units_per_mm: float = 1.0, direction_error: float | None = None
) -> tuple[bpy.types.Mesh, float]:
    """Make the mesh of a hologram without an object.

    Args:
        spec: The hologram.
        units_per_mm: Scene units in one mm.
        direction_error: Stated error to reach, radians; by default 1e-4.

    Returns:
        The mesh, and its stated error of directions in radians.
    """
    surface = spec.surface
    if isinstance(surface, PlaneSurface) and surface.outline == "rectangle":
        width, height = (side * units_per_mm for side in surface.size_mm)
        return meshes.rectangle(spec.name, width, height), 0.0
    facets: ElementMesh = (
        element_mesh(spec) if direction_error is None else element_mesh(spec, direction_error)
    )
    units = m_to_mm(units_per_mm)
    if isinstance(surface, PlaneSurface):
        corners = facets.mesh.vertices * units
        mesh = meshes.from_polygons(spec.name, corners.tolist(), facets.mesh.faces.tolist())
        return mesh, 0.0
    return meshes.smooth(spec.name, facets.mesh, units), facets.direction_error
