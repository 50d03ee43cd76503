# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture through the device; and what all jobs have in common: their end, and ending them."""

import bpy
from bpy.props import StringProperty

from ...blender.job_files import JobKind
from ...blender.registration import class_registrars
from ..ids import Op
from ..jobs.current import cancel, running, take_ended
from ..jobs.ending import finish
from ..jobs.starting import DeviceJob


class HOE_OT_render(DeviceJob, bpy.types.Operator):
    """Render what the eye sees through the device."""

    bl_idname = Op.RENDER
    bl_label = "Render through the Eye"
    bl_description = (
        "Render what the eye sees through the device, beside your work, until the error, the time "
        "or the samples of the Render panel are reached. Pictures and numbers go into a new folder "
        "under renders, beside the file"
    )

    kind = JobKind.RENDER
    job_label = "Render"

    folder: StringProperty(
        name="Folder",
        description="Folder for the results; empty makes a new one, with a number, beside the file",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
    )

    def settings(self, context):
        return {"denoise": context.scene.hologram.render.denoise}


class HOE_OT_cancel(bpy.types.Operator):
    """End the job that is at work."""

    bl_idname = Op.CANCEL
    bl_label = "End the Job"
    bl_description = (
        "End the job that is at work and keep what is done; a second click ends it at once"
    )
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        if running(context) is None:
            cls.poll_message_set("No job is at work")
            return False
        return True

    def execute(self, _context):
        cancel()
        return {"FINISHED"}


class HOE_OT_job_ended(bpy.types.Operator):
    """Show and tell what came of a job; in an event, for nobody sees the reports of a timer."""

    bl_idname = Op.JOB_ENDED
    bl_label = "Result of a Job"
    bl_options = {"INTERNAL", "UNDO"}

    def invoke(self, context, _event):
        manager = context.window_manager
        self._timer = manager.event_timer_add(0.01, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        self.cancel(context)
        job = take_ended()
        return {"CANCELLED"} if job is None else finish(self, context, job)

    def cancel(self, context):
        """Blender calls this, too, when it ends the operator."""
        context.window_manager.event_timer_remove(self._timer)


register, unregister = class_registrars((HOE_OT_render, HOE_OT_cancel, HOE_OT_job_ended))
