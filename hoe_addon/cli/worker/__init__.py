# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work for Blender's window, in a process of its own; see `blender.job_files`.

The window starts it with the name of this package, so that nothing of the window has to be loaded.
"""

from importlib import import_module

from ...blender.job_files import JobKind

_MODULES = {
    JobKind.RENDER: "picture",
    JobKind.EYEBOX: "survey",
    JobKind.ACCURACY: "measurement",
    JobKind.BAKE: "baking",
}
"""Module of each kind of work, with ``run(work) -> dict``; loaded when it is asked for."""


def main(folder: str) -> None:
    """Do the job of a folder, and tell how it goes.

    Args:
        folder: Folder of the job.
    """
    from .session import run_job

    run_job(folder, lambda kind: import_module(f".{_MODULES[kind]}", __name__).run)
