# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A change that is refused leaves a scene as it was."""

import contextlib
from collections.abc import Callable

import bpy

from ...core.errors import HoeError
from ..props import changes
from .live import settle


def settle_or_restore(scene: bpy.types.Scene, restore: Callable[[], None]) -> None:
    """Bring a scene up to date with a change of its document, or take the change back.

    Args:
        scene: A scene that holds a document, changed already.
        restore: Takes the change of its properties back.

    Raises:
        HoeError: As ``settle``; the scene is as it was.
    """
    try:
        settle(scene)
    except BaseException:
        with changes.unmarked():
            restore()
        # What was wrong before the change is so still, and is told where problems are shown.
        with contextlib.suppress(HoeError):
            settle(scene)
        raise
