# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms from and to JSON documents."""

import bpy

from ...blender.document.hologram_files import export_hologram, import_hologram
from ...blender.registration import class_registrars
from ..context import shown_hologram, shown_material
from ..ids import Op
from ..telling import tells
from .json_files import JsonExport, JsonImport


class HOE_OT_import_hologram(JsonImport, bpy.types.Operator):
    """Make the active material the hologram of a JSON document."""

    bl_idname = Op.IMPORT_HOLOGRAM
    bl_label = "Import Hologram"
    bl_description = "Make the active material the hologram of a JSON document"

    @classmethod
    def poll(cls, context):
        if shown_material(context) is None:
            cls.poll_message_set("Give the active object a material first")
            return False
        return True

    @tells
    def execute(self, context):
        problem = import_hologram(shown_material(context), self.path)
        if problem:
            self.report({"WARNING"}, f"{self.path.name}: read, but {problem}")
        else:
            self.report({"INFO"}, f"{self.path.name}: read")
        return {"FINISHED"}


class HOE_OT_export_hologram(JsonExport, bpy.types.Operator):
    """Write the hologram of the active material as a JSON document."""

    bl_idname = Op.EXPORT_HOLOGRAM
    bl_label = "Export Hologram"
    bl_description = "Write this hologram as a JSON document; lengths are in mm"

    @classmethod
    def poll(cls, context):
        if shown_hologram(context) is None:
            cls.poll_message_set("Select an object whose active material is a hologram")
            return False
        return True

    def suggested(self, context):
        return shown_hologram(context).name

    @tells
    def execute(self, context):
        export_hologram(shown_hologram(context), self.path)
        self.report({"INFO"}, f"{self.path.name}: written")
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_import_hologram, HOE_OT_export_hologram))
