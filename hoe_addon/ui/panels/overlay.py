# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3-D view."""

import bpy

from ...blender.document.held import has_device
from ...blender.ids import DeviceKind
from ...blender.registration import class_registrars
from ..ids import TAB
from ..overlay import failure, state
from ..wording import in_plain_words


class HOE_PT_overlay(bpy.types.Panel):
    """Switches of the drawings over the 3-D view, and how dense they are."""

    bl_idname = "HOE_PT_overlay"
    bl_label = "Viewport"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = TAB
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 90

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if has_device(context.scene):
            return True
        return any(material.hologram.enabled for material in bpy.data.materials)

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.hologram.overlay, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        layout, switches = self.layout, context.scene.hologram.overlay
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.active = switches.show
        problem = failure.text() or state.shown(context.scene).problem
        if problem:
            row = layout.row()
            row.alert = True
            row.label(text=in_plain_words(problem), icon="ERROR")
        kind = context.scene.hologram.kind
        column = layout.column(heading="Show")
        column.prop(switches, "sources")
        if kind != DeviceKind.NONE:
            column.prop(switches, "chief_rays")
            column.prop(switches, "pupil")
        if kind == DeviceKind.LIGHT_GUIDE:
            column.prop(switches, "eyebox")
        if switches.sources:
            layout.prop(switches, "rays")
        if switches.chief_rays and kind != DeviceKind.NONE:
            layout.prop(switches, "corners")
            column = layout.column(align=True)
            column.prop(switches, "lowest_order")
            column.prop(switches, "highest_order", text="to")


register, unregister = class_registrars((HOE_PT_overlay,))
