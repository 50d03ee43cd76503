# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators as steps that are undone and done again."""

from typing import Any

import bpy


def call(name: str, **settings: Any) -> set[str]:
    """Run an operator by its id."""
    group, _, operator = name.partition(".")
    return getattr(getattr(bpy.ops, group), operator)(**settings)


def done(name: str, **settings: Any) -> None:
    """Run an operator, and close an undo step as a window does."""
    assert call(name, **settings) == {"FINISHED"}
    bpy.ops.ed.undo_push(message=name)


def state() -> dict[str, Any]:
    """What an undo has to bring back, without pointers."""
    held = bpy.context.scene.hologram
    return {
        "scene": bpy.context.scene.name,
        "objects": sorted((item.name, item.hologram.role) for item in bpy.data.objects),
        "materials": sorted(material.name for material in bpy.data.materials),
        "kind": held.kind,
        "root": held.root and held.root.name,
        "eye": held.eye.camera and held.eye.camera.name,
        "engine": bpy.context.scene.render.engine,
    }


def assert_undone_and_redone(before: dict[str, Any]) -> None:
    """Undo brings back what was before the last step, and redo what it made."""
    after = state()
    assert after != before
    bpy.ops.ed.undo()
    assert state() == before
    bpy.ops.ed.redo()
    assert state() == after
