# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The device of a scene: display, lens, guide, holograms, eye, eyebox and room."""

from collections.abc import Callable
from typing import Any

import bpy

from ...blender.add.elements import has_eye
from ...blender.document.held import has_device
from ...blender.ids import DeviceKind, PictureKind, Primaries, Role
from ..facts.device import Line
from ..facts.scenes import DEVICE_FACTS
from ..ids import Menu, Op
from .base import SCENE, SIDEBAR, Body, panel_registrars, split_layout, with_unit, wrapped
from .medium import draw_medium
from .tables import numbers, problem


class Device(Body):
    """What the scene holds, in numbers; or how to begin."""

    name = "device"
    bl_label = "Device"
    bl_order = 10

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = split_layout(self.layout), context.scene
        if not has_device(scene):
            wrapped(layout, context, "This scene holds no device yet.")
            layout.menu(Menu.ADD, text="Add", icon="ADD")
            layout.operator(Op.IMPORT_DEVICE, icon="IMPORT")
            return
        layout.prop(scene.hologram, "title", text="", placeholder="Title")
        facts = DEVICE_FACTS.shown(scene)
        if facts is not None and facts.problem:
            problem(layout, context, facts.problem)
        numbers(layout, awaited(scene) if facts is None else facts.lines)
        if facts is not None and facts.enlargement != 1.0:
            row = layout.row()
            row.label(text=f"Stands here {facts.enlargement:.3g} times its true size")
            row.operator(Op.TRUE_SIZE, text="True Size")
        row = layout.row(align=True)
        if has_eye(scene):
            row.operator(Op.LOOK_THROUGH_EYE, text="Look through the Eye", icon="HIDE_OFF")
        else:
            wrapped(layout, context, "This scene has no eye yet.", "INFO")
            row = layout.row(align=True)
            row.operator(Op.ADD_EYE, text="Add Eye", icon="ADD")
        row.operator(Op.EXPORT_DEVICE, text="", icon="EXPORT")


def awaited(scene: bpy.types.Scene) -> tuple[Line, ...]:
    """Keep the place of numbers that are worked out in a moment.

    Blender lays the panels below one that grows out anew only a redraw later: until then they would
    be drawn over it.

    Args:
        scene: A scene with a device.

    Returns:
        As many empty lines as the facts have.
    """
    if not has_eye(scene):
        return ()
    return (Line("", ""),) * (7 if scene.hologram.kind == DeviceKind.LIGHT_GUIDE else 4)


def _marked(*paths: str) -> Callable[[Any, bpy.types.Context], None]:
    """A header that shows, of a closed panel too, that what is wrong is in it."""

    def draw_header(self: Any, context: bpy.types.Context) -> None:
        facts = DEVICE_FACTS.shown(context.scene)
        if facts is not None and facts.problem.startswith(paths):
            self.layout.label(text="", icon="ERROR")

    return draw_header


class _OfGuide(Body):
    """Common part of what only light guides have."""

    parent = Device

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.hologram.kind == DeviceKind.LIGHT_GUIDE


class Display(_OfGuide):
    """The picture that the light engine shows."""

    name = "device_display"
    bl_label = "Display"
    draw_header = _marked("display.")

    def draw(self, context: bpy.types.Context) -> None:
        draw_display(split_layout(self.layout), context.scene.hologram.engine.display)


class Lens(_OfGuide):
    """The collimating lens."""

    name = "device_lens"
    bl_label = "Lens"
    draw_header = _marked("lens.", "source.")

    def draw(self, context: bpy.types.Context) -> None:
        layout, held = split_layout(self.layout), context.scene.hologram
        layout.prop_search(held.engine, "patch", held, "patches", icon="MOD_UVPROJECT")
        column = layout.column(align=True)
        for field in ("focal_length_mm", "diameter_mm", "distance_mm"):
            with_unit(column, held.engine, field)


class Guide(_OfGuide):
    """The plate."""

    name = "device_guide"
    bl_label = "Plate"
    draw_header = _marked("guide.")

    def draw(self, context: bpy.types.Context) -> None:
        layout, guide = split_layout(self.layout), context.scene.hologram.guide
        draw_medium(layout, guide.medium, "Medium")
        column = layout.column(align=True)
        for field in ("thickness_mm", "size_mm", "center_mm", "relief_mm"):
            with_unit(column, guide, field)
        draw_medium(layout, guide.outside, "Around It")


