# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which materials have changed since their shaders were last brought up to date.

A property's update callback only notes the material and starts one timer, however many properties
change before it runs. Blender runs no timers in background mode: scripts ask for a refresh there.
"""

import contextlib
from collections.abc import Callable, Iterator

import bpy


class _State:
    """What is noted; one for the process."""

    changed: set[int]
    listener: Callable[[], None] | None
    quiet: int

    def __init__(self) -> None:
        self.changed = set()
        self.listener = None
        self.quiet = 0


_state = _State()


def mark(group: bpy.types.PropertyGroup, _context: bpy.types.Context | None = None) -> None:
    """Note that a property of a material has changed; the ``update`` of every property.

    Args:
        group: Group that holds the property.
    """
    if _state.quiet:
        return
    # Not the material itself: it may be gone, or moved by an undo, when the timer runs.
    _state.changed.add(group.id_data.session_uid)
    listener = _state.listener
    if listener is not None and not bpy.app.timers.is_registered(listener):
        bpy.app.timers.register(listener, first_interval=0.0)


@contextlib.contextmanager
def unmarked() -> Iterator[None]:
    """Write properties without noting a change."""
    _state.quiet += 1
    try:
        yield
    finally:
        _state.quiet -= 1


def taken() -> Iterator[bpy.types.Material]:
    """The materials that have changed; each is forgotten as it is given."""
    for material in list(bpy.data.materials):
        if material.session_uid in _state.changed:
            _state.changed.discard(material.session_uid)
            yield material
    _state.changed.clear()


def forget(material: bpy.types.Material) -> None:
    """Note that a material is up to date.

    Args:
        material: The material.
    """
    _state.changed.discard(material.session_uid)


def listen(listener: Callable[[], None]) -> None:
    """Call this soon after a change.

    Args:
        listener: Called once, by a timer, for any number of changes.
    """
    _state.listener = listener


def stop() -> None:
    """Call nothing any more, and forget what has changed."""
    listener = _state.listener
    if listener is not None and bpy.app.timers.is_registered(listener):
        bpy.app.timers.unregister(listener)
    _state.listener = None
    _state.changed.clear()
