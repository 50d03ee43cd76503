# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture through the device: how good, in which colours, and the button."""

import bpy

from ...blender.document.held import has_device
from ...blender.ids import Goal
from ...model.methods import QUALITY_ERRORS
from ..ids import Op
from .base import RENDER, SIDEBAR, Body, panel_registrars, split_layout, with_unit
from .progress import draw_progress


class Render(Body):
    """When the render ends, and the button that starts it."""

    name = "render"
    bl_label = "Render"
    bl_order = 20

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_device(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = split_layout(self.layout), context.scene
        render = scene.hologram.render
        _draw_goal(layout, scene)
        layout.prop(render, "denoise")
        column = layout.column(align=True)
        column.prop(scene.render, "resolution_x", text="Picture X")
        column.prop(scene.render, "resolution_y", text="Y")
        column.prop(scene.render, "resolution_percentage", text="%")
        if not draw_progress(layout, context):
            row = layout.row()
            row.scale_y = 1.4
            row.operator(Op.RENDER, text="Render through the Eye", icon="RENDER_STILL")


def _draw_goal(layout: bpy.types.UILayout, scene: bpy.types.Scene) -> None:
    """What ends the render: only the number of the chosen goal."""
    render = scene.hologram.render
    layout.prop(render, "goal")
    match Goal(render.goal):
        case Goal.QUALITY:
            layout.prop(render, "quality")
            _draw_error(layout, QUALITY_ERRORS[render.quality])
        case Goal.ERROR:
            layout.prop(render, "error")
            _draw_error(layout, render.error)
            row = layout.row(heading="Or after (s)")
            row.prop(render, "ends_in_time", text="")
            time = row.row()
            time.enabled = render.ends_in_time
            time.prop(render, "seconds", text="")
        case Goal.SECONDS:
            layout.prop(render, "seconds", text="Time (s)")
        case Goal.SAMPLES:
            layout.prop(scene.cycles, "samples", text="Samples")


def _draw_error(layout: bpy.types.UILayout, error: float) -> None:
    """Say an error as people do."""
    row = layout.row()
    row.alignment = "RIGHT"
    row.active = False
    row.label(text=f"pixel error {error * 100:.3g} %")


class Colours(Body):
    """Which wavelengths the picture is made of."""

    name = "render_colours"
    bl_label = "Colours"
    parent = Render

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = split_layout(self.layout), context.scene
        render = scene.hologram.render
        layout.prop(render, "mode", text="Wavelengths")
        row = layout.row(align=True)
        with_unit(row, render, "preview_wavelength_nm", "Preview")
        swatch = row.row(align=True)
        swatch.ui_units_x = 1.5
        swatch.prop(render, "preview_colour", text="")
        with_unit(layout, render, "luminance_per_unit_cd_m2", "Value 1 is")
        layout.prop(scene.view_settings, "exposure")


class Paths(Body):
    """How paths are drawn; for engineers."""

    name = "render_paths"
    bl_label = "Paths"
    parent = Render

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = split_layout(self.layout), context.scene
        render = scene.hologram.render
        layout.prop(render, "method")
        layout.prop(render, "spectrum_floor")
        layout.prop(render, "max_bounces")
        layout.prop(scene.cycles, "seed")


register, unregister = panel_registrars((SIDEBAR, RENDER), (Render, Colours, Paths))
