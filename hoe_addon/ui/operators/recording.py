# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators of a hologram's own panels."""

import bpy
from bpy.props import EnumProperty, IntProperty

from ...blender.add.hologram import hologram_on_faces
from ...blender.document.hologram_lists import add_order, add_share, remove_order, remove_share
from ...blender.document.source_objects import bind_source, make_source
from ...blender.props.changes import mark_block
from ...blender.props.sync import refresh
from ...blender.registration import class_registrars
from ..context import shown_hologram, why_not_editable
from ..facts.cache import redraw
from ..facts.checks import check_now
from ..facts.material import FACTS
from ..ids import Op
from ..telling import tells

_ROLES = (
    ("object", "Object Wave", "The wave that order +1 gives back", 0),
    ("reference", "Reference Wave", "The wave that reads the hologram out", 1),
)


class _OfHologram:
    """Common part of operators of the hologram that is shown."""

    @classmethod
    def poll(cls, context):
        words = why_not_editable(context)
        if words:
            cls.poll_message_set(words)
        return not words


class HOE_OT_make_hologram(bpy.types.Operator):
    """Make the active material a hologram."""

    bl_idname = Op.MAKE_HOLOGRAM
    bl_label = "Make Hologram"
    bl_description = (
        "Make the faces of the active material slot a hologram: at first a lens, recorded at "
        "532 nm with a plane wave and one that converges to a point behind"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        item = context.object
        if item is None or item.type != "MESH":
            cls.poll_message_set("Select a mesh object")
            return False
        if item.mode != "OBJECT":
            cls.poll_message_set("Leave Edit Mode first")
            return False
        if shown_hologram(context) is not None:
            cls.poll_message_set("The active material is a hologram already")
            return False
        return True

    @tells
    def execute(self, context):
        item, slot = context.object, context.object.active_material_index
        several = len(item.material_slots) > 1
        faces = [face.index for face in item.data.polygons if face.material_index == slot]
        material, _ = hologram_on_faces(context.scene, item, faces if several else None)
        item.active_material_index = item.material_slots.find(material.name)
        focus = -material.hologram.recording.object.position_mm[2]
        words = f"a lens with a focal length of {focus:.4g} mm at 532 nm"
        self.report({"INFO"}, f"{material.name}: {words}")
        return {"FINISHED"}


class HOE_OT_source_from_selection(_OfHologram, bpy.types.Operator):
    """Let a wave follow the other selected object, or a new one."""

    bl_idname = Op.SOURCE_FROM_SELECTION
    bl_label = "Source from Selection"
    bl_description = (
        "Let this wave follow the other selected object; with none selected, an empty is added "
        "where the source is"
    )
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(name="Wave", description="Wave that follows the object", items=_ROLES)

    @tells
    def execute(self, context):
        material = shown_hologram(context)
        others = [item for item in context.selected_objects or () if item != context.object]
        if others:
            bind_source(material, self.role, others[0])
        else:
            make_source(context.scene.collection, material, self.role)
        target = getattr(material.hologram.recording, self.role).target
        self.report({"INFO"}, f"{target.name} is the source of the {self.role} wave")
        return {"FINISHED"}


class _OfList(_OfHologram):
    """Common part of operators that add to a list or take from it."""

    @tells
    def execute(self, context):
        order = self.change(shown_hologram(context))
        name = f"{order:+d}" if order else "0"
        self.report({"INFO"}, f"Order {name} {self.done}")
        return {"FINISHED"}


class _FromList(_OfList):
    """Common part of operators that take from a list."""

    index: IntProperty(name="Entry", description="Place in the list, from 0", min=0)


class HOE_OT_add_order(_OfList, bpy.types.Operator):
    """Trace one more order."""

    bl_idname = Op.ADD_ORDER
    bl_label = "Add Order"
    bl_description = "Trace one more diffraction order"
    bl_options = {"REGISTER", "UNDO"}
    done = "is traced"

    def change(self, material):
        return add_order(material)


class HOE_OT_remove_order(_FromList, bpy.types.Operator):
    """Trace an order no more."""

    bl_idname = Op.REMOVE_ORDER
    bl_label = "Remove Order"
    bl_description = "Trace this diffraction order no more; its light is lost"
    bl_options = {"REGISTER", "UNDO"}
    done = "is traced no more"

    def change(self, material):
        return remove_order(material, self.index)


class HOE_OT_add_share(_OfList, bpy.types.Operator):
    """Give one more order a share of the light."""

    bl_idname = Op.ADD_SHARE
    bl_label = "Add Share"
    bl_description = "Give one more order a share of the light, 0 at first"
    bl_options = {"REGISTER", "UNDO"}
    done = "has a share"

    def change(self, material):
        return add_share(material)


class HOE_OT_remove_share(_FromList, bpy.types.Operator):
    """Take the share of an order away."""

    bl_idname = Op.REMOVE_SHARE
    bl_label = "Remove Share"
    bl_description = "Take the share of this order away; its light is absorbed"
    bl_options = {"REGISTER", "UNDO"}
    done = "has no share any more"

    def change(self, material):
        return remove_share(material, self.index)


class HOE_OT_refresh(_OfHologram, bpy.types.Operator):
    """Make the shader of a hologram anew."""

    bl_idname = Op.REFRESH
    bl_label = "Try Again"
    bl_description = "Make the shader from the properties anew, such as after a file was mended"
    bl_options = {"REGISTER", "UNDO"}

    @tells
    def execute(self, context):
        material = shown_hologram(context)
        mark_block(material)
        refresh(material, make=bpy.app.background)
        self.report({"INFO"}, f"{material.name}: the shader agrees with the properties")
        return {"FINISHED"}


class HOE_OT_check(_OfHologram, bpy.types.Operator):
    """Check whether the efficiency model holds for a hologram."""

    bl_idname = Op.CHECK
    bl_label = "Check Model"
    bl_description = (
        "Check the assumptions of the efficiency model at the light that the hologram is meant for"
    )
    bl_options = {"REGISTER"}

    @tells
    def execute(self, context):
        material = shown_hologram(context)
        found = check_now(material)
        FACTS.update_now(material)
        redraw()
        for warning in found.warnings:
            self.report({"WARNING"}, warning)
        if not found.warnings:
            self.report({"INFO"}, f"{material.name}: all assumptions hold")
        return {"FINISHED"}


register, unregister = class_registrars(
    (
        HOE_OT_make_hologram,
        HOE_OT_source_from_selection,
        HOE_OT_add_order,
        HOE_OT_remove_order,
        HOE_OT_add_share,
        HOE_OT_remove_share,
        HOE_OT_refresh,
        HOE_OT_check,
    )
)