class Holograms(_OfGuide):
    """The holograms on the plate; the one that is chosen is the active material."""

    name = "device_holograms"
    bl_label = "Holograms on the Plate"
    draw_header = _marked("holograms")

    def draw(self, context: bpy.types.Context) -> None:
        layout, held = split_layout(self.layout), context.scene.hologram
        row = layout.row()
        row.template_list("HOE_UL_patches", "", held, "patches", held, "active_patch", rows=3)
        buttons = row.column(align=True)
        buttons.operator_menu_enum(Op.ADD_PATCH, "purpose", text="", icon="ADD")
        buttons.operator(Op.REMOVE_PATCH, text="", icon="REMOVE")
        if held.active_patch < len(held.patches):
            patch = held.patches[held.active_patch]
            column = layout.column()
            column.prop(patch, "face")
            with_unit(column, patch, "center_mm")
            with_unit(column, patch, "size_mm")


class Element(Body):
    """The part of a scene that is selected, if it has properties of its own."""

    name = "device_element"
    bl_label = "Selected Element"
    parent = Device

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        item = context.object
        return item is not None and item.hologram.role in (Role.DISPLAY, Role.LAMP, Role.CARD)

    def draw(self, context: bpy.types.Context) -> None:
        layout, item = split_layout(self.layout), context.object
        element = item.hologram
        role = Role(element.role)
        layout.label(text=f"{item.name} ({role.label})", icon="OBJECT_DATA")
        match role:
            case Role.DISPLAY:
                draw_display(layout, element.display)
            case Role.LAMP:
                with_unit(layout, element, "size_mm")
                with_unit(layout, element, "luminance_cd_m2")
            case Role.CARD:
                _draw_picture(layout, element)
                with_unit(layout, element, "size_mm")


class Eye(Body):
    """The eye that looks."""

    name = "device_eye"
    bl_label = "Eye"
    parent = Device
    draw_header = _marked("eye.")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_device(context.scene) and has_eye(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        layout, eye = split_layout(self.layout), context.scene.hologram.eye
        layout.prop(eye, "camera", text="Camera")
        with_unit(layout, eye, "pupil_diameter_mm")
        with_unit(layout, eye, "field_deg")
        layout.prop(eye, "at_infinity")
        if not eye.at_infinity:
            with_unit(layout, eye, "focus_mm")


class Eyebox(_OfGuide):
    """The places of the pupil that a study looks at."""

    name = "device_eyebox"
    bl_label = "Eyebox Grid"
    draw_header = _marked("eyebox.")

    def draw(self, context: bpy.types.Context) -> None:
        layout, eyebox = split_layout(self.layout), context.scene.hologram.eyebox
        layout.prop(eyebox, "grid")
        with_unit(layout, eyebox, "pitch_mm")


class Room(Body):
    """What stands behind and around."""

    name = "device_room"
    bl_label = "Room"
    parent = Device
    draw_header = _marked("room.")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_device(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        layout, room = split_layout(self.layout), context.scene.hologram.room
        layout.prop(room, "kind", text="Place")
        with_unit(layout, room, "luminance_cd_m2", "White Walls")


def draw_display(layout: bpy.types.UILayout, display: bpy.types.PropertyGroup) -> None:
    """Lay out the properties of a display.

    Args:
        layout: Where.
        display: The display.
    """
    _draw_picture(layout, display)
    with_unit(layout, display, "size_mm")
    with_unit(layout, display, "luminance_cd_m2")
    layout.prop(display, "white", text="White Point")
    layout.prop(display, "kind_of_primaries")
    if display.kind_of_primaries == Primaries.OWN:
        layout.prop(display, "primaries", text="Own Lines")


def _draw_picture(layout: bpy.types.UILayout, owner: bpy.types.PropertyGroup) -> None:
    layout.prop(owner, "picture")
    if owner.picture == PictureKind.IMAGE:
        layout.template_ID(owner, "image", open="image.open")


class HOE_UL_patches(bpy.types.UIList):
    """Holograms on the plate of a light guide."""

    def draw_item(
        self, context, layout, data, item, icon, active_data, active_property, index, flt_flag
    ):
        row = layout.row(align=True)
        row.label(text=item.name, icon="TEXTURE")
        if item.name == data.engine.patch:
            row.label(text="", icon="LIGHT_AREA")
        face = row.row()
        face.alignment = "RIGHT"
        face.active = False
        face.label(text="eye side" if item.face == "eye" else "world side")


register, unregister = panel_registrars(
    (SIDEBAR, SCENE),
    (Device, Display, Lens, Guide, Holograms, Element, Eye, Eyebox, Room),
    (HOE_UL_patches,),
)
