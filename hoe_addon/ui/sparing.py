# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that follows the scene without slowing it down, however large the scene is."""

import time
from collections.abc import Callable

import bpy

_REST = 10.0
"""After work that took a second there is none for ten."""


class Sparing:
    """Work done by a timer soon after it is asked for, and in a tenth of the time at most."""

    def __init__(self, work: Callable[[], None]) -> None:
        """Ask for nothing yet.

        Args:
            work: What is done, once for any number of times that it was asked for.
        """
        self._work = work
        self._seconds = 0.0
        # Blender knows callbacks by identity, and each access makes another bound method.
        self._timer = self._run

    def ask(self) -> None:
        """Let it be done soon; Blender runs no timers in background mode."""
        if not bpy.app.background and not self.is_waiting():
            bpy.app.timers.register(self._timer, first_interval=_REST * self._seconds)

    def is_waiting(self) -> bool:
        """Whether it is going to be done."""
        return bpy.app.timers.is_registered(self._timer)

    def stop(self) -> None:
        """Do not do it."""
        if self.is_waiting():
            bpy.app.timers.unregister(self._timer)

    def _run(self) -> None:
        started = time.perf_counter()
        try:
            self._work()
        finally:
            self._seconds = time.perf_counter() - started
