# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems of a hologram, told in the panel that they belong to, with the button to mend them."""

import bpy

from ..facts.material import FACTS
from ..ids import Op
from ..wording import part_of
from .tables import problem


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
    role = _lost_source(words)
    if role:
        wave = getattr(material.hologram.recording, role)
        layout.prop(wave, "follows", text="Untick Follow", toggle=True, invert_checkbox=True)
    elif material.hologram.needs_bake:
        layout.operator(Op.BAKE_TABLE, icon="RENDER_STILL")
    elif material.library is None and material.hologram.problem and not _is_typed(words):
        layout.operator(Op.REFRESH, icon="FILE_REFRESH")


def _lost_source(words: str) -> str:
    """Role of the wave whose source object is wrong, or nothing."""
    path = words.partition(":")[0].split(".")
    return path[1] if path[0] == "recording" and path[-1] == "target" else ""


def _is_typed(words: str) -> bool:
    """Whether the field that is wrong stands right below, so that trying again is no help."""
    return "file" not in words and bool(part_of(words))


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
