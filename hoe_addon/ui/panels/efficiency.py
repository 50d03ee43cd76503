# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the light is shared among the orders: relief, volume, table; with a plot."""

import bpy

from ...blender.ids import EfficiencyModel, PatternKind
from ...blender.props.detail_media import Given
from ...blender.props.efficiency_fields import ReliefShape
from ...blender.props.rcwa_fields import ProfileShape
from ..context import shown_hologram
from ..facts.material import FACTS, MaterialFacts
from ..ids import Op
from .base import MATERIAL, SIDEBAR, panel_registrars, split_layout, with_unit, wrapped
from .hologram import AWAITED, OfHologram
from .medium import draw_medium
from .problems import draw_part
from .tables import numbers

_UNIT_PIXELS = 20.0
"""Height of a button at a scale of 1."""
_SMALLEST_PLOT, _LARGEST_PLOT = 8.0, 15.0
_PROFILE_FIELDS = {
    ProfileShape.BINARY: ("profile_depth_um", "profile_duty"),
    ProfileShape.SAWTOOTH: ("profile_depth_um",),
    ProfileShape.SINUSOID: ("profile_depth_um",),
    ProfileShape.TRIANGLE: ("profile_depth_um", "profile_peak"),
    ProfileShape.STAIRCASE: ("profile_depth_um", "profile_levels"),
    ProfileShape.SLANTED: ("profile_depth_um", "profile_duty", "profile_slant_deg"),
    ProfileShape.VOLUME: ("profile_thickness_um", "profile_modulation", "profile_slant_deg"),
}
_IN_TEXT = (ProfileShape.POLYGON, ProfileShape.SAMPLED, ProfileShape.LAYERS)


class Efficiency(OfHologram):
    """The efficiency model and what it gives."""

    name = "hologram_efficiency"
    bl_label = "Efficiency"
    bl_order = 2

    def draw(self, context):
        layout, material = split_layout(self.layout), shown_hologram(context)
        efficiency = material.hologram.efficiency
        draw_part(layout, context, material, "efficiency")
        layout.prop(efficiency, "model")
        match EfficiencyModel(efficiency.model):
            case EfficiencyModel.KINOFORM:
                _draw_kinoform(layout, efficiency)
            case EfficiencyModel.CONSTANT:
                _draw_shares(layout, efficiency)
            case EfficiencyModel.KOGELNIK:
                _draw_volume(layout, material.hologram)
            case EfficiencyModel.RCWA:
                _draw_profile(layout, context, efficiency)
            case EfficiencyModel.TABLE:
                layout.prop(efficiency, "table_file")
                layout.prop(efficiency, "table_has_beyond")
                if efficiency.table_has_beyond:
                    layout.prop(efficiency, "table_beyond")
        facts = FACTS.shown(material)
        _draw_facts(layout, context, facts)
        _draw_more(layout, efficiency)
        layout.operator(Op.CHECK, icon="CHECKMARK")
        if facts is not None and facts.check is not None:
            for warning in facts.check.warnings:
                wrapped(layout, context, warning, "ERROR")
            if not facts.check.warnings:
                layout.label(text="All its assumptions hold", icon="CHECKMARK")


def _draw_kinoform(layout: bpy.types.UILayout, efficiency: bpy.types.PropertyGroup) -> None:
    layout.prop(efficiency, "relief_shape")
    column = layout.column()
    match ReliefShape(efficiency.relief_shape):
        case ReliefShape.SAWTOOTH:
            column.prop(efficiency, "levels")
        case ReliefShape.BINARY:
            column.prop(efficiency, "relief_duty")
        case ReliefShape.TRIANGLE:
            column.prop(efficiency, "relief_peak")
    with_unit(column, efficiency, "design_wavelength_nm", "Design")
    column.prop(efficiency, "relief_depth_waves", text="Depth (waves)")
    draw_medium(layout, efficiency.relief, "Relief")
    column = layout.column()
    column.prop(efficiency, "relief_depth_error")
    if efficiency.relief_shape in (ReliefShape.SAWTOOTH, ReliefShape.BINARY):
        column.prop(efficiency, "relief_edge_width")
    layout.prop(efficiency, "relief_angle_dependent", text="Follows Angle")


