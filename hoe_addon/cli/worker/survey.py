# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Job: the light guide of a scene, seen from all positions of its eyebox."""

from typing import Any

from .session import Work


def run(work: Work) -> dict[str, Any]:
    """Survey the eyebox and keep the results.

    Args:
        work: The job; its settings ``field_samples`` and ``denoise`` are those of the command.

    Returns:
        What the window shows of it.
    """
    from ...files import writable_folder
    from ..eyebox import EYEBOX_FILES, summary, view_files, write_survey
    from .scene import lean_device

    device = lean_device(work)
    folder = writable_folder(work.out, EYEBOX_FILES)
    views = writable_folder(folder / "views", view_files(device.guide_spec))
    samples, clean = work.settings["field_samples"], work.settings["denoise"]
    report = write_survey(device, folder, views, samples, clean, work.progress)
    done, (columns, rows) = len(report["positions"]), report["grid"]
    some = f"{done} of {columns * rows} positions; " if report["stopped_by_user"] else ""
    return {
        "words": some + summary(report),
        "stopped": report["stopped_by_user"],
        "folder": str(folder),
        "picture": str(folder / "eyebox.png"),
        "files": [*EYEBOX_FILES, "views"],
        "report": report,
    }
