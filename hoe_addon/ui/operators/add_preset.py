# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a preset: as a scene of its own, or as a device at the 3-D cursor."""

from functools import cache

import bpy
from bpy.props import EnumProperty

from ...blender.add.presets import add_device, add_scene
from ...blender.document.elements import element_objects
from ...blender.ids import Role
from ...blender.registration import class_registrars
from ...model.document import preset_titles
from ..ids import Op
from ..telling import tells
from .add_placing import may_add, report_added, select
from .add_views import around, look_through_camera, show

_INITIALS = frozenset(("ar", "hud"))


@cache
def preset_items() -> list[tuple[str, str, str, int]]:
    """The presets as Blender's enum properties take them; titles are too long for a menu."""
    return [
        (name, preset_label(name), title, place)
        for place, (name, title) in enumerate(preset_titles().items())
    ]


def preset_label(name: str) -> str:
    """Write the name of a preset as a menu does.

    Args:
        name: The name, as the command line takes it.

    Returns:
        Its words, with capitals.
    """
    words = name.split("_")
    return " ".join(word.upper() if word in _INITIALS else word.capitalize() for word in words)


def _items(_operator: object, _context: object) -> list[tuple[str, str, str, int]]:
    return preset_items()


class HOE_OT_add_preset(bpy.types.Operator):
    """Add a ready-made device."""

    bl_idname = Op.ADD_PRESET
    bl_label = "Add Preset"
    bl_description = "Add a ready-made device"
    bl_options = {"REGISTER", "UNDO"}

    preset: EnumProperty(name="Preset", description="Which device", items=_items)
    place: EnumProperty(
        name="As",
        description="What becomes of your scene",
        items=(
            ("SCENE", "New Scene", "A scene of its own with its room; yours stays as it is", 0),
            ("DEVICE", "Device at Cursor", "Without its room, in your scene", 1),
        ),
        default="SCENE",
    )

    @classmethod
    def poll(cls, context):
        return may_add(cls, context)

    @classmethod
    def description(cls, context, properties):
        """The title of the preset, and where it comes."""
        del context
        title = preset_titles()[properties.preset]
        if properties.place == "SCENE":
            return f"{title}. Opens as a new scene; yours stays as it is"
        return f"{title}. Without its room, at its true size, the eye at the 3D cursor"

    @tells
    def execute(self, context):
        if self.place == "SCENE":
            self._add_scene(context)
        else:
            self._add_device(context)
        return {"FINISHED"}

    def _add_scene(self, context: bpy.types.Context) -> None:
        before = context.scene.name
        scene = add_scene(self.preset)
        if context.window is not None:
            context.window.scene = scene
            look_through_camera(context.window)
            select(context, _main_part(scene))
        self.report({"INFO"}, f"{scene.name}: opened as a new scene; {before} is as it was")

    def _add_device(self, context: bpy.types.Context) -> None:
        scene = context.scene
        added = add_device(scene, self.preset, scene.cursor.location)
        select(context, added.root)
        show(context, added.root)
        notes = ["its eye is the camera now"]
        if added.kept_camera is not None:
            kept = added.kept_camera.name
            notes = [f"the camera is still {kept}, its eye is {added.eye.name}"]
        bodies = around(scene, added.eye)
        if bodies:
            notes.append(f"the eye stands inside {', '.join(bodies)}: move one of them")
        report_added(self, self.preset, added.settings, "; ".join(notes))


def _main_part(scene: bpy.types.Scene) -> bpy.types.Object:
    """What a device is about: its first hologram, or its plate or lens that carries some."""
    held = scene.hologram
    roles = (Role.HOLOGRAM, Role.LENS)
    found = [item for item in element_objects(scene) if item.hologram.role in roles]
    found.sort(key=lambda each: roles.index(Role(each.hologram.role)))
    return next(iter(found), held.guide.plate or held.root)


register, unregister = class_registrars((HOE_OT_add_preset,))
