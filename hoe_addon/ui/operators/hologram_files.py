# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms from and to JSON documents."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ...blender.document.hologram_files import export_hologram, import_hologram
from ...blender.registration import class_registrars
from ...core.errors import HoeError
from ..ids import Op
from ..panels.base import shown_hologram, shown_material

_JSON = "*.json"


class HOE_OT_import_hologram(bpy.types.Operator, ImportHelper):
    """Make the active material the hologram of a JSON document."""

    bl_idname = Op.IMPORT_HOLOGRAM
    bl_label = "Import Hologram"
    bl_description = "Make the active material the hologram of a JSON document"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default=_JSON, options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        if shown_material(context) is None:
            cls.poll_message_set("Give the active object a material first")
            return False
        return True

    def execute(self, context):
        path = Path(self.filepath)
        try:
            problem = import_hologram(shown_material(context), path)
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if problem:
            self.report({"WARNING"}, f"{path.name}: read, but {problem}")
        else:
            self.report({"INFO"}, f"{path.name}: read")
        return {"FINISHED"}


class HOE_OT_export_hologram(bpy.types.Operator, ExportHelper):
    """Write the hologram of the active material as a JSON document."""

    bl_idname = Op.EXPORT_HOLOGRAM
    bl_label = "Export Hologram"
    bl_description = "Write this hologram as a JSON document; lengths are in mm"
    bl_options = {"REGISTER"}

    filename_ext = ".json"
    filter_glob: StringProperty(default=_JSON, options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        if shown_hologram(context) is None:
            cls.poll_message_set("Select an object whose active material is a hologram")
            return False
        return True

    def invoke(self, context, event):
        """Suggest the material's own name."""
        if not self.filepath:
            self.filepath = bpy.path.clean_name(shown_hologram(context).name) + ".json"
        return super().invoke(context, event)

    def execute(self, context):
        try:
            export_hologram(shown_hologram(context), Path(self.filepath))
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{Path(self.filepath).name}: written")
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_import_hologram, HOE_OT_export_hologram))
