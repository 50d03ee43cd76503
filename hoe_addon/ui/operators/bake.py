# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The map or the table that the hologram shown needs, made beside the window."""

import bpy

from ...blender.job_files import JobKind
from ...blender.registration import class_registrars
from ..context import shown_hologram, why_not_editable
from ..ids import Op
from ..jobs.launch import launch
from ..jobs.starting import JobOperator


class HOE_OT_bake_table(JobOperator, bpy.types.Operator):
    """Make the table or the map of the hologram shown."""

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
        words = why_not_editable(context)
        if words:
            cls.poll_message_set(words)
        return not words

    def start(self, context):
        settings = {"material": shown_hologram(context).name}
        return launch(self.kind, self.job_label, context.scene, settings=settings)


register, unregister = class_registrars((HOE_OT_bake_table,))
