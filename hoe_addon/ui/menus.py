# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Hologram."""

import bpy

from ..blender.registration import class_registrars
from .ids import Menu, Op
from .operators.add_preset import preset_items

_ELEMENTS = (
    (Op.ADD_HOLOGRAM, "Hologram on a Plate", "TEXTURE"),
    (Op.HOLOGRAM_ON_FACES, "Hologram on Faces", "FACESEL"),
    (Op.ADD_SLAB, "Light-Guide Slab", "MESH_PLANE"),
    (Op.ADD_DISPLAY, "Display", "IMAGE_PLANE"),
    (Op.ADD_LAMP, "Lamp with a Spectrum", "LIGHT_AREA"),
    (Op.ADD_IDEAL_LENS, "Ideal Lens", "MESH_CIRCLE"),
    (Op.ADD_EYE, "Eye", "HIDE_OFF"),
)


class HOE_MT_add_scene(bpy.types.Menu):
    """Presets as scenes of their own."""

    bl_idname = Menu.ADD_SCENE
    bl_label = "Scene"

    def draw(self, context):
        del context
        _draw_presets(self.layout, "SCENE", "SCENE_DATA")


class HOE_MT_add_device(bpy.types.Menu):
    """Presets as devices in the scene that is open."""

    bl_idname = Menu.ADD_DEVICE
    bl_label = "Device at Cursor"

    def draw(self, context):
        del context
        _draw_presets(self.layout, "DEVICE", "PIVOT_CURSOR")


class HOE_MT_add(bpy.types.Menu):
    """Whole scenes, devices, single elements."""

    bl_idname = Menu.ADD
    bl_label = "Hologram"

    def draw(self, context):
        del context
        layout = self.layout
        layout.menu(Menu.ADD_SCENE, icon="SCENE_DATA")
        layout.menu(Menu.ADD_DEVICE, icon="PIVOT_CURSOR")
        layout.separator()
        for name, text, icon in _ELEMENTS:
            layout.operator(name, text=text, icon=icon)
        layout.separator()
        for shape, text, icon in (
            ("PRISM", "Dispersive Glass Prism", "MESH_CONE"),
            ("BALL", "Dispersive Glass Ball", "MESH_UVSPHERE"),
            ("SELECTED", "Dispersive Glass on Selected Objects", "RESTRICT_SELECT_OFF"),
        ):
            layout.operator(Op.ADD_GLASS, text=text, icon=icon).shape = shape


def _draw_presets(layout: bpy.types.UILayout, place: str, icon: str) -> None:
    for name, label, _title, _number in preset_items():
        button = layout.operator(Op.ADD_PRESET, text=label, icon=icon)
        button.preset, button.place = name, place


def _draw_in_add(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.menu(Menu.ADD, icon="TEXTURE")


def _draw_in_faces(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.operator(Op.HOLOGRAM_ON_FACES, icon="TEXTURE")


_register, _unregister = class_registrars((HOE_MT_add_scene, HOE_MT_add_device, HOE_MT_add))


def register() -> None:
    """Add the menus; the presets' titles are read here once."""
    preset_items()
    _register()
    bpy.types.VIEW3D_MT_add.append(_draw_in_add)
    bpy.types.VIEW3D_MT_edit_mesh_faces.append(_draw_in_faces)


def unregister() -> None:
    """Take them away."""
    bpy.types.VIEW3D_MT_edit_mesh_faces.remove(_draw_in_faces)
    bpy.types.VIEW3D_MT_add.remove(_draw_in_add)
    _unregister()
