# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of a device: its eyebox, and what accuracy costs."""

import bpy

from ...blender.document.held import has_device
from ...blender.ids import DeviceKind
from ..facts.scenes import DEVICE_FACTS
from ..facts.study import EyeboxFacts, accuracy_of, eyebox_of
from ..ids import Op
from .base import SCENE, SIDEBAR, Body, panel_registrars, split_layout, with_unit, wrapped
from .progress import draw_progress
from .tables import numbers


class Study(Body):
    """Head of the studies; shows the one that runs."""

    name = "study"
    bl_label = "Study"
    bl_order = 40
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_device(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        draw_progress(self.layout, context)


class EyeboxStudy(Body):
    """The device from a grid of pupils."""

    name = "study_eyebox"
    bl_label = "Eyebox"
    parent = Study

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.hologram.kind == DeviceKind.LIGHT_GUIDE

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = split_layout(self.layout), context.scene
        column = layout.column(align=True)
        column.prop(scene.hologram.eyebox, "grid")
        with_unit(column, scene.hologram.eyebox, "pitch_mm")
        layout.operator(Op.EYEBOX, text="Look from All Positions", icon="LIGHTPROBE_VOLUME")
        facts = eyebox_of(scene)
        if facts is not None:
            _draw_eyebox(layout, context, facts)


def _draw_eyebox(
    layout: bpy.types.UILayout, context: bpy.types.Context, facts: EyeboxFacts
) -> None:
    _draw_age(layout, context, facts.digest, "White display, no other light:")
    numbers(layout, facts.lines)
    if facts.rows:
        wrapped(layout, context, "Mean luminance in cd/m², as the eye moves:")
        grid = layout.box().column(align=True)
        for row in facts.rows:
            cells = grid.row(align=True)
            for text in row:
                cell = cells.row()
                cell.alignment = "CENTER"
                cell.label(text=text)
    wrapped(layout, context, facts.folder, "FILE_FOLDER")


class AccuracyStudy(Body):
    """Error against time."""

    name = "study_accuracy"
    bl_label = "Accuracy"
    parent = Study

    def draw(self, context: bpy.types.Context) -> None:
        layout = split_layout(self.layout)
        wrapped(layout, context, "What each setting costs in time, and what it changes.")
        layout.operator(Op.ACCURACY, text="Measure Accuracy", icon="DRIVER_DISTANCE")
        result = accuracy_of(context.scene)
        if result is not None:
            _draw_age(layout, context, result.digest, result.words)
            wrapped(layout, context, result.page, "FILE_FOLDER")


def _draw_age(
    layout: bpy.types.UILayout, context: bpy.types.Context, digest: str, words: str
) -> None:
    """Say whether a result is that of the device as it is now."""
    facts = DEVICE_FACTS.shown(context.scene)
    if facts is not None and facts.digest not in ("", digest):
        wrapped(layout, context, "The device has changed since the last result.", "INFO")
    wrapped(layout, context, f"Last result. {words}")


register, unregister = panel_registrars((SIDEBAR, SCENE), (Study, EyeboxStudy, AccuracyStudy))
