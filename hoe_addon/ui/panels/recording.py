# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is recorded: two waves and a wavelength, or a characteristic function."""

import bpy

from ...blender.ids import CharacteristicKind, PatternKind, WaveKind
from ...blender.props.wave_fields import SourceShape
from ..context import shown_hologram
from ..ids import Op
from .base import MATERIAL, SIDEBAR, panel_registrars, split_layout, with_unit, wrapped
from .hologram import OfHologram
from .problems import draw_part, is_about, problem_of

_FUNCTION_FIELDS = {
    CharacteristicKind.LINEAR: ("lines_per_mm", "azimuth_deg"),
    CharacteristicKind.RADIAL: ("lines_per_mm",),
    CharacteristicKind.EVEN_RADIAL: ("coefficients", "normalization_mm", "unit"),
    CharacteristicKind.POLYNOMIAL: ("normalization_mm", "unit"),
    CharacteristicKind.ZERNIKE: ("zernike_order", "normalization_mm", "unit"),
    CharacteristicKind.SPLINE: ("unit",),
    CharacteristicKind.FORMULA: ("formula", "unit"),
    CharacteristicKind.SAMPLED: ("file", "grid_size_mm", "unit"),
}
_IN_TEXT = {
    CharacteristicKind.POLYNOMIAL: "Its terms are in Advanced, or imported.",
    CharacteristicKind.ZERNIKE: "Its coefficients are in Advanced, or imported.",
    CharacteristicKind.SPLINE: "Its coefficients are in Advanced, or imported.",
}
_SHAPE_FIELDS = {
    SourceShape.DISC: ("source_diameter_mm",),
    SourceShape.RECTANGLE: ("source_size_mm",),
    SourceShape.LINE: ("source_length_mm",),
}
_WAVE_FIELDS = {
    WaveKind.PLANE: ("direction", "index"),
    WaveKind.POINT: ("position_mm", "beam", "index"),
    WaveKind.WINDOW: (
        "own_position_mm",
        "own_beam",
        "source_index",
        "window_position_mm",
        "window_normal",
        "window_thickness_mm",
        "window_index",
        "own_index",
    ),
    WaveKind.ASTIGMATIC: ("first_mm", "second_mm", "line_direction", "own_beam", "own_index"),
    WaveKind.EXTENDED: ("own_position_mm", "source_normal", "own_beam", "own_index"),
}
_FROM_OBJECT = ("direction", "position_mm")
"""Fields that an object takes the place of."""


class Recording(OfHologram):
    """How the hologram was recorded."""

    name = "hologram_recording"
    bl_label = "Recording"
    bl_order = 1

    def draw(self, context):
        layout, material = split_layout(self.layout), shown_hologram(context)
        hologram = material.hologram
        layout.prop(hologram, "pattern")
        if hologram.pattern == PatternKind.CHARACTERISTIC:
            draw_part(layout, context, material, "characteristic")
            _draw_function(layout, context, hologram.characteristic)
            return
        recording = hologram.recording
        _draw_wavelength(layout, recording)
        draw_part(layout, context, material, "recording.wavelength_nm")
        for role, label in (("object", "Object Wave"), ("reference", "Reference Wave")):
            box = layout.box()
            box.label(text=label, icon="LIGHT_POINT" if role == "object" else "LIGHT_SUN")
            _draw_wave(box, context, material, role)


def _draw_wavelength(layout: bpy.types.UILayout, recording: bpy.types.PropertyGroup) -> None:
    row = layout.row(align=True)
    with_unit(row, recording, "wavelength_nm", "Wavelength")
    swatch = row.row()
    swatch.ui_units_x = 1.5
    swatch.prop(recording, "colour", text="")


def _draw_function(
    layout: bpy.types.UILayout, context: bpy.types.Context, function: bpy.types.PropertyGroup
) -> None:
    kind = CharacteristicKind(function.kind)
    layout.prop(function, "kind")
    with_unit(layout, function, "wavelength_nm", "Wavelength")
    column = layout.column()
    for field in _FUNCTION_FIELDS[kind]:
        with_unit(column, function, field)
    if kind in _IN_TEXT:
        wrapped(layout, context, _IN_TEXT[kind], "INFO")


def _draw_wave(
    layout: bpy.types.UILayout,
    context: bpy.types.Context,
    material: bpy.types.Material,
    role: str,
) -> None:
    wave, path = getattr(material.hologram.recording, role), f"recording.{role}"
    kind = WaveKind(wave.kind)
    draw_part(layout, context, material, path)
    layout.prop(wave, "kind", text="Kind")
    if kind == WaveKind.SYSTEM:
        wrapped(layout, context, "Its lenses are in Advanced, or imported.", "INFO")
        return
    row = layout.row(align=True, heading="Follow")
    row.alert = is_about(problem_of(material), f"{path}.target")
    row.prop(wave, "follows", text="")
    if wave.follows:
        row.prop(wave, "target", text="")
    text = "" if wave.follows else "Use Selected"
    row.operator(Op.SOURCE_FROM_SELECTION, text=text, icon="EMPTY_AXIS").role = role
    if kind == WaveKind.EXTENDED:
        column = layout.column()
        column.prop(wave, "source_shape")
        for field in _SHAPE_FIELDS.get(SourceShape(wave.source_shape), ()):
            with_unit(column, wave, field)
    column = layout.column()
    for field in _WAVE_FIELDS[kind]:
        if not (wave.follows and field in _FROM_OBJECT):
            with_unit(column, wave, field)


register, unregister = panel_registrars((SIDEBAR, *MATERIAL), (Recording,))
