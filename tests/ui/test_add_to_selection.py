# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Add > Hologram makes of what is selected: holograms on faces, glass."""

import json
from typing import Any

import bpy
import pytest

from hoe_addon.ui.ids import Op
from tests.ui.steps import assert_undone_and_redone, call, done, state


@pytest.fixture
def scene(registered: Any) -> Any:
    """An empty scene in millimetres."""
    registered.unit_settings.scale_length = 1e-3
    bpy.ops.ed.undo_push(message="start")
    return registered


def edited_cube(*faces: int) -> Any:
    """A cube of 20 mm in edit mode, with some faces selected."""
    bpy.ops.mesh.primitive_cube_add(size=20.0)
    cube = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for face in faces:
        cube.data.polygons[face].select = True
    bpy.ops.object.mode_set(mode="EDIT")
    return cube


def test_hologram_on_selected_faces(scene: Any) -> None:
    cube = edited_cube(4)
    call(Op.HOLOGRAM_ON_FACES)
    assert bpy.context.mode == "EDIT_MESH"
    assert cube.active_material.hologram.enabled
    bpy.ops.object.mode_set(mode="OBJECT")
    slots = [face.material_index for face in cube.data.polygons]
    assert [slot == cube.active_material_index for slot in slots] == [
        face == 4 for face in range(6)
    ]
    assert cube.material_slots[slots[0]].material is None


def test_no_faces_is_told_in_edit_mode(scene: Any) -> None:
    edited_cube()
    with pytest.raises(RuntimeError, match="object Cube: has no face selected"):
        call(Op.HOLOGRAM_ON_FACES)
    assert bpy.context.mode == "EDIT_MESH"


def test_hologram_on_faces_is_undone(scene: Any) -> None:
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.ops.ed.undo_push(message="plane")
    before = state()
    done(Op.HOLOGRAM_ON_FACES)
    assert_undone_and_redone(before)


def test_selected_objects_become_glass(scene: Any) -> None:
    bpy.ops.mesh.primitive_cube_add(size=20.0)
    cube = bpy.context.object
    call(Op.ADD_GLASS, shape="SELECTED", medium="PMMA")
    assert json.loads(cube.hologram.details) == {"medium": "PMMA"}
    assert cube.hologram.role == "glass"
    cube.select_set(False)
    with pytest.raises(RuntimeError, match="No mesh object is selected"):
        call(Op.ADD_GLASS, shape="SELECTED")
