# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo after datablocks were exchanged behind its back.

In a window objects and shaders follow a property after the undo step of that property was kept.
Blender leaves every datablock alone that is alike in both steps, as it is at the moment: with
pointers to what no step knows and what it frees, and Blender crashes. So from such an exchange on,
until another file is opened, each undo reads the whole step anew, as older versions of Blender
always did. To go back to the quick way between is no help: the steps name places in memory.
"""

from dataclasses import dataclass

import bpy
from bpy.app.handlers import persistent


@dataclass
class _State:
    """One for the process.

    Attributes:
        ahead: Whether datablocks were exchanged that the undo steps name.
        kept: The preferences, while an undo is at work.
    """

    ahead: bool = False
    kept: tuple[bool, bool, bool] | None = None


_state = _State()


def note_exchange() -> None:
    """Note that datablocks were exchanged outside of an operator, as a timer or a handler does."""
    _state.ahead = True


def register() -> None:
    """Watch undo."""
    for event in ("undo", "redo"):
        getattr(bpy.app.handlers, f"{event}_pre").append(_before)
        getattr(bpy.app.handlers, f"{event}_post").append(_after)
    bpy.app.handlers.load_post.append(_loaded)


def unregister() -> None:
    """Watch no more."""
    for event in ("undo", "redo"):
        getattr(bpy.app.handlers, f"{event}_pre").remove(_before)
        getattr(bpy.app.handlers, f"{event}_post").remove(_after)
    bpy.app.handlers.load_post.remove(_loaded)
    _restore()
    _state.ahead = False


@persistent
def _before(*_arguments: object) -> None:
    if _state.ahead:
        preferences = bpy.context.preferences
        view, experimental = preferences.view, preferences.experimental
        _state.kept = (
            preferences.is_dirty,
            view.show_developer_ui,
            experimental.use_undo_legacy,
        )
        # Blender looks at the one only together with the other.
        view.show_developer_ui = experimental.use_undo_legacy = True


@persistent
def _after(*_arguments: object) -> None:
    _restore()


@persistent
def _loaded(*_arguments: object) -> None:
    # It has undo steps of its own, the first one of what is there now.
    _state.ahead = False


def _restore() -> None:
    if _state.kept is not None:
        preferences = bpy.context.preferences
        dirty, shown, legacy = _state.kept
        preferences.view.show_developer_ui = shown
        preferences.experimental.use_undo_legacy = legacy
        preferences.is_dirty = dirty
        _state.kept = None
