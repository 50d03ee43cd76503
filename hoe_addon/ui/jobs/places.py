# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where results go: beside the file, each in a folder with a number of its own."""

import os
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import bpy

from ...files import OutputError, writable_folder

_FOLDER = "renders"
_UNSAVED = "hologram_renders" + (f"_{os.getuid()}" if hasattr(os, "getuid") else "")
"""Where several users share the folder for temporary files, each has one of their own in it."""


@dataclass(frozen=True)
class Place:
    """A folder for results.

    Attributes:
        folder: The folder, which can be written.
        made: Folders that were made for it, the inner ones first; they go if they stay empty.
        words: What to tell about it.
    """

    folder: Path
    made: tuple[Path, ...]
    words: str = ""


def given_place(folder: str) -> Place:
    """The folder that the user has named; files of the same names in it are replaced.

    Args:
        folder: Its path; ``//`` stands for the folder of the open file.

    Returns:
        The folder.

    Raises:
        OutputError: It cannot be written.
    """
    path = Path(bpy.path.abspath(folder))
    new = [each for each in (path / "views", path, *path.parents) if not each.exists()]
    return Place(writable_folder(path), tuple(new))


def next_place(scene: bpy.types.Scene, kind: str) -> Place:
    """A new folder beside the open file, or in the folder for temporary files.

    Args:
        scene: Its name is in the path.
        kind: Kind of work, the beginning of the folder's name.

    Returns:
        The folder, which is empty.

    Raises:
        OutputError: It cannot be made.
    """
    if bpy.data.filepath:
        top, words = Path(bpy.data.filepath).parent / _FOLDER, ""
    else:
        # Blender's own temporary folder goes when it quits; its parent stays.
        top = Path(bpy.app.tempdir).parent / _UNSAVED
        words = "; the file is not saved yet, so the results are with the temporary files"
    parent = top / bpy.path.clean_name(scene.name)
    new = [each for each in (parent, top) if not each.exists()]
    writable_folder(parent)
    folder = _numbered(parent, kind)
    return Place(folder, (folder / "views", folder, *new), words)


def _numbered(parent: Path, kind: str) -> Path:
    """Make the folder with the next number; another Blender may be doing the same."""
    for number in count(1):
        folder = parent / f"{kind}_{number:03}"
        try:
            folder.mkdir()
        except FileExistsError:
            continue
        except OSError as error:
            raise OutputError(f"{folder}: cannot be written: {error.strerror or error}") from error
        return folder
    raise AssertionError("numbers have no end")
