# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the add-on may write: never beside its own files, which an update replaces."""

from pathlib import Path

import bpy


def own_folder() -> Path | None:
    """Find the folder that Blender gives this extension for what it makes for itself.

    Returns:
        The folder, which need not exist; None where this runs as a plain package.
    """
    # The extension is the folder with the manifest, two levels above this one.
    extension = (__package__ or "").rsplit(".", 2)[0]
    try:
        # Without create=True: where that fails, Blender prints a traceback and answers "".
        folder = bpy.utils.extension_path_user(extension, path="cache")
    except ValueError:
        return None
    return Path(folder) if folder else None
