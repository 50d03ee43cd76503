# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Start a job: a copy of the open file, and another process of the same Blender."""

import secrets
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy

from ...blender.job_files import COPY, Description, JobKind
from ...blender.quiet import captured_output
from ...core.errors import HoeError
from .job import Job
from .places import Place
from .worker import WorkerProcess

_START = """\
import sys
folder, source, addon, package = sys.argv[-4:]
if source:
    sys.path.insert(0, source)
import bpy
import addon_utils
from importlib import import_module
if addon:
    addon_utils.enable(addon)
else:
    import_module(package).register()
import_module(package + ".cli.worker").main(folder)
"""
"""What the process runs; its arguments are told as such, never as part of the text."""

_PACKAGE = __package__.removesuffix(".ui.jobs")


def command_line(folder: Path, program: str | None = None) -> list[str]:
    """The command that starts the process of a job.

    Args:
        folder: Folder of the job.
        program: Blender's program; that of this process by default, and none in the bpy module.

    Returns:
        Program and arguments.
    """
    program = bpy.app.binary_path if program is None else program
    addon, _, _ = _PACKAGE.rpartition(".")
    source = "" if addon else str(Path(__file__).resolve().parents[3])
    arguments = [str(folder), source, addon, _PACKAGE]
    if not program:
        return [sys.executable, "-c", _START, *arguments]
    # The copy is opened later, by the process itself, which says what is wrong with it.
    options = ["--background", "--disable-autoexec", "--python-exit-code", "1"]
    return [program, *options, "--python-expr", _START, "--", *arguments]


def launch(
    kind: JobKind,
    label: str,
    scene: bpy.types.Scene,
    place: Place | None = None,
    settings: Mapping[str, Any] | None = None,
) -> Job:
    """Start a job on a copy of the open file, which stays as it is.

    Args:
        kind: Kind of work.
        label: Its name for people.
        scene: The scene that it is about.
        place: Where the results go; None where there is nothing to keep.
        settings: What the kind of work needs besides.

    Returns:
        The job, which is at work.

    Raises:
        HoeError: The copy cannot be written, or the process not be started.
    """
    try:
        folder = Path(tempfile.mkdtemp(prefix="hoe_job_", dir=bpy.app.tempdir or None))
    except OSError as error:
        raise HoeError(f"{bpy.app.tempdir}: cannot be written: {error.strerror}") from error
    mark = f"hoe-{secrets.token_hex(8)}"
    out = "" if place is None else str(place.folder)
    job = Job(kind, label, folder, place, scene.session_uid)
    try:
        _save_copy(folder / COPY)
        description = Description(
            kind, mark, scene.name, out, scripts=runs_scripts(), settings=dict(settings or {})
        )
        description.write(folder)
        job.process = WorkerProcess(command_line(folder), folder, mark)
    except OSError as error:
        job.discard()
        raise HoeError(f"{label}: cannot be started: {error.strerror or error}") from error
    except BaseException:
        job.discard()
        raise
    return job


def runs_scripts() -> bool:
    """Whether scripts in the open file may run by themselves in a copy of it.

    They may where they do here; a file with scripts that start when it is opened needs the user's
    general consent, for nobody can tell whether they have been allowed to here.
    """
    if bpy.app.autoexec_fail:
        return False
    if bpy.context.preferences.filepaths.use_scripts_auto_execute:
        return True
    return not any(text.use_module for text in bpy.data.texts)


def _save_copy(path: Path) -> None:
    """Write all that is open; paths in it go on leading to the same files."""
    filepaths = bpy.context.preferences.filepaths
    kept = filepaths.file_preview_type
    try:
        filepaths.file_preview_type = "NONE"
        with captured_output():
            bpy.ops.wm.save_as_mainfile(
                filepath=str(path), copy=True, check_existing=False, relative_remap=True
            )
    except RuntimeError as error:
        raise HoeError(f"the copy of the file cannot be written: {error}") from error
    finally:
        filepaths.file_preview_type = kept
