# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of a device: its eyebox, and what accuracy costs."""

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ...blender.ids import DeviceKind
from ...blender.job_files import JobKind
from ...blender.registration import class_registrars
from ..ids import Op
from ..jobs.starting import DeviceJob

_FOLDER = "Folder for the results; empty makes a new one, with a number, beside the file"


class HOE_OT_eyebox(DeviceJob, bpy.types.Operator):
    """Look through the device from all positions of the eyebox."""

    bl_idname = Op.EYEBOX
    bl_label = "Survey the Eyebox"
    bl_description = (
        "Look through the light guide from all positions of the eyebox, beside your work: views, "
        "and the luminance of a white display in cd/m²"
    )

    kind = JobKind.EYEBOX
    job_label = "Eyebox"

    folder: StringProperty(
        name="Folder", description=_FOLDER, subtype="DIR_PATH", options={"SKIP_SAVE"}
    )
    field_samples: IntProperty(
        name="Field Samples",
        description="Samples for each cell of the luminance measurement, of about half a degree",
        default=512,
        min=4,
        max=1_000_000,
        soft_max=4096,
    )

    @classmethod
    def applies(cls, context):
        if not super().applies(context):
            return False
        if context.scene.hologram.kind != DeviceKind.LIGHT_GUIDE:
            cls.poll_message_set("Only a light guide has an eyebox")
            return False
        return True

    def settings(self, context):
        clean = context.scene.hologram.render.denoise
        return {"field_samples": self.field_samples, "denoise": clean}


class HOE_OT_accuracy(DeviceJob, bpy.types.Operator):
    """Measure what accuracy costs in time."""

    bl_idname = Op.ACCURACY
    bl_label = "Measure Accuracy"
    bl_description = (
        "Measure error against time for each setting, beside your work, and write a page with "
        "pictures side by side. Of the device alone: other objects of the scene do not count"
    )

    kind = JobKind.ACCURACY
    job_label = "Accuracy"

    folder: StringProperty(
        name="Folder", description=_FOLDER, subtype="DIR_PATH", options={"SKIP_SAVE"}
    )
    budget: FloatProperty(
        name="Budget",
        description="About how long all takes together, in seconds",
        default=120.0,
        min=5.0,
        max=86400.0,
        soft_max=3600.0,
    )

    def invoke(self, context, event):
        """Ask for the budget first."""
        if bpy.app.background:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self, confirm_text="Measure")

    def settings(self, context):
        return {"budget": self.budget}


register, unregister = class_registrars((HOE_OT_eyebox, HOE_OT_accuracy))
