# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The button of the banner."""

import bpy
from bpy.props import StringProperty

from ...blender.readiness import mend, troubles
from ...blender.registration import class_registrars
from ..facts.cache import redraw
from ..ids import Op
from ..telling import tells


class HOE_OT_mend(bpy.types.Operator):
    """Mend what the banner tells."""

    bl_idname = Op.MEND
    bl_label = "Mend"
    bl_description = "Set what is told here to what holograms need"
    bl_options = {"REGISTER", "UNDO"}

    mend: StringProperty(
        name="What", description="What is mended; empty for the first trouble that can be"
    )

    @classmethod
    def poll(cls, context):
        if not any(trouble.mend is not None for trouble in troubles(context.scene)):
            cls.poll_message_set("There is nothing to mend in this scene")
            return False
        return True

    @tells
    def execute(self, context):
        scene = context.scene
        known = [trouble for trouble in troubles(scene) if trouble.mend is not None]
        asked = [trouble for trouble in known if self.mend in ("", trouble.mend)]
        if not asked:
            self.report({"ERROR"}, f"{self.mend}: is no trouble of this scene any more")
            return {"CANCELLED"}
        mend(scene, asked[0])
        redraw()
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_mend,))
