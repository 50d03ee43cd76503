# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The material that panels and operators are about, which may be pinned."""

import bpy


def shown_material(context: bpy.types.Context) -> bpy.types.Material | None:
    """Find the material that a panel is about.

    Args:
        context: Of the panel or the operator.

    Returns:
        That of the properties editor, which may be pinned; else the active one of the active
        object; or None.
    """
    material = getattr(context, "material", None)
    if material is None and context.object is not None:
        material = context.object.active_material
    return material


def shown_hologram(context: bpy.types.Context) -> bpy.types.Material | None:
    """Find the material that a panel is about, if it is a hologram.

    Args:
        context: Of the panel or the operator.

    Returns:
        The material, or None.
    """
    material = shown_material(context)
    return material if material is not None and material.hologram.enabled else None


def why_not_editable(context: bpy.types.Context) -> str:
    """Say why there is no hologram here that an operator could change.

    Args:
        context: Of the operator.

    Returns:
        One sentence, or nothing where there is one.
    """
    material = shown_hologram(context)
    if material is None:
        return "Select an object whose active material is a hologram"
    if material.library is not None:
        return "The material is linked from another file; make it local first"
    return ""
