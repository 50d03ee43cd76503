# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which materials, objects and scenes have changed since what hangs on them was brought up to date.

A property's update callback only notes the datablock and starts one timer, however many properties
change before it runs. Blender runs no timers in background mode: scripts ask for a refresh there.
"""

import contextlib
from collections.abc import Callable, Iterable, Iterator

import bpy

type Listener = Callable[[frozenset[int]], None]
"""Told the session ids of all datablocks that have changed."""


class _State:
    """What is noted; one for the process."""

    changed: set[int]
    seen_to: set[int]
    meanwhile: set[int]
    listeners: list[Listener]
    quiet: int

    def __init__(self) -> None:
        self.changed = set()
        self.seen_to = set()
        self.meanwhile = set()
        self.listeners = []
        self.quiet = 0


_state = _State()


def mark(group: bpy.types.PropertyGroup, _context: bpy.types.Context | None = None) -> None:
    """Note that a property of a datablock has changed; the ``update`` of every property.

    Args:
        group: Group that holds the property.
    """
    if not _state.quiet:
        mark_block(group.id_data)


def mark_block(block: bpy.types.ID) -> None:
    """Note that a datablock has changed.

    Args:
        block: The datablock.
    """
    # Not the datablock itself: it may be gone, or moved by an undo, when the timer runs.
    _state.changed.add(block.session_uid)
    _state.meanwhile.add(block.session_uid)
    if _state.listeners and not is_waiting():
        bpy.app.timers.register(_tell, first_interval=0.0)


def is_waiting() -> bool:
    """Whether a timer will tell the listeners soon."""
    return bpy.app.timers.is_registered(_tell)


@contextlib.contextmanager
def unmarked() -> Iterator[None]:
    """Write properties without noting a change."""
    _state.quiet += 1
    try:
        yield
    finally:
        _state.quiet -= 1


def taken[B: bpy.types.ID](blocks: Iterable[B]) -> Iterator[B]:
    """Those of some datablocks that have changed; each is forgotten as it is given.

    Args:
        blocks: All that are looked at, such as ``bpy.data.materials``.
    """
    for block in list(blocks):
        if block.session_uid in _state.changed:
            forget(block)
            yield block


def is_changed(block: bpy.types.ID) -> bool:
    """Tell whether a datablock has changed since it was brought up to date.

    Args:
        block: The datablock.
    """
    return block.session_uid in _state.changed


def forget(block: bpy.types.ID) -> None:
    """Note that a datablock is up to date; listeners are told all the same that it changed.

    Args:
        block: The datablock.
    """
    if block.session_uid in _state.changed:
        _state.changed.discard(block.session_uid)
        _state.seen_to.add(block.session_uid)


def listen(listener: Listener) -> None:
    """Call this soon after a change, once for any number of changes.

    Args:
        listener: Called by a timer, after those that listened before it.
    """
    _state.listeners.append(listener)


def stop(listener: Listener) -> None:
    """Call a listener no more; when it was the last one, forget what has changed.

    Args:
        listener: What ``listen`` got.
    """
    _state.listeners.remove(listener)
    if not _state.listeners:
        if is_waiting():
            bpy.app.timers.unregister(_tell)
        _state.changed.clear()
        _state.seen_to.clear()
        _state.meanwhile.clear()


def _tell() -> float | None:
    """Tell all listeners; what changes meanwhile is told them the next time."""
    batch = frozenset(_state.changed | _state.seen_to)
    _state.meanwhile.clear()
    try:
        for listener in list(_state.listeners):
            listener(batch)
    finally:
        _state.changed &= _state.meanwhile
        _state.seen_to.clear()
    return 0.0 if _state.changed and _state.listeners else None
