# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document of a scene as properties, ``Scene.hologram``.

Objects have their own part, ``Object.hologram``, and holograms theirs, ``Material.hologram``; here
is what holds for the whole. Pointers name the objects that the document was made into.
"""

import bpy
from bpy.props import (
    CollectionProperty,
    EnumProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..ids import DeviceKind
from ..registration import class_registrars
from .changes import mark
from .eye import HOE_PG_eye, HOE_PG_eyebox, HOE_PG_room
from .guide import HOE_PG_engine, HOE_PG_guide, HOE_PG_patch
from .overlay import HOE_PG_overlay
from .rendering import HOE_PG_render

VERSION = 3
"""Version of what a .blend holds: 1 had holograms on materials only, 2 did not tell what the
add-on had made from what is the user's."""


def _show_patch(group: "HOE_PG_device", context: bpy.types.Context) -> None:
    """Make the chosen hologram the active material, which the panels of materials show."""
    plate = group.guide.plate
    if plate is None or group.active_patch >= len(group.patches):
        return
    material = group.patches[group.active_patch].material
    for place, slot in enumerate(plate.material_slots):
        if slot.material is not None and slot.material == material:
            plate.active_material_index = place
            if plate.name in context.view_layer.objects:
                context.view_layer.objects.active = plate


class HOE_PG_device(bpy.types.PropertyGroup):
    """What a scene's document says, and the objects that it was made into."""

    version: IntProperty(
        name="Version",
        description="Version of what this scene holds",
        default=0,
        min=0,
        options={"HIDDEN"},
    )
    kind: EnumProperty(
        name="Kind",
        description="What the document of this scene describes",
        items=DeviceKind.items(),
        default=DeviceKind.NONE,
    )
    short_name: StringProperty(
        name="Name", description="Short name of the device, for files", update=mark
    )
    title: StringProperty(name="Title", description="One line about the device")
    description: StringProperty(name="Description", description="What it shows")
    root: PointerProperty(
        name="Device",
        description="Object whose frame is that of the device",
        type=bpy.types.Object,
    )
    wavelength: PointerProperty(
        name="Wavelength",
        description="Node group that draws wavelengths",
        type=bpy.types.NodeTree,
    )
    problem: StringProperty(
        name="Problem",
        description="Why the scene could not be made from these properties; empty when it could",
        options={"HIDDEN"},
    )
    made_of: StringProperty(
        description="What the parts were last made of, to see what has changed",
        options={"HIDDEN"},
    )
    eyebox_result: StringProperty(
        description="Result of the last study of the eyebox", options={"HIDDEN"}
    )
    accuracy_result: StringProperty(
        description="Result of the last study of accuracy", options={"HIDDEN"}
    )
    eye: PointerProperty(
        name="Eye", description="Pupil, focus and field of the eye that looks", type=HOE_PG_eye
    )
    guide: PointerProperty(name="Light Guide", description="The plate", type=HOE_PG_guide)
    patches: CollectionProperty(
        name="Holograms", description="Holograms on the plate", type=HOE_PG_patch
    )
    active_patch: IntProperty(
        name="Active Hologram",
        description="Hologram that is chosen; its material becomes the active one",
        default=0,
        min=0,
        update=_show_patch,
    )
    engine: PointerProperty(name="Light Engine", description="Display and lens", type=HOE_PG_engine)
    eyebox: PointerProperty(
        name="Eyebox", description="Pupil positions around the eye's own", type=HOE_PG_eyebox
    )
    room: PointerProperty(
        name="Room", description="What stands behind and around", type=HOE_PG_room
    )
    render: PointerProperty(
        name="Render", description="How the picture is made", type=HOE_PG_render
    )
    overlay: PointerProperty(
        name="Viewport", description="What is drawn in the viewport", type=HOE_PG_overlay
    )


_register, _unregister = class_registrars((HOE_PG_device,))


def register() -> None:
    """Add ``Scene.hologram``."""
    _register()
    bpy.types.Scene.hologram = PointerProperty(
        name="Hologram", description="The device in this scene", type=HOE_PG_device
    )


def unregister() -> None:
    """Take it away; what files hold in it stays in them."""
    del bpy.types.Scene.hologram
    _unregister()
