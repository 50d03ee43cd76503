# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram of the active material: what it is, its shape, its orders, and its text."""

import bpy

from ...blender.ids import EfficiencyModel, PatternKind, Shape, WaveKind
from ..context import shown_hologram, shown_material
from ..facts.device import Line
from ..facts.material import FACTS
from ..ids import Op
from ..wording import is_question, part_of
from .base import (
    MATERIAL,
    SIDEBAR,
    Body,
    panel_registrars,
    split_layout,
    with_unit,
    wrapped,
)
from .medium import draw_medium
from .problems import draw_part, draw_problem, problem_of
from .tables import numbers

_SHAPE_FIELDS = {
    Shape.PLANE: ("size_mm", "outline"),
    Shape.SPHERE: ("curved_size_mm", "curved_outline", "radius_mm"),
    Shape.CYLINDER: ("curved_size_mm", "curved_outline", "radius_mm", "axis"),
    Shape.CONIC: ("curved_size_mm", "curved_outline", "radius_mm", "conic"),
    Shape.ASPHERE: ("curved_size_mm", "curved_outline", "radius_mm", "conic"),
}


AWAITED = (Line("", ""),) * 3
"""Keeps the place of lines that are worked out in a moment, so that nothing jumps."""


class NoHologram(Body):
    """How the active material becomes a hologram; below what other materials need more often."""

    name = "no_hologram"
    bl_label = "Hologram"
    bl_order = 115

    @classmethod
    def poll(cls, context):
        if shown_hologram(context) is not None:
            return False
        item = context.object
        return shown_material(context) is not None or (item is not None and item.type == "MESH")

    def draw(self, context):
        wrapped(self.layout, context, "The active material is no hologram yet.")
        self.layout.operator(Op.MAKE_HOLOGRAM, icon="ADD")
        self.layout.operator(Op.IMPORT_HOLOGRAM, icon="IMPORT")


class Hologram(Body):
    """The hologram of the active material, and what it does."""

    name = "hologram"
    bl_label = "Hologram"
    bl_order = 15

    @classmethod
    def poll(cls, context):
        return shown_hologram(context) is not None

    def draw(self, context):
        layout, material = split_layout(self.layout), shown_hologram(context)
        row = layout.row(align=True)
        row.prop(material, "name", text="", icon="MATERIAL")
        row.operator(Op.IMPORT_HOLOGRAM, text="", icon="IMPORT")
        row.operator(Op.EXPORT_HOLOGRAM, text="", icon="EXPORT")
        words = problem_of(material)
        part = part_of(words)
        if part:
            label = layout.row()
            label.alert = not is_question(words)
            kind, icon = ("Problem", "ERROR") if label.alert else ("To be chosen", "INFO")
            label.label(text=f"{kind} below, in {part}", icon=icon)
        else:
            draw_problem(layout, context, material)
        facts = FACTS.shown(material)
        numbers(layout, AWAITED if facts is None else facts.grating)
        if facts is not None and facts.place:
            wrapped(layout, context, facts.place, "INFO")


class OfHologram(Body):
    """Common part of the panels of a hologram."""

    parent = Hologram
    holds: str = ""

    @classmethod
    def poll(cls, context):
        return shown_hologram(context) is not None

    def draw_header(self, context):
        """Mark the panel in which something is wrong."""
        material = shown_hologram(context)
        if material is not None and part_of(problem_of(material)) == self.bl_label:
            self.layout.label(text="", icon="ERROR")


class Element(OfHologram):
    """Shape, size and surroundings."""

    name = "hologram_element"
    bl_label = "Element"
    bl_order = 4

    def draw(self, context):
        layout, material = split_layout(self.layout), shown_hologram(context)
        hologram = material.hologram
        draw_part(layout, context, material, "surface", "media", "frame")
        surface = hologram.surface
        layout.prop(surface, "shape")
        if surface.shape == Shape.MESH:
            draw_mesh(layout, surface)
        column = layout.column()
        for field in _SHAPE_FIELDS.get(Shape(surface.shape), ()):
            with_unit(column, surface, field)
        draw_medium(layout, hologram.media.front, "In Front")
        draw_medium(layout, hologram.media.back, "Behind")


class Orders(OfHologram):
    """The orders that are traced."""

    name = "hologram_orders"
    bl_label = "Orders"
    bl_order = 3

    def draw(self, context):
        layout, material = split_layout(self.layout), shown_hologram(context)
        draw_part(layout, context, material, "orders")
        column = layout.column(align=True)
        for place, entry in enumerate(material.hologram.orders):
            row = column.row(align=True)
            row.prop(entry, "order", text="Order" if place == 0 else " ")
            row.operator(Op.REMOVE_ORDER, text="", icon="REMOVE").index = place
        layout.operator(Op.ADD_ORDER, icon="ADD")


class Document(OfHologram):
    """What has no slider: the texts behind, and where the recording lies in the object."""

    name = "hologram_document"
    bl_label = "Advanced"
    bl_order = 5

    def draw(self, context):
        layout, hologram = split_layout(self.layout), shown_hologram(context).hologram
        for owner, field, label in _texts(hologram):
            layout.prop(owner, field, text=label)
        column = layout.column()
        column.prop(hologram.frame, "origin", text="Frame Origin")
        column.prop(hologram.frame, "x")
        column.prop(hologram.frame, "y")
        layout.prop(hologram, "units_per_mm")


def _texts(hologram):
    """The texts that apply."""
    if hologram.surface.shape != Shape.PLANE:
        yield hologram.surface, "details", "Surface"
    if hologram.pattern == PatternKind.CHARACTERISTIC:
        yield hologram.characteristic, "details", "Function"
    else:
        for role in ("object", "reference"):
            wave = getattr(hologram.recording, role)
            if wave.kind not in (WaveKind.PLANE, WaveKind.POINT):
                yield wave, "details", f"{role.capitalize()} Wave"
    model = EfficiencyModel(hologram.efficiency.model)
    if model != EfficiencyModel.CONSTANT:
        yield hologram.efficiency, f"{model}_details", model.label
    yield hologram.efficiency, "common_details", "Haze and Table"


def draw_mesh(layout: bpy.types.UILayout, surface: bpy.types.PropertyGroup) -> None:
    """Lay out a surface that is a mesh: its file, where it has one.

    Args:
        layout: Where.
        surface: The surface.
    """
    if surface.mesh_file or not surface.details:
        layout.prop(surface, "mesh_file")
    else:
        layout.label(text="The mesh is kept in the document", icon="MESH_DATA")


register, unregister = panel_registrars(
    (SIDEBAR, *MATERIAL), (NoHologram, Hologram, Element, Orders, Document)
)
