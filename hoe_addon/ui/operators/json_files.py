# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators for JSON files have in common."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper


class _JsonFile:
    """A file that the user chooses."""

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @property
    def path(self) -> Path:
        """The file; ``//`` stands for the folder of the open .blend."""
        return Path(bpy.path.abspath(self.filepath))


class JsonImport(_JsonFile, ImportHelper):
    """Reads a JSON file."""

    bl_options = {"REGISTER", "UNDO"}


class JsonExport(_JsonFile, ExportHelper):
    """Writes a JSON file."""

    bl_options = {"REGISTER"}

    def suggested(self, context: bpy.types.Context) -> str:
        """Name of a new file, without its ending."""
        raise AssertionError("each kind of document says so")

    def invoke(self, context, event):
        """Suggest a name."""
        if not self.filepath:
            self.filepath = f"{bpy.path.clean_name(self.suggested(context))}.json"
        return super().invoke(context, event)
