# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms of a light guide, and the view through the eye."""

import bpy
from bpy.props import EnumProperty

from ...blender.build.looking import look_through_eye
from ...blender.document.patches import Purpose, add_patch, remove_patch
from ...blender.document.size import set_size
from ...blender.ids import DeviceKind
from ...blender.registration import class_registrars
from ..ids import Op
from ..telling import tells


class _OfLightGuide:
    """Common part: there is a light guide."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if context.scene is None or context.scene.hologram.kind != DeviceKind.LIGHT_GUIDE:
            cls.poll_message_set("This scene has no light guide; add one with Add > Hologram")
            return False
        return True


class HOE_OT_add_patch(_OfLightGuide, bpy.types.Operator):
    """Add a hologram to the plate."""

    bl_idname = Op.ADD_PATCH
    bl_label = "Add Hologram to Plate"
    bl_description = (
        "Add a hologram on a free place of the plate's eye side; it has the grating of the "
        "in-coupler, so that colours come together again"
    )
    bl_options = {"REGISTER", "UNDO"}

    purpose: EnumProperty(
        name="Purpose",
        description="What the hologram is for",
        items=Purpose.items(),
        default=Purpose.OUT,
    )

    @tells
    def execute(self, context):
        patch = add_patch(context.scene, self.purpose)
        self.report({"INFO"}, f"{patch.name}: added; its efficiency is in the Efficiency panel")
        return {"FINISHED"}


class HOE_OT_remove_patch(_OfLightGuide, bpy.types.Operator):
    """Take a hologram off the plate."""

    bl_idname = Op.REMOVE_PATCH
    bl_label = "Remove Hologram from Plate"
    bl_description = "Take the hologram that is chosen in the list off the plate"
    bl_options = {"REGISTER", "UNDO"}

    @tells
    def execute(self, context):
        held = context.scene.hologram
        name = remove_patch(context.scene, held.active_patch)
        self.report({"INFO"}, f"{name}: removed")
        return {"FINISHED"}


class HOE_OT_true_size(bpy.types.Operator):
    """Give the device its true size."""

    bl_idname = Op.TRUE_SIZE
    bl_label = "True Size"
    bl_description = (
        "Scale the device, about the origin of its root, to the size in mm that it has in its "
        "panels; what is seen through it stays the same"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.scene is None or context.scene.hologram.root is None:
            cls.poll_message_set("This scene holds no device; add one with Add > Hologram")
            return False
        return True

    @tells
    def execute(self, context):
        set_size(context.scene)
        return {"FINISHED"}


class HOE_OT_look_through_eye(bpy.types.Operator):
    """Look through the eye."""

    bl_idname = Op.LOOK_THROUGH_EYE
    bl_label = "Look through the Eye"
    bl_description = "Make the eye the camera of the scene, and look through it in the 3-D view"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.scene is None or context.scene.hologram.eye.camera is None:
            cls.poll_message_set("This scene has no eye; add one with Add > Hologram > Eye")
            return False
        return True

    @tells
    def execute(self, context):
        look_through_eye(context.scene, _view(context))
        return {"FINISHED"}


def _view(context: bpy.types.Context) -> bpy.types.SpaceView3D | None:
    """The 3-D view of the click, or the largest one of its window."""
    if isinstance(context.space_data, bpy.types.SpaceView3D):
        return context.space_data
    areas = context.screen.areas if context.screen is not None else ()
    views = [area for area in areas if area.type == "VIEW_3D"]
    if not views:
        return None
    return max(views, key=lambda area: area.width * area.height).spaces.active


register, unregister = class_registrars(
    (HOE_OT_add_patch, HOE_OT_remove_patch, HOE_OT_true_size, HOE_OT_look_through_eye)
)
