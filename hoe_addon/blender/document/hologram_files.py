# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram of a material from and to a JSON file."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

from ...core.errors import HoeError
from ...files import write_text
from ...model.document import dump, load_hologram
from ..props.changes import mark_block
from ..props.followed import read_frame
from ..props.sync import read_spec, refresh, write_spec
from ..props.values import number


def import_hologram(material: bpy.types.Material, path: Path) -> str:
    """Make a material the hologram of a file; its place on the object stays.

    Args:
        material: The material.
        path: A JSON file of a hologram.

    Returns:
        Why the shader could not be made at once, such as that a table has to be baked; or nothing.

    Raises:
        HoeError: The file, field and value that are wrong; nothing is changed then.
    """
    if material.library is not None:
        raise HoeError(f"material {material.name}: is linked; make it local first")
    spec = load_hologram(path)
    frame, units = read_frame(material), number(material.hologram, "units_per_mm")
    with _trial() as trial:
        write_spec(trial, spec, frame, units)
    write_spec(material, spec, frame, units)
    mark_block(material)
    try:
        refresh(material, make=bpy.app.background)
    except HoeError as error:
        return str(error)
    return ""


def export_hologram(material: bpy.types.Material, path: Path) -> None:
    """Write the hologram of a material.

    Args:
        material: A hologram.
        path: A JSON file; one that is there is replaced.

    Raises:
        HoeError: The hologram is not valid, or the file cannot be written.
    """
    write_text(path, (dump(read_spec(material)),))


@contextmanager
def _trial() -> Iterator[bpy.types.Material]:
    """A material to find out whether properties can hold a document."""
    made = bpy.data.materials.new("Trial")
    try:
        yield made
    finally:
        bpy.data.materials.remove(made)
