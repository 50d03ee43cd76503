# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which holograms have properties with keyframes or drivers."""

from collections.abc import Iterator

import bpy

_PATH = "hologram."


def animated_holograms() -> Iterator[bpy.types.Material]:
    """Holograms of this file whose properties change with the frame."""
    for material in bpy.data.materials:
        data = material.animation_data
        if data is None or material.library is not None or not material.hologram.enabled:
            continue
        if any(path.startswith(_PATH) for path in _paths(data)):
            yield material


def _paths(data: bpy.types.AnimData) -> Iterator[str]:
    for driver in data.drivers:
        yield driver.data_path
    yield from _action_paths(data.action)
    for track in data.nla_tracks:
        for strip in track.strips:
            yield from _action_paths(strip.action)


def _action_paths(action: bpy.types.Action | None) -> Iterator[str]:
    for layer in action.layers if action is not None else ():
        for strip in layer.strips:
            for bag in strip.channelbags:
                for curve in bag.fcurves:
                    yield curve.data_path
