# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and problems as panels show them."""

from collections.abc import Iterable

import bpy

from ..facts.device import Line
from ..wording import in_plain_words, is_question
from .base import wrapped

_LABELS_SHARE = 0.4


def numbers(layout: bpy.types.UILayout, lines: Iterable[Line]) -> None:
    """Write lines of numbers in two columns.

    Args:
        layout: Where.
        lines: The lines.
    """
    column = layout.column(align=True)
    column.scale_y = 0.85
    for line in lines:
        row = column.split(factor=_LABELS_SHARE)
        label = row.column()
        label.alignment = "RIGHT"
        label.active = False
        label.label(text=line.label)
        row.label(text=line.value)


def problem(layout: bpy.types.UILayout, context: bpy.types.Context, words: str) -> None:
    """Show what is wrong, in red, where it is wrong; what was not chosen yet is no fault.

    Args:
        layout: Where.
        context: Of the panel.
        words: One sentence, as messages have it.
    """
    box = layout.box()
    box.alert = not is_question(words)
    wrapped(box, context, in_plain_words(words), "ERROR" if box.alert else "INFO")
