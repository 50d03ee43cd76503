# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scale a scene to millimetres."""

import bpy

from ...blender.registration import class_registrars
from ...blender.units import MILLIMETRE, in_millimetres, scale_to_millimetres
from ...core.errors import HoeError
from ..ids import Op
from .add_placing import may_add
from .add_views import scale_views


class HOE_OT_scale_to_millimetres(bpy.types.Operator):
    """Make one unit of the scene one millimetre."""

    bl_idname = Op.SCALE_TO_MILLIMETRES
    bl_label = "Scale to Millimetres"
    bl_description = (
        "Scale all objects, lamps and cameras so that one unit is one millimetre, as holograms "
        "need it; everything keeps its true size, and the picture stays the same"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not may_add(cls, context):
            return False
        if in_millimetres(context.scene):
            cls.poll_message_set("One unit of this scene is one millimetre already")
            return False
        return True

    def execute(self, context):
        factor = context.scene.unit_settings.scale_length / MILLIMETRE
        try:
            notes = scale_to_millimetres(context.scene)
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if context.window is not None:
            scale_views(context.window, factor)
        if notes:
            self.report({"WARNING"}, f"Scaled by {factor:g}, but not: {'; '.join(notes)}")
        else:
            self.report({"INFO"}, f"Scaled by {factor:g}; one unit is one millimetre now")
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_scale_to_millimetres,))
