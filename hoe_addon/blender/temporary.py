# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that are there for a measurement only."""

import contextlib
from collections.abc import Iterator

import bpy

_KINDS = (
    "objects",
    "meshes",
    "cameras",
    "lights",
    "materials",
    "worlds",
    "images",
    "texts",
    "node_groups",
    "collections",
)


@contextlib.contextmanager
def temporary_scene(name: str) -> Iterator[bpy.types.Scene]:
    """A scene of its own, removed with everything that was made meanwhile.

    Args:
        name: Name of the scene.

    Yields:
        The scene, empty.
    """
    before = {kind: set(getattr(bpy.data, kind)) for kind in _KINDS}
    scene = bpy.data.scenes.new(name)
    try:
        yield scene
    finally:
        bpy.data.scenes.remove(scene)
        for kind, known in before.items():
            for item in set(getattr(bpy.data, kind)) - known:
                getattr(bpy.data, kind).remove(item)
