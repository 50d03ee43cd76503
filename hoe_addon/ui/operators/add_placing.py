# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What all operators that add an element have in common: a place, a selection, a report."""

import math
from collections.abc import Sequence

import bpy
from bpy.props import EnumProperty, FloatVectorProperty
from bpy_extras.object_utils import add_object_align_init
from mathutils import Matrix

from ..telling import tells
from .add_views import show

MM = {"min": 1e-3, "soft_min": 0.1, "soft_max": 500.0, "step": 100, "precision": 3}
"""Limits of lengths in mm."""


def _aligned(operator: "PlacedElement", _context: bpy.types.Context) -> None:
    if operator.align == "WORLD":
        operator.rotation = (0.0, 0.0, 0.0)


class PlacedElement:
    """An element at the 3-D cursor; a subclass says which, by ``add``."""

    align: EnumProperty(
        name="Align",
        description="What the new object is aligned to",
        items=(
            ("WORLD", "World", "Upright, its front toward the front view"),
            ("VIEW", "View", "Its front toward you"),
            ("CURSOR", "3D Cursor", "Its front along the Z axis of the 3D cursor"),
        ),
        default="WORLD",
        update=_aligned,
    )
    location: FloatVectorProperty(
        name="Location", description="Where it stands, in scene units", subtype="TRANSLATION"
    )
    rotation: FloatVectorProperty(name="Rotation", description="How it is turned", subtype="EULER")

    @classmethod
    def poll(cls, context):
        return may_add(cls, context)

    @tells
    def execute(self, context):
        """Add the element, and select it."""
        scene = context.scene
        item, settings = self.add(scene, placed(self, context), free_collection(context))
        select(context, item)
        show(context, item)
        note = self.note(scene, item)
        report_added(self, item.name, settings, note)
        return {"FINISHED"}

    def note(self, scene: bpy.types.Scene, item: bpy.types.Object) -> str:
        """What else there is to say about a new element; mostly nothing."""
        del scene, item
        return ""


def may_add(operator: type, context: bpy.types.Context) -> bool:
    """Tell whether something can be added now; where not, the operator says why."""
    if context.scene is None or context.scene.library is not None:
        operator.poll_message_set("This scene comes from another file and cannot be changed")
        return False
    if context.mode != "OBJECT":
        operator.poll_message_set("Elements are added in Object Mode")
        return False
    return True


def placed(operator: bpy.types.Operator, context: bpy.types.Context) -> Matrix:
    """Find where a new element stands, by the operator, the 3-D cursor and the preferences.

    Args:
        operator: It has ``align``, ``location`` and ``rotation``.
        context: Of the operator.

    Returns:
        The matrix of an object whose front is +z and whose top is +y.
    """
    given = operator.properties.is_property_set("rotation")
    wanted = operator.align if given else context.preferences.edit.object_align
    if wanted == "VIEW" and not _has_view(context):
        operator.align = "WORLD"
        operator.rotation = (0.0, 0.0, 0.0)
    matrix = add_object_align_init(context, operator)
    if operator.align == "WORLD":
        return matrix @ Matrix.Rotation(math.radians(90.0), 4, "X")
    return matrix


def free_collection(context: bpy.types.Context) -> bpy.types.Collection:
    """The collection that new objects come into; never that of the room, which comes and goes."""
    active, scene = context.collection, context.scene
    room = scene.hologram.room.collection
    if active is None or active.library is not None or active == room:
        return scene.collection
    return active


def select(context: bpy.types.Context, item: bpy.types.Object) -> None:
    """Make an object the selected and the active one, where it can be seen.

    Args:
        context: Of the operator.
        item: The object.
    """
    layer = context.view_layer
    layer.update()
    if item.name not in layer.objects:
        return
    for other in layer.objects:
        other.select_set(False)
    item.select_set(True)
    layer.objects.active = item
    if _has_view(context) and context.space_data.local_view is not None:
        for part in (item, *item.children_recursive):
            part.local_view_set(context.space_data, True)


def report_added(
    operator: bpy.types.Operator,
    name: str,
    settings: Sequence[str],
    note: str = "",
) -> None:
    """Say what was added, and what else was changed for it.

    Args:
        operator: Who says it.
        name: What was added.
        settings: Names of the render settings that were changed.
        note: What else there is to say.
    """
    words = [f"{name} added", *([note] if note else [])]
    if settings:
        words.append(f"settings that holograms need were set: {', '.join(settings)}")
    operator.report({"INFO"}, "; ".join(words))


def _has_view(context: bpy.types.Context) -> bool:
    return context.space_data is not None and context.space_data.type == "VIEW_3D"