def _draw_shares(layout: bpy.types.UILayout, efficiency: bpy.types.PropertyGroup) -> None:
    column = layout.column(align=True)
    column.use_property_split = False
    for place, entry in enumerate(efficiency.shares):
        row = column.row(align=True)
        number = row.row(align=True)
        number.ui_units_x = 2.5
        number.prop(entry, "order", text="")
        row.prop(entry, "side", text="")
        row.prop(entry, "share", text="", slider=True)
        row.operator(Op.REMOVE_SHARE, text="", icon="REMOVE").index = place
    layout.operator(Op.ADD_SHARE, icon="ADD")


def _draw_volume(layout: bpy.types.UILayout, hologram: bpy.types.PropertyGroup) -> None:
    efficiency = hologram.efficiency
    for name in ("thickness", "modulation"):
        row = layout.row(align=True)
        unit = "_um" if name == "thickness" else ""
        formula = getattr(efficiency, f"volume_{name}_varies")
        with_unit(row, efficiency, f"volume_{name}_formula" if formula else f"volume_{name}{unit}")
        row.prop(efficiency, f"volume_{name}_varies", text="", icon="DRIVER")
    _draw_text_medium(layout, efficiency, "volume_index_kind", "volume_index", "volume_index_name")
    column = layout.column()
    for field in ("volume_shrinkage", "volume_index_shift", "volume_absorption_per_mm"):
        with_unit(column, efficiency, field)
    if hologram.pattern == PatternKind.CHARACTERISTIC:
        column.prop(efficiency, "volume_is_slanted")
        if efficiency.volume_is_slanted:
            with_unit(column, efficiency, "volume_normal_period_um")


def _draw_profile(
    layout: bpy.types.UILayout, context: bpy.types.Context, efficiency: bpy.types.PropertyGroup
) -> None:
    shape = ProfileShape(efficiency.profile_shape)
    layout.prop(efficiency, "profile_shape")
    if shape in _IN_TEXT:
        wrapped(layout, context, "Its numbers are in Advanced, or imported.", "INFO")
    column = layout.column()
    for field in _PROFILE_FIELDS.get(shape, ()):
        with_unit(column, efficiency, field)
    if shape == ProfileShape.VOLUME:
        _draw_text_medium(
            layout, efficiency, "profile_index_kind", "profile_index", "profile_index_name"
        )
    elif shape != ProfileShape.LAYERS:
        for name in ("ridge", "groove"):
            _draw_text_medium(layout, efficiency, f"{name}_kind", f"{name}_index", f"{name}_name")
    column = layout.column()
    column.prop(efficiency, "lookup_tolerance")
    with_unit(column, efficiency, "lookup_angle_deg")


def _draw_text_medium(
    layout: bpy.types.UILayout,
    efficiency: bpy.types.PropertyGroup,
    kind: str,
    index: str,
    name: str,
) -> None:
    """A medium that is kept in a text."""
    column = layout.column()
    column.prop(efficiency, kind)
    match Given(getattr(efficiency, kind)):
        case Given.CONSTANT:
            column.prop(efficiency, index)
        case Given.CATALOGUE:
            column.prop(efficiency, name)


def _draw_more(layout: bpy.types.UILayout, efficiency: bpy.types.PropertyGroup) -> None:
    layout.prop(efficiency, "total_internal_reflection", text="Total Reflection")
    layout.prop(efficiency, "has_haze")
    if efficiency.has_haze:
        column = layout.column()
        with_unit(column, efficiency, "haze_width_deg")
        rough = efficiency.haze_is_rough
        column.prop(efficiency, "haze_is_rough")
        with_unit(column, efficiency, "haze_roughness_nm" if rough else "haze_share")


def _draw_facts(
    layout: bpy.types.UILayout, context: bpy.types.Context, facts: MaterialFacts | None
) -> None:
    if facts is None or facts.plot:
        layout.template_icon(0 if facts is None else facts.plot, scale=_plot_scale(context))
    if facts is not None and facts.without_plot:
        wrapped(layout, context, facts.without_plot, "INFO")
    numbers(layout, AWAITED if facts is None else facts.efficiency)
    if facts is not None and facts.place:
        wrapped(layout, context, facts.place, "INFO")


def _plot_scale(context: bpy.types.Context) -> float:
    region = context.region
    if region is None:
        return _SMALLEST_PLOT
    units = region.width / (_UNIT_PIXELS * context.preferences.system.ui_scale)
    return min(_LARGEST_PLOT, max(_SMALLEST_PLOT, units - 3.0))


register, unregister = panel_registrars((SIDEBAR, *MATERIAL), (Efficiency,))
