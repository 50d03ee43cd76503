# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The one job of this Blender: a timer looks after it, and whoever draws reads it.

No modal operator stands in the window meanwhile: Blender would not save by itself as long.
"""

import time
from dataclasses import dataclass

import bpy

from ..facts.cache import redraw
from .job import Job

_EVERY_S = 0.1
_OFTEN_S = 0.02
_PER_CENT = 100


@dataclass
class _State:
    job: Job | None = None
    drawn: str = ""


_state = _State()


def running(_context: bpy.types.Context | None = None) -> Job | None:
    """The job that is at work, or has ended and is not told yet; None when there is none."""
    return _state.job


def begin(job: Job) -> None:
    """Look after a job while the window goes on; its end is told by the operator for that.

    Args:
        job: A job that is at work, the only one.
    """
    _state.job = job
    bpy.app.timers.register(_look, first_interval=_EVERY_S, persistent=True)


def wait(job: Job) -> None:
    """Wait for a job, for scripts.

    Args:
        job: A job that is at work, the only one.
    """
    manager = bpy.context.window_manager
    _state.job = job
    manager.progress_begin(0, _PER_CENT)
    try:
        while job.is_running:
            manager.progress_update(_PER_CENT * job.share)
            time.sleep(_OFTEN_S)
    finally:
        manager.progress_end()
        _state.job = None


def cancel() -> None:
    """Ask the job to end and keep what is done; the second time, end it at once."""
    if _state.job is not None:
        _state.job.cancel()
        _draw_anew()


def take_ended() -> Job | None:
    """The job that has ended, to be told now; it is forgotten here."""
    job = _state.job
    if job is None or job.is_running:
        return None
    _state.job = None
    redraw()
    _draw_bars()
    return job


def _look() -> float | None:
    """Draw what is new, until the job has ended."""
    job = _state.job
    if job is None:
        return None
    if job.is_running:
        if job.words != _state.drawn:
            _state.drawn = job.words
            _draw_anew()
        return _EVERY_S
    window = bpy.context.window_manager.windows[0]
    # The stubs do not know it as a context manager.
    with bpy.context.temp_override(window=window):  # pyright: ignore[reportGeneralTypeIssues]
        bpy.ops.hologram.job_ended("INVOKE_DEFAULT")
    # Blender may end that operator before it has told; then another one does.
    return _EVERY_S


def _draw_anew() -> None:
    """Draw panels and status bar anew; an operator at work keeps its own text in the latter."""
    redraw()
    if not any(window.modal_operators for window in bpy.context.window_manager.windows):
        _draw_bars()


def _draw_bars() -> None:
    # Blender draws the status bar anew when a text for it is taken away, even where there is none.
    for window in bpy.context.window_manager.windows:
        window.workspace.status_text_set_internal(None)


def register() -> None:
    """Nothing is needed before the first job."""


def unregister() -> None:
    """End the job, if there is one."""
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)
    job, _state.job = _state.job, None
    if job is not None:
        job.discard()
