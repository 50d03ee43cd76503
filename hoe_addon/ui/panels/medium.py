# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A medium in a panel: only the fields of its kind."""

import bpy

from ...blender.ids import MediumKind

_FIELDS = {
    MediumKind.CONSTANT: ("index",),
    MediumKind.CATALOGUE: ("catalogue_name",),
    MediumKind.SELLMEIER: ("a", "b", "c_um2"),
}


def draw_medium(layout: bpy.types.UILayout, medium: bpy.types.PropertyGroup, label: str) -> None:
    """Lay out a medium.

    Args:
        layout: Where.
        medium: The medium.
        label: What it is of.
    """
    column = layout.column()
    column.prop(medium, "kind", text=label)
    for field in _FIELDS[MediumKind(medium.kind)]:
        column.prop(medium, field)
