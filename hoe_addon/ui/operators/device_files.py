# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole devices from and to JSON documents."""

import bpy

from ...blender.add.presets import add_scene
from ...blender.document.held import document_of, has_device
from ...blender.registration import class_registrars
from ...files import write_text
from ...model.document import dump
from ..ids import Op
from ..telling import tells
from .json_files import JsonExport, JsonImport


class HOE_OT_import_device(JsonImport, bpy.types.Operator):
    """Open a device from a JSON document."""

    bl_idname = Op.IMPORT_DEVICE
    bl_label = "Import Device"
    bl_description = "Open a device from a JSON document, as a further scene of this file"

    @tells
    def execute(self, context):
        scene = add_scene(self.path)
        if context.window is not None:
            context.window.scene = scene
        name, title = self.path.name, scene.hologram.title
        self.report({"INFO"}, f"{name}: {title}, in the scene {scene.name}")
        return {"FINISHED"}


class HOE_OT_export_device(JsonExport, bpy.types.Operator):
    """Write the device of a scene as a JSON document."""

    bl_idname = Op.EXPORT_DEVICE
    bl_label = "Export Device"
    bl_description = "Write the device of this scene as a JSON document; lengths are in mm"

    @classmethod
    def poll(cls, context):
        if context.scene is None or not has_device(context.scene):
            cls.poll_message_set("This scene holds no device; add one with Add > Hologram")
            return False
        return True

    def suggested(self, context):
        return context.scene.hologram.short_name or "device"

    @tells
    def execute(self, context):
        write_text(self.path, (dump(document_of(context.scene)),))
        self.report({"INFO"}, f"{self.path.name}: written")
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_import_device, HOE_OT_export_device))
