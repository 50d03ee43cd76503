# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The modules that register something with Blender, each after those that it depends on."""

from . import events, whole_undo
from .document import live
from .props import (
    device,
    display,
    efficiency,
    element,
    eye,
    guide,
    hologram,
    map_files,
    material,
    medium,
    overlay,
    recording,
    rendering,
    sync,
    targets,
)
from .registration import Part

PARTS: tuple[Part, ...] = (
    medium,
    recording,
    efficiency,
    hologram,
    material,
    display,
    element,
    rendering,
    overlay,
    eye,
    guide,
    device,
    sync,
    live,
    targets,
    map_files,
    events,
    whole_undo,
)
