# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The common part of operators that start a job."""

from collections.abc import Mapping
from typing import Any

import bpy

from ...blender.add.elements import has_eye
from ...blender.document.held import document_of, has_device
from ...blender.job_files import JobKind
from ..facts.device import plan_digest
from ..telling import tells
from .current import begin, running, wait
from .ending import finish
from .job import Job
from .launch import launch
from .places import given_place, next_place


class JobOperator:
    """Starts a job: beside the window from a button, to its end from a script.

    Attributes:
        kind: Kind of work.
        job_label: Its name in messages.
    """

    kind: JobKind
    job_label: str

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """A job can be started when none is at work."""
        job = running(context)
        if job is not None:
            cls.poll_message_set(f"Only one job at a time: {job.label} is at work; Esc ends it")
            return False
        return cls.applies(context)

    @classmethod
    def applies(cls, context: bpy.types.Context) -> bool:
        """Whether there is what the job is about."""
        raise AssertionError("each kind of job says so")

    def start(self, context: bpy.types.Context) -> Job:
        """Start the job.

        Args:
            context: Context of the operator.

        Raises:
            HoeError: It cannot be started.
        """
        raise AssertionError("each kind of job says so")

    @tells
    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start it; go on with the window where a click has asked for it, else wait for its end."""
        job = self.start(context)
        if self.options.is_invoke and not bpy.app.background:
            begin(job)
            return {"FINISHED"}
        try:
            wait(job)
        except BaseException:
            job.discard()
            raise
        return finish(self, context, job)


class DeviceJob(JobOperator):
    """Starts a job on the device of a scene, with results in a folder."""

    folder: str

    @classmethod
    def applies(cls, context: bpy.types.Context) -> bool:
        """Whether the scene holds a device, and an eye that looks at it."""
        if not has_device(context.scene):
            cls.poll_message_set("This scene holds no device; add one with Add > Hologram")
            return False
        if not has_eye(context.scene):
            cls.poll_message_set("This scene has no eye; add one with Add > Hologram > Eye")
            return False
        return True

    def settings(self, context: bpy.types.Context) -> Mapping[str, Any]:
        """What the process needs besides."""
        raise AssertionError("each kind of job says so")

    def start(self, context: bpy.types.Context) -> Job:
        """Start the job, with a folder for its results."""
        scene = context.scene
        # What is wrong with the document is told now, and no folder is made for it.
        spec = document_of(scene)
        place = given_place(self.folder) if self.folder else next_place(scene, self.kind)
        job = launch(self.kind, self.job_label, scene, place, self.settings(context))
        job.digest = plan_digest(spec)
        return job
