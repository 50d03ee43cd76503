# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""When what is drawn is brought up to date: soon after a change, once for any number of them.

A timer does the work, not the redraw: reading a document brings the scene up to date, which may
not happen while Blender draws. Blender runs no timers in background mode, where nothing is drawn.
"""

import bpy
from bpy.app.handlers import persistent

from ...blender.props import changes
from ..sparing import Sparing
from . import failure, state

_EVENTS = ("depsgraph_update_post", "frame_change_post", "load_post", "undo_post", "redo_post")


class _Pending:
    """Whether changes count; one for the process."""

    is_busy = False


def schedule() -> None:
    """Bring what is drawn up to date soon."""
    if not _Pending.is_busy:
        _soon.ask()


def is_waiting() -> bool:
    """Whether that is going to happen."""
    return _soon.is_waiting()


def run() -> bool:
    """Bring what is drawn of the scenes in all windows up to date.

    Returns:
        Whether anything changed.
    """
    # Reading a document updates the scene; that is no change of it.
    _Pending.is_busy = True
    try:
        state.forget_others(bpy.data.scenes)
        scenes = {window.scene for window in bpy.context.window_manager.windows}
        changed = [state.refresh(scene) for scene in scenes]
        return any(changed)
    finally:
        _Pending.is_busy = False


def redraw() -> None:
    """Draw all 3-D views anew."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _run_and_redraw() -> None:
    if run():
        redraw()


_soon = Sparing(lambda: failure.guarded(_run_and_redraw))


@persistent
def _changed(*_arguments: object) -> None:
    schedule()


def _noted(_changed_ids: frozenset[int]) -> None:
    # Properties of a scene change without an event of their own.
    schedule()


def register() -> None:
    """Watch all scenes."""
    changes.listen(_noted)
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).append(_changed)
    schedule()


def unregister() -> None:
    """Watch no more, and keep nothing."""
    changes.stop(_noted)
    for event in _EVENTS:
        getattr(bpy.app.handlers, event).remove(_changed)
    _soon.stop()
    state.forget_all()
