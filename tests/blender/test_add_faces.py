# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a mesh as a hologram: frame, shape, and what is refused."""

from typing import Any

import bpy
import pytest

from hoe_addon.blender.add import bodies, hologram
from hoe_addon.core.errors import HoeError


@pytest.fixture
def scene(registered: Any) -> Any:
    """An empty scene in millimetres."""
    registered.unit_settings.scale_length = 1e-3
    return registered


def blocks() -> list[str]:
    """Every datablock of the file."""
    kinds = [prop for prop in bpy.data.bl_rna.properties if prop.type == "COLLECTION"]
    return [repr(block) for kind in kinds for block in getattr(bpy.data, kind.identifier)]


def cube(size: float = 20.0) -> Any:
    bpy.ops.mesh.primitive_cube_add(size=size)
    return bpy.context.object


def test_faces_that_look_all_around_are_refused(scene: Any) -> None:
    item = cube()
    before = blocks()
    with pytest.raises(HoeError, match="faces must look to one side"):
        hologram.hologram_on_faces(scene, item)
    assert blocks() == before
    assert len(item.material_slots) == 0
    assert scene.hologram.kind == "none"


def test_uneven_scale_is_refused(scene: Any) -> None:
    item = cube()
    item.scale = (1.0, 2.0, 1.0)
    bpy.context.view_layer.update()
    with pytest.raises(HoeError, match=r"same scale along all axes, not 1, 2, 1; apply it"):
        hologram.hologram_on_faces(scene, item, [0])


def test_millimetres_count_on_a_scaled_object(scene: Any) -> None:
    item = cube(2.0)
    item.scale = (10.0, 10.0, 10.0)
    bpy.context.view_layer.update()
    top = next(face.index for face in item.data.polygons if face.normal.z > 0.9)
    material, _ = hologram.hologram_on_faces(scene, item, [top])
    assert tuple(material.hologram.surface.size_mm) == pytest.approx((20.0, 20.0))
    assert material.hologram.units_per_mm == pytest.approx(0.1)
    assert tuple(material.hologram.frame.origin) == pytest.approx((0.0, 0.0, 1.0))


def test_curved_faces_are_a_mesh(scene: Any) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=20.0)
    item = bpy.context.object
    cap = [face.index for face in item.data.polygons if face.center.z > 15.0]
    material, _ = hologram.hologram_on_faces(scene, item, cap)
    assert material.hologram.surface.shape == "mesh"
    assert all(item.data.polygons[face].use_smooth for face in cap)
    assert not item.data.polygons[next(iter(set(range(32 * 16)) - set(cap)))].use_smooth


def test_modifiers_count(scene: Any) -> None:
    """A wide solid of a thin sheet: its faces are where the modifier puts them."""
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    item = bpy.context.object
    item.modifiers.new("Array", "ARRAY").count = 2
    material, _ = hologram.hologram_on_faces(scene, item)
    assert tuple(material.hologram.surface.size_mm) == pytest.approx((40.0, 20.0))
    assert tuple(material.hologram.frame.origin) == pytest.approx((10.0, 0.0, 0.0))


def test_hologram_on_a_slab_has_its_medium_behind(scene: Any) -> None:
    item, _ = bodies.add_slab(scene, medium="PMMA")
    front = [face.index for face in item.data.polygons if face.normal.z > 0.9]
    material, _ = hologram.hologram_on_faces(scene, item, front)
    assert material.hologram.media.back.catalogue_name == "PMMA"
    assert [slot.material.name for slot in item.material_slots][:2] == ["Guide", "Guide Rim"]


def test_parts_of_a_device_are_refused(scene: Any) -> None:
    plate, _ = hologram.add_hologram(scene)
    with pytest.raises(HoeError, match="object Hologram: is a hologram already; choose another"):
        hologram.hologram_on_faces(scene, plate)
    empty = bpy.data.objects.new("Empty", None)
    with pytest.raises(HoeError, match="object Empty: must be a mesh; convert it"):
        hologram.hologram_on_faces(scene, empty)


def test_focus_is_as_far_for_the_width_as_on_a_plate(scene: Any) -> None:
    item = cube(2000.0)
    material, _ = hologram.hologram_on_faces(scene, item, [0])
    assert material.hologram.recording.object.position_mm[2] == pytest.approx(-5000.0)
    material, _ = hologram.hologram_on_faces(scene, item, [1], distance_mm=70.0)
    assert material.hologram.recording.object.position_mm[2] == pytest.approx(-70.0)
