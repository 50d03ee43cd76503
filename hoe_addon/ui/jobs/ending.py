# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the window does when a job has ended: show what came of it, and say so once."""

import logging
from pathlib import Path
from typing import Any

import bpy

from ...blender.job_files import JobKind
from ...blender.props.sync import refresh
from ...core.errors import HoeError
from ..facts.cache import redraw
from ..facts.study import keep_result
from .job import Job, JobStoppedError
from .pictures import PICTURE, SHEET, load_picture, show_picture

_log = logging.getLogger(__name__)


def finish(operator: bpy.types.Operator, context: bpy.types.Context, job: Job) -> set[str]:
    """Show and tell what came of a job, and take its folder away.

    Args:
        operator: Its reports tell.
        context: Context of the operator.
        job: The job, which has ended.

    Returns:
        What the operator returns.
    """
    try:
        result = job.result()
        _take(context, job, result)
    except JobStoppedError as error:
        operator.report({"WARNING"}, str(error))
        return {"CANCELLED"}
    except HoeError as error:
        _keep_log(job)
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    finally:
        job.discard()
    operator.report({"INFO"}, _told(job, result))
    return {"FINISHED"}


def _take(context: bpy.types.Context, job: Job, result: dict[str, Any]) -> None:
    """Bring the open file up to date with what came of a job."""
    if job.kind == JobKind.BAKE:
        material = bpy.data.materials.get((result["material"], None))
        if material is not None and material.hologram.enabled:
            refresh(material, make=False)
        return
    for scene in bpy.data.scenes:
        if scene.session_uid == job.scene:
            keep_result(scene, job.kind, result, job.digest)
            redraw()
    if job.kind == JobKind.ACCURACY:
        if not bpy.app.background:
            bpy.ops.wm.url_open(url=Path(result["page"]).as_uri())
    else:
        name = PICTURE if job.kind == JobKind.RENDER else SHEET
        image = load_picture(Path(result["picture"]), name)
        if not bpy.app.background:
            show_picture(context, image)


def _told(job: Job, result: dict[str, Any]) -> str:
    line = f"{job.label}: {result['words']}"
    if job.place is not None:
        line += f"; {len(result['files'])} files in {job.place.folder}{job.place.words}"
    return line


def _keep_log(job: Job) -> None:
    """Log the last words of a process that has crashed, for a report of the fault."""
    if job.process is not None and not job.process.error and job.process.log():
        _log.error("%s: the process said:\n%s", job.label, job.process.log())
