# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that are a medium in a text of details: a number, a name, or an object of its own."""

from typing import Any

from bpy.props import EnumProperty

from ..ids import Choice, catalogue_items
from .detail_fields import Field, Group, is_number


class Given(Choice):
    """How a medium of a text is given."""

    CONSTANT = "constant", 0, "Constant Index", "The same index at every wavelength"
    CATALOGUE = "catalogue", 1, "Catalogue", "A glass or plastic with published dispersion"
    OWN = "own", 2, "Own", "Numbers of one's own, in the text of the document"


_FIRST_GLASS = "N-BK7"
_SELLMEIER = {
    "sellmeier": {
        "b": [1.03961212, 0.231792344, 1.01046945],
        "c_um2": [0.00600069867, 0.0200179144, 103.560653],
    }
}
"""N-BK7 again, as a place to begin from."""


def medium_kind(field: Field, name: str, words: str, default: float) -> Any:
    """Make a property that tells how a medium is given: by a number, a name, or in the text."""
    numbers = {item.number: item for item in Given}

    def get(group: Group) -> int:
        value = field.read(group)
        if value is None or is_number(value):
            return Given.CONSTANT.number
        return (Given.CATALOGUE if isinstance(value, str) else Given.OWN).number

    def put(group: Group, value: int) -> None:
        kept = field.read(group)
        match numbers[value]:
            case Given.CONSTANT:
                field.write(group, kept if is_number(kept) else default)
            case Given.CATALOGUE:
                field.write(group, kept if isinstance(kept, str) else _FIRST_GLASS)
            case _:
                field.write(group, kept if isinstance(kept, dict) else dict(_SELLMEIER))

    return EnumProperty(
        name=name, description=words, items=Given.items(), get=get, set=put, options=set()
    )


def medium_name(field: Field) -> Any:
    """Make a property of the name of a medium of the catalogue."""
    items = catalogue_items()
    stored = {item[0]: item[3] for item in items}
    names = {item[3]: item[0] for item in items}

    def get(group: Group) -> int:
        value = field.read(group)
        return stored.get(value if isinstance(value, str) else "", stored[_FIRST_GLASS])

    return EnumProperty(
        name="Material",
        description="Glass or plastic of the catalogue",
        items=items,
        get=get,
        set=lambda group, value: field.write(group, names[value]),
        options=set(),
    )
