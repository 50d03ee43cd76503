# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let a scene hold the document of a device that was built in it; `held` reads it back."""

from typing import Any

import bpy

from ...model.device import LightGuideSpec
from ...model.document import to_document
from ..build.device import ENGINE, GUIDE, DeviceScene
from ..build.guide import FIRST_PATCH
from ..ids import Role, RoomKind
from ..props import changes
from ..props.device import VERSION


def hold(device: DeviceScene) -> None:
    """Write the document of a device that was built as a whole into its scene.

    Args:
        device: The device, with all its effects.
    """
    document = to_document(device.spec)
    held = device.scene.hologram
    with changes.unmarked():
        held.version, held.kind = VERSION, document["kind"]
        held.short_name, held.title = document["name"], document["title"]
        held.description = document["description"]
        held.root, held.wavelength = device.root, device.spectral.group
        held.eye.from_document(document["eye"], "eye")
        held.eye.camera = device.eye
        held.room.from_document(document["room"], "room")
        held.room.collection = device.room
        hold_room(device.room)
        if held.room.kind != RoomKind.NONE:
            held.room.world = device.scene.world
        held.render.from_document(document["render"], "render")
        device.root.hologram.role = Role.ROOT
        device.eye.hologram.role = Role.EYE
        for child in device.eye.children:
            child.hologram.role = Role.FILTER
        if isinstance(device.spec, LightGuideSpec):
            _hold_guide(device, document)
        else:
            for place, element in enumerate(document["elements"]):
                item = device.elements[element["name"]]
                hold_element(item, element, f"elements[{place}]", place)


def hold_room(made: bpy.types.Collection) -> None:
    """Let what was made as a room say so: whatever else comes into its collection is the user's.

    Args:
        made: The new room.
    """
    for item in made.all_objects:
        item.hologram.role = Role.ROOM


def hold_element(item: bpy.types.Object, document: dict[str, Any], path: str, rank: int) -> None:
    """Write an element of a scene into its object; what hangs on it becomes part of it.

    Args:
        item: The object.
        document: The element.
        path: Its path, for messages.
        rank: Where it stands among the elements.
    """
    with changes.unmarked():
        item.hologram.from_document(document, path, _shown_image(item))
        item.hologram.rank = rank
        for child in item.children_recursive:
            _fix(child, Role.PART)


def _hold_guide(device: DeviceScene, document: dict[str, Any]) -> None:
    held, plate, mount = device.scene.hologram, device.elements[GUIDE], device.elements[ENGINE]
    held.guide.from_document(document["guide"], "guide")
    held.guide.plate = plate
    held.patches.clear()
    for place, patch in enumerate(document["holograms"]):
        entry = held.patches.add()
        entry.from_document(patch, f"holograms[{place}]")
        entry.material = plate.material_slots[FIRST_PATCH + place].material
    assert device.panel is not None, "a light guide has a display"
    held.engine.from_documents(document, _shown_image(device.panel))
    held.engine.mount, held.engine.panel = mount, device.panel
    held.eyebox.from_document(document["eyebox"], "eyebox")
    _fix(plate, Role.GUIDE)
    _fix(mount, Role.ENGINE)
    for child in mount.children_recursive:
        _fix(child, Role.PART)


def _fix(item: bpy.types.Object, role: Role) -> None:
    """Say what an object is whose place follows from numbers: nobody moves it by mistake."""
    item.hologram.role = role
    item.lock_location = item.lock_rotation = item.lock_scale = (True,) * 3


def _shown_image(item: bpy.types.Object) -> bpy.types.Image | None:
    """The image in the material of a display or a card."""
    for slot in item.material_slots:
        tree = slot.material.node_tree if slot.material is not None else None
        for node in tree.nodes if tree is not None else ():
            if node.bl_idname == "ShaderNodeTexImage" and node.image is not None:
                return node.image
    return None
