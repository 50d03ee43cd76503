# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of the job in the status bar, and Esc."""

import bpy

from ..ids import Op
from .current import running

_WIDTH = 7.0
"""Of the progress bar, in heights of a line."""


def draw(header: bpy.types.Header, context: bpy.types.Context) -> None:
    """Draw the progress, left of what the status bar shows by itself.

    Args:
        header: The status bar.
        context: Where it is drawn.
    """
    job = running(context)
    if job is None:
        return
    row = header.layout.row(align=True)
    bar = row.row(align=True)
    bar.ui_units_x = _WIDTH
    bar.progress(factor=job.share, text=f"{job.label} {job.share * 100:.0f} %")
    row.operator(Op.CANCEL, text="", icon="CANCEL")
    row.separator()
    row.label(text=job.words)


_keys: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []


def register() -> None:
    """Add the progress, and Esc where nothing else wants it."""
    bpy.types.STATUSBAR_HT_header.prepend(draw)
    added = bpy.context.window_manager.keyconfigs.addon
    if added is not None:
        keymap = added.keymaps.new(name="Window", space_type="EMPTY")
        _keys.append((keymap, keymap.keymap_items.new(Op.CANCEL, type="ESC", value="PRESS")))


def unregister() -> None:
    """Take them out again."""
    for keymap, item in _keys:
        keymap.keymap_items.remove(item)
    _keys.clear()
    bpy.types.STATUSBAR_HT_header.remove(draw)
