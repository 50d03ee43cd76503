# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems of a hologram, told in the panel that they belong to, with the button to mend them."""

import bpy

from ..facts.material import FACTS
from ..ids import Op
from .tables import problem

_PARTS = {
    "surface": "Element",
    "media": "Element",
    "frame": "Element",
    "recording": "Recording",
    "characteristic": "Recording",
    "efficiency": "Efficiency",
    "orders": "Orders",
}
"""Panel that a field of the document is in."""


def problem_of(material: bpy.types.Material) -> str:
    """Say what is wrong with a hologram.

    Args:
        material: A hologram.

    Returns:
        One sentence that begins with the path of the field where it knows one; or nothing.
    """
    facts = FACTS.shown(material)
    told: str = material.hologram.problem
    return told or (facts.problem if facts is not None else "")


def part_of(words: str) -> str:
    """Find the panel that a problem belongs to.

    Args:
        words: The problem.

    Returns:
        Its title, or nothing.
    """
    return _PARTS.get(words.split(":")[0].split(".")[0].split("[")[0], "")


def is_about(words: str, path: str) -> bool:
    """Tell whether a problem is about a field or what is in it.

    Args:
        words: The problem.
        path: Path of the field.
    """
    return words.startswith((f"{path}.", f"{path}:", f"{path}["))


def draw_problem(
    layout: bpy.types.UILayout, context: bpy.types.Context, material: bpy.types.Material
) -> None:
    """Show the problem of a hologram, if it has one, in whole and with its button.

    Args:
        layout: Where.
        context: Of the panel.
        material: A hologram.
    """
    words = problem_of(material)
    if not words:
        return
    problem(layout, context, words)
    if material.hologram.needs_bake:
        layout.operator(Op.BAKE_TABLE, icon="RENDER_STILL")
    elif material.library is None and material.hologram.problem and not _is_typed(words):
        layout.operator(Op.REFRESH, icon="FILE_REFRESH")


def _is_typed(words: str) -> bool:
    """Whether the field that is wrong stands right below, so that trying again is no help."""
    return ".target" in words.partition(":")[0] or ("file" not in words and bool(part_of(words)))


def draw_part(
    layout: bpy.types.UILayout,
    context: bpy.types.Context,
    material: bpy.types.Material,
    *paths: str,
) -> None:
    """Show the problem of a hologram where it is about one of some fields.

    Args:
        layout: Where.
        context: Of the panel.
        material: A hologram.
        paths: Paths of the fields.
    """
    words = problem_of(material)
    if any(is_about(words, path) for path in paths):
        draw_problem(layout, context, material)
