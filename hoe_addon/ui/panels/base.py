# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One definition of a panel for each place that it is drawn in."""

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import bpy

from ...blender.registration import BlenderClass, Registrar, class_registrars
from ..ids import TAB

_PIXELS_PER_LETTER = 6.5
"""Mean width of a letter at a scale of 1; words are wrapped by it."""
_MARGIN_PIXELS = 60.0
_FEWEST_LETTERS = 24
_UNIT_WIDTH, _LETTER_WIDTH = 0.7, 0.35
"""Of what stands behind a number, in widths of a button with an icon."""


@dataclass(frozen=True)
class Place:
    """Where panels stand.

    Attributes:
        suffix: End of the names of its classes.
        attributes: What Blender calls the place.
        under: Panel of Blender that they stand in, where it is there.
    """

    suffix: str
    attributes: dict[str, Any] = field(hash=False)
    under: str = ""


SIDEBAR = Place("sidebar", {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": TAB})


def _properties(tab: str, suffix: str = "", under: str = "") -> Place:
    space = {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": tab}
    return Place(suffix or tab, space, under)


# Right below the name of the material: below Surface, dozens of sockets would come before them.
MATERIAL = (
    _properties("material", under="CYCLES_PT_context_material"),
    _properties("material", "material_eevee", under="EEVEE_MATERIAL_PT_context_material"),
)
SCENE, RENDER = _properties("scene"), _properties("render")


class Body:
    """What a panel shows, wherever it stands.

    Attributes:
        name: Middle of the names of its classes.
        bl_label: Its title.
        bl_order: Lower ones stand higher; the banner of the tab has 0.
        parent: Panel that it is part of; such panels are closed at first.
    """

    name: ClassVar[str]
    bl_label: ClassVar[str]
    bl_order: ClassVar[int] = 0
    parent: ClassVar["type[Body] | None"] = None
    layout: bpy.types.UILayout

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether there is something to show; asked at every redraw."""
        del context
        return True


def idname(body: type[Body], place: Place) -> str:
    """Name by which Blender knows a panel in a place.

    Args:
        body: What it shows.
        place: Where.

    Returns:
        The name.
    """
    return f"HOE_PT_{body.name}_{place.suffix}"


def panel_registrars(
    places: Iterable[Place], bodies: Sequence[type[Body]], others: Sequence[BlenderClass] = ()
) -> tuple[Registrar, Registrar]:
    """Make the pair of functions that a module with panels has.

    Args:
        places: Where the panels stand.
        bodies: What they show; each after its parent.
        others: Classes that they need.

    Returns:
        ``register`` and ``unregister``, for one class of each place and body.
    """
    under = {_panel(body, place): place.under for place in places for body in bodies}
    register_classes, unregister = class_registrars((*others, *under))

    def register() -> None:
        for panel, parent in under.items():
            if parent and not panel.is_part:
                # Without Cycles its panels are not there; then ours stand by themselves.
                panel.bl_parent_id = parent if hasattr(bpy.types, parent) else ""
        register_classes()

    return register, unregister


def _panel(body: type[Body], place: Place) -> type[bpy.types.Panel]:
    name = idname(body, place)
    attributes: dict[str, Any] = {
        "__module__": body.__module__,
        "__doc__": body.__doc__,
        "bl_idname": name,
        "bl_order": body.bl_order,
        "is_part": body.parent is not None,
        **place.attributes,
    }
    if body.parent is not None:
        attributes["bl_parent_id"] = idname(body.parent, place)
        attributes["bl_options"] = {"DEFAULT_CLOSED"}
    return type(name, (body, bpy.types.Panel), attributes)


def split_layout(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """Begin a panel of properties, in Blender's usual two columns.

    Args:
        layout: That of the panel.

    Returns:
        The same layout.
    """
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout


_UNITS = {
    "_per_mm": "/mm",
    "_cd_m2": "cd/m²",
    "_nm": "nm",
    "_um": "\N{MICRO SIGN}m",
    "_mm": "mm",
    "_deg": "deg",
}
"""By the end of a name; longer ends come first."""


def with_unit(
    layout: bpy.types.UILayout, owner: bpy.types.bpy_struct, field: str, label: str = ""
) -> None:
    """Lay out a number or a vector with its unit behind it, as the end of its name tells it.

    Blender's own units would scale values by the scene; these are mm in scenes of any unit.

    Args:
        layout: Where.
        owner: Group that has the property.
        field: The property.
        label: Label in the place of its own.
    """
    row = layout.row(align=True)
    row.prop(owner, field, text=label or owner.bl_rna.properties[field].name)
    unit = next((unit for end, unit in _UNITS.items() if field.endswith(end)), "")
    if unit:
        cell = row.row()
        cell.ui_units_x = _UNIT_WIDTH + _LETTER_WIDTH * len(unit)
        cell.label(text=unit)


def wrapped(
    layout: bpy.types.UILayout, context: bpy.types.Context, words: str, icon: str = "NONE"
) -> None:
    """Write a sentence on as many lines as the region is narrow.

    Args:
        layout: Where.
        context: Of the panel.
        words: The sentence.
        icon: Icon before its first line.
    """
    column = layout.column(align=True)
    column.scale_y = 0.8
    lines = textwrap.wrap(words, _letters(context), break_on_hyphens=False)
    for place, line in enumerate(lines or [""]):
        column.label(text=line, icon=icon if place == 0 else _indent(icon))


def _indent(icon: str) -> str:
    return "NONE" if icon == "NONE" else "BLANK1"


def _letters(context: bpy.types.Context) -> int:
    region = context.region
    if region is None:
        return 2 * _FEWEST_LETTERS
    scale = context.preferences.system.ui_scale
    letters = (region.width / scale - _MARGIN_PIXELS) / _PIXELS_PER_LETTER
    return max(_FEWEST_LETTERS, int(letters))
