# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The map or the table that the active hologram needs, made beside the window."""

import bpy

from ...blender.job_files import JobKind
from ...blender.registration import class_registrars
from ..ids import Op
from ..jobs.launch import launch
from ..jobs.starting import JobOperator


class HOE_OT_bake_table(JobOperator, bpy.types.Operator):
    """Make the table or the map of the active hologram."""

    bl_idname = Op.BAKE_TABLE
    bl_label = "Bake"
    bl_description = (
        "Make the table of efficiencies, or the map of the pattern, that this hologram needs; it "
        "takes seconds to minutes, beside your work"
    )

    kind = JobKind.BAKE
    job_label = "Bake"

    @classmethod
    def applies(cls, context):
        active = context.active_object
        material = active.active_material if active is not None else None
        if material is None or not material.hologram.enabled:
            cls.poll_message_set("Select an object whose active material is a hologram")
            return False
        return True

    def start(self, context):
        material = context.active_object.active_material
        settings = {"material": material.name}
        return launch(self.kind, self.job_label, context.scene, settings=settings)


register, unregister = class_registrars((HOE_OT_bake_table,))
