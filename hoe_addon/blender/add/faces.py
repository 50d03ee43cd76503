# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a mesh as the surface of a hologram: their middle, their frame, their shape."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import HoeError
from ...model.mesh_surface import MeshSurface
from ...model.surface import PlaneSurface, SurfaceSpec
from ...shading.hologram import Frame
from ..units import units_per_mm

_FLAT = 1e-4
"""Faces whose corners lie so near to their plane, over their size, are flat."""

_EVEN = 1e-3
"""How far the three scales of an object may be from each other."""

_OPPOSED = 0.05
"""Faces that look all around have a mean normal shorter than this."""

type Points = NDArray[np.float64]


@dataclass(frozen=True)
class Patch:
    """Faces as a hologram sees them.

    Attributes:
        frame: Frame of the recording in the object: origin in the middle of the faces, z along
            their mean normal.
        surface: Their shape in that frame.
        units_per_mm: Units of the object in one mm of the true size.
    """

    frame: Frame
    surface: SurfaceSpec
    units_per_mm: float

    @property
    def width_mm(self) -> float:
        """The larger of their two sides."""
        if isinstance(self.surface, PlaneSurface):
            return max(self.surface.size_mm)
        return float(np.ptp(np.asarray(self.surface.vertices_mm)[:, :2], axis=0).max())

    @property
    def is_flat(self) -> bool:
        """Whether the faces are a plane."""
        return isinstance(self.surface, PlaneSurface)


@contextmanager
def slot_given(item: bpy.types.Object, faces: NDArray[np.int64]) -> Iterator[int]:
    """Give faces of an object a material slot of their own, or leave it as it was.

    Args:
        item: A mesh object in object mode.
        faces: Numbers of the faces.

    Yields:
        Number of the slot, empty as yet.
    """
    mesh = item.data
    before = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("material_index", before)
    count = len(mesh.materials)
    # The other faces must not take what the first slot gets.
    for _ in range(1 if count or len(faces) == len(before) else 2):
        mesh.materials.append(None)
    slot = len(mesh.materials) - 1
    now = before.copy()
    now[faces] = slot
    mesh.polygons.foreach_set("material_index", now)
    mesh.update()
    try:
        yield slot
    except BaseException:
        if count == 0:
            mesh.materials.clear()  # pop() of the only one would leave the object its slot
        while len(mesh.materials) > count:
            mesh.materials.pop()
        mesh.polygons.foreach_set("material_index", before)
        mesh.update()
        raise


def patch_of(scene: bpy.types.Scene, item: bpy.types.Object, slot: int) -> Patch:
    """Find the frame and the shape of the faces that have a material slot, modifiers applied.

    Args:
        scene: The scene, which says how long a unit is.
        item: A mesh object of it.
        slot: Number of the slot.

    Returns:
        The faces as the surface of a hologram.

    Raises:
        HoeError: The object is scaled unevenly, or the faces look all around.
        FieldError: The faces are folded so that a normal points to a face's back.
    """
    units = units_per_mm(scene) / _even_scale(item)
    corners, normals, triangles = _triangles(item, slot)
    if len(triangles) == 0:
        raise HoeError(f"object {item.name}: has none of these faces after its modifiers")
    frame = _frame(item, corners, triangles)
    turn = frame.matrix()[:3, :3]
    used, numbers = np.unique(triangles, return_inverse=True)
    inside = (corners[used] - frame.origin) @ turn
    reach = np.abs(inside).max(axis=0)
    if reach[2] <= _FLAT * max(reach[0], reach[1]):
        width, height = 2.0 * reach[:2] / units
        return Patch(frame, PlaneSurface(size_mm=(float(width), float(height))), units)
    surface = MeshSurface(
        vertices_mm=(inside / units).tolist(),
        faces=numbers.reshape(-1, 3).tolist(),
        normals=(normals[used] @ turn).tolist(),
    )
    return Patch(frame, surface, units)


def _even_scale(item: bpy.types.Object) -> float:
    scale = [abs(side) for side in item.matrix_world.to_scale()]
    if max(scale) - min(scale) > _EVEN * max(scale) or min(scale) <= 0.0:
        shown = ", ".join(f"{side:.4g}" for side in scale)
        raise HoeError(
            f"object {item.name}: must have the same scale along all axes, not {shown}; "
            "apply it (Object > Apply > Scale)"
        )
    return sum(scale) / 3.0


def _triangles(item: bpy.types.Object, slot: int) -> tuple[Points, Points, NDArray[np.int32]]:
    evaluated = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        count = len(mesh.vertices)
        corners, normals = np.empty(3 * count, np.float32), np.empty(3 * count, np.float32)
        triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
        slots = np.empty(len(mesh.loop_triangles), np.int32)
        mesh.vertices.foreach_get("co", corners)
        mesh.vertex_normals.foreach_get("vector", normals)
        mesh.loop_triangles.foreach_get("vertices", triangles)
        mesh.loop_triangles.foreach_get("material_index", slots)
    finally:
        evaluated.to_mesh_clear()
    chosen = triangles.reshape(-1, 3)[slots == slot]
    return (
        corners.reshape(-1, 3).astype(np.float64),
        normals.reshape(-1, 3).astype(np.float64),
        chosen,
    )


def _frame(item: bpy.types.Object, corners: Points, triangles: NDArray[np.int32]) -> Frame:
    a, b, c = (corners[triangles[:, place]] for place in range(3))
    across = np.cross(b - a, c - a)
    areas = np.linalg.norm(across, axis=1)
    total, upright = areas.sum(), across.sum(axis=0)
    if not np.linalg.norm(upright) > _OPPOSED * total:
        raise HoeError(
            f"object {item.name}: its faces must look to one side, but these look all around; "
            "select fewer in Edit Mode"
        )
    origin = (areas[:, None] * (a + b + c) / 3.0).sum(axis=0) / total
    z = upright / np.linalg.norm(upright)
    along = np.eye(3)[0 if abs(z[0]) < 0.9 else 1]
    x = along - (along @ z) * z
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    return Frame(tuple(origin.tolist()), tuple(x.tolist()), tuple(y.tolist()))
