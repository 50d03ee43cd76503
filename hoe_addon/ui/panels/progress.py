# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far long work is, where it was started."""

import bpy

from ..ids import Op
from ..jobs import running
from .base import wrapped


def draw_progress(layout: bpy.types.UILayout, context: bpy.types.Context) -> bool:
    """Show the job that runs.

    Args:
        layout: Where.
        context: Of the panel.

    Returns:
        Whether there is one; else nothing is drawn.
    """
    job = running(context)
    if job is None:
        return False
    column = layout.column(align=True)
    row = column.row(align=True)
    row.progress(text=f"{job.share * 100:.0f} %", factor=job.share)
    row.operator(Op.CANCEL, text="", icon="CANCEL")
    wrapped(column, context, job.words)
    return True
