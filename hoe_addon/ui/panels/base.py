# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One definition of a panel for each place that it is drawn in."""

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import bpy

from ..ids import TAB

_PIXELS_PER_LETTER = 6.5
"""Mean width of a letter at a scale of 1; words are wrapped by it."""
_MARGIN_PIXELS = 60.0
_FEWEST_LETTERS = 24


@dataclass(frozen=True)
class Place:
    """Where panels stand.

    Attributes:
        suffix: End of the names of its classes.
        attributes: What Blender calls the place.
        shift: Added to the order of panels that are no part of others.
    """

    suffix: str
    attributes: dict[str, Any] = field(hash=False)
    shift: int = 0


SIDEBAR = Place("sidebar", {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": TAB})


def _properties(tab: str, shift: int = 0) -> Place:
    space = {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": tab}
    return Place(tab, space, shift)


# Right below what makes the surface; Blender has 10 and more for what follows, and nothing below 0.
MATERIAL = _properties("material", -10)
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


def panel_classes(
    places: Iterable[Place], bodies: Sequence[type[Body]]
) -> tuple[type[bpy.types.Panel], ...]:
    """Make Blender's classes.

    Args:
        places: Where the panels stand.
        bodies: What they show; each after its parent.

    Returns:
        One class for each place and body, in an order in which they can be registered.
    """
    return tuple(_panel(body, place) for place in places for body in bodies)


def _panel(body: type[Body], place: Place) -> type[bpy.types.Panel]:
    name = idname(body, place)
    attributes: dict[str, Any] = {
        "__module__": body.__module__,
        "__doc__": body.__doc__,
        "bl_idname": name,
        "bl_order": body.bl_order,
        **place.attributes,
    }
    if body.parent is None:
        attributes["bl_order"] = max(0, body.bl_order + place.shift)
    else:
        attributes["bl_parent_id"] = idname(body.parent, place)
        attributes["bl_options"] = {"DEFAULT_CLOSED"}
    return type(name, (body, bpy.types.Panel), attributes)


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


_UNITS = {"_nm": "nm", "_um": "\N{MICRO SIGN}m", "_mm": "mm", "_deg": "deg"}


def with_unit(
    layout: bpy.types.UILayout, owner: bpy.types.bpy_struct, field: str, label: str = ""
) -> None:
    """Lay out a number with its unit in the label, as the end of its name tells it.

    Args:
        layout: Where.
        owner: Group that has the property.
        field: The property; of a vector the label is left as it is, since it is long already.
        label: Label in the place of its own.
    """
    prop = owner.bl_rna.properties[field]
    unit = _UNITS.get(f"_{field.rpartition('_')[2]}")
    text = label or prop.name
    if unit is not None and not getattr(prop, "is_array", False):
        text = f"{text} ({unit})"
    layout.prop(owner, field, text=text)


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
