# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facts of the devices in the open scenes, which follow every change."""

import bpy

from ...blender.document.held import has_device
from ...blender.ids import Role
from .cache import Facts
from .device import DeviceFacts, device_facts


def _stamp(scene: bpy.types.Scene) -> object:
    """What the facts depend on beside properties: the places of elements, and what else is there.

    Cycles and Blender have settings of their own, which note no change.
    """
    if not has_device(scene):
        return None
    render = scene.render
    places = tuple(
        tuple(value for row in item.matrix_world for value in row)
        for item in scene.objects
        if item.hologram.role != Role.NONE
    )
    size = render.resolution_x, render.resolution_y, render.resolution_percentage
    return len(scene.objects), size, scene.unit_settings.scale_length, places


DEVICE_FACTS: Facts[bpy.types.Scene, DeviceFacts] = Facts(
    "scenes", device_facts, of_any_change=True, stamp=_stamp
)
"""What panels say of the device in each scene."""

register, unregister = DEVICE_FACTS.register, DEVICE_FACTS.unregister
