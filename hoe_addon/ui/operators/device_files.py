# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole devices from and to JSON documents."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ...blender.add.presets import add_scene
from ...blender.document.held import document_of, has_device
from ...blender.registration import class_registrars
from ...core.errors import HoeError
from ...files import write_text
from ...model.document import dump
from ..ids import Op

_JSON = "*.json"


class HOE_OT_import_device(bpy.types.Operator, ImportHelper):
    """Open a device from a JSON document."""

    bl_idname = Op.IMPORT_DEVICE
    bl_label = "Import Device"
    bl_description = "Open a device from a JSON document, as a further scene of this file"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default=_JSON, options={"HIDDEN"})

    def execute(self, context):
        path = Path(self.filepath)
        try:
            scene = add_scene(path)
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if context.window is not None:
            context.window.scene = scene
        self.report({"INFO"}, f"{path.name}: {scene.hologram.title}, in the scene {scene.name}")
        return {"FINISHED"}


class HOE_OT_export_device(bpy.types.Operator, ExportHelper):
    """Write the device of a scene as a JSON document."""

    bl_idname = Op.EXPORT_DEVICE
    bl_label = "Export Device"
    bl_description = "Write the device of this scene as a JSON document; lengths are in mm"
    bl_options = {"REGISTER"}

    filename_ext = ".json"
    filter_glob: StringProperty(default=_JSON, options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        if context.scene is None or not has_device(context.scene):
            cls.poll_message_set("This scene holds no device; add one with Add > Hologram")
            return False
        return True

    def invoke(self, context, event):
        """Suggest the device's own name."""
        if not self.filepath:
            self.filepath = f"{context.scene.hologram.short_name or 'device'}.json"
        return super().invoke(context, event)

    def execute(self, context):
        try:
            write_text(Path(self.filepath), (dump(document_of(context.scene)),))
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{Path(self.filepath).name}: written")
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_import_device, HOE_OT_export_device))
