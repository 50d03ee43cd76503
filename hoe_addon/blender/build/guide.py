# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light guide: one watertight mesh, its faces cut so that hologram patches are part of it."""

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from ...model.device import GuideSpec, PatchSpec
from ...shading.hologram import Frame
from ..shaders.materials import absorber_material, dielectric_material, hologram_material
from ..shaders.spectral import SpectralScene
from . import meshes

_SURFACE, _RIM = 0, 1
FIRST_PATCH = 2
"""Material slot of the first hologram, behind those of bare surface and rim."""


def add_guide(
    collection: bpy.types.Collection,
    spec: GuideSpec,
    patches: Sequence[PatchSpec],
    spectral: SpectralScene,
    parent: bpy.types.Object | None = None,
) -> bpy.types.Object:
    """Add a plate with holograms on its faces; its rim is blackened.

    Args:
        collection: Where it is linked.
        spec: The plate; 1 scene unit is 1 mm.
        patches: The holograms.
        spectral: The sampled spectrum of the scene.
        parent: Object whose frame the device is in.

    Returns:
        The plate. Material slots: bare surface, rim, then one for each patch.
    """
    materials = [
        dielectric_material(
            "Guide", spec.medium, spec.outside, spectral, flat_normal=(0.0, 0.0, 1.0)
        ),
        absorber_material("Guide Rim"),
    ]
    materials += [
        hologram_material(patch.hologram(spec), spectral, patch_frame(spec, patch))
        for patch in patches
    ]
    return meshes.add(collection, guide_mesh(spec, patches), *materials, parent=parent)


def guide_mesh(spec: GuideSpec, patches: Sequence[PatchSpec]) -> bpy.types.Mesh:
    """The plate's mesh, without materials.

    Args:
        spec: The plate; 1 scene unit is 1 mm.
        patches: The holograms.

    Returns:
        The mesh; each face has the slot of its material, as ``add_guide`` says.
    """
    mesh = _mesh(spec, patches)
    mesh.polygons.foreach_set("material_index", _slots(mesh, spec, patches))
    return mesh


def patch_frame(guide: GuideSpec, patch: PatchSpec) -> Frame:
    """Where a patch's own frame lies in the device."""
    x, y = patch.center_mm
    along_x = 1.0 if patch.face == "eye" else -1.0
    return Frame((x, y, guide.face_z_mm(patch.face)), (along_x, 0.0, 0.0), (0.0, 1.0, 0.0))


def _mesh(guide: GuideSpec, patches: Sequence[PatchSpec]) -> bpy.types.Mesh:
    """A box whose two faces are cut along all edges of all patches, rim included.

    Both faces get the same cuts, so no corner ever lies inside a neighbour's edge, where a ray
    could slip through.
    """
    x, y = (_cuts(guide, patches, axis) for axis in (0, 1))
    columns, rows = len(x), len(y)
    corners = [
        (float(a), float(b), guide.face_z_mm(face))
        for face in ("world", "eye")
        for b in y
        for a in x
    ]

    def corner(face: int, row: int, column: int) -> int:
        return (face * rows + row) * columns + column

    polygons: list[tuple[int, ...]] = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            ring = ((row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column))
            near = [corner(1, *place) for place in ring]
            far = [corner(0, *place) for place in reversed(ring)]
            polygons += [tuple(near), tuple(far)]
    rim = [(0, column) for column in range(columns)]
    rim += [(row, columns - 1) for row in range(1, rows)]
    rim += [(rows - 1, column) for column in range(columns - 2, -1, -1)]
    rim += [(row, 0) for row in range(rows - 2, 0, -1)]
    for start, end in zip(rim, [*rim[1:], rim[0]], strict=True):
        polygons.append((corner(0, *start), corner(0, *end), corner(1, *end), corner(1, *start)))
    return meshes.from_polygons("Guide", corners, polygons)


def _cuts(guide: GuideSpec, patches: Sequence[PatchSpec], axis: int) -> NDArray[np.float64]:
    spans = [(guide.center_mm, guide.size_mm)]
    spans += [(patch.center_mm, patch.size_mm) for patch in patches]
    edges = [centre[axis] + sign * size[axis] / 2.0 for centre, size in spans for sign in (-1, 1)]
    # Edges that are equal but for rounding are one cut.
    width = guide.size_mm[axis]
    return np.unique(np.round(np.asarray(edges) / width, 10)) * width


def _slots(
    mesh: bpy.types.Mesh, guide: GuideSpec, patches: Sequence[PatchSpec]
) -> NDArray[np.int32]:
    """Material slot of each polygon, by its centre."""
    count = len(mesh.polygons)
    centres = np.empty(count * 3, dtype=np.float32)
    normals = np.empty(count * 3, dtype=np.float32)
    mesh.polygons.foreach_get("center", centres)
    mesh.polygons.foreach_get("normal", normals)
    centres, normals = centres.reshape(-1, 3), normals.reshape(-1, 3)
    slots = np.where(np.abs(normals[:, 2]) > 0.5, _SURFACE, _RIM).astype(np.int32)
    for number, patch in enumerate(patches):
        facing = normals[:, 2] > 0.5 if patch.face == "eye" else normals[:, 2] < -0.5
        offset = np.abs(centres[:, :2] - np.asarray(patch.center_mm))
        inside = np.all(offset < np.asarray(patch.size_mm) / 2.0, axis=1)
        slots[facing & inside] = FIRST_PATCH + number
    return slots
