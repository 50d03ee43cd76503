# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A render at work: its progress in the status bar and where it was started."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import tempfile

import bpy
from window import Picture, View, hide_room, part, scene, take

MARK = "hoe-picture"
SLEEP = """
import sys
import time
print('hoe-picture {"share": 0.42, "words": "round 3, pixel error 2.1 %"}', flush=True)
sys.stdin.read()
"""
"""Says how far it is, and sleeps until the window closes."""


def later() -> None:
    """Start a process that only sleeps, as the job of this window."""
    job_files, jobs = part("blender.job_files"), part("ui.jobs.job")
    folder = Path(tempfile.mkdtemp(prefix="hoe_picture_"))
    job = jobs.Job(job_files.JobKind.RENDER, "Render", folder, None, scene().session_uid)
    command = [sys.executable, "-c", SLEEP]
    job.process = part("ui.jobs.worker").WorkerProcess(command, folder, MARK)
    if bpy.app.background:
        job.discard()
    else:
        part("ui.jobs.current").begin(job)


take(
    Picture(
        "two_hologram_ar",
        opened=("render",),
        view=View((12.0, 10.0, 0.0), 75.0, (62.0, 0.0, 30.0)),
        prepare=hide_room,
        later=later,
    )
)
