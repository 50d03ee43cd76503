# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Job: the picture that the eye sees through the device of a scene."""

from typing import Any

from .session import Work


def run(work: Work) -> dict[str, Any]:
    """Render and keep the results.

    Args:
        work: The job; its setting ``denoise`` says whether the PNG is denoised.

    Returns:
        What the window shows of it.
    """
    from ...blender.pictures.asked_view import keep_asked_view
    from ...files import VIEW_FILES
    from ...model.quality import requested
    from .scene import lean_device

    device = lean_device(work)
    made = keep_asked_view(
        device,
        requested(device.spec.render.quality),
        work.out,
        clean=work.settings["denoise"],
        started=work.started,
        progress=work.progress,
        noted=lambda error: work.note(f"error {error:.2g} so far"),
        stopped=work.leash.stopped,
    )
    return {
        "words": made.words(),
        "stopped": made.stopped,
        "folder": str(made.folder),
        "picture": str(made.folder / "view.exr"),
        "files": list(VIEW_FILES),
    }
