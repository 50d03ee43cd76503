# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that are one field of a text of details, so that nobody has to type JSON.

Such a property stores nothing: it reads its field of the text, or gives the default where the text
has none, and writes it there. What the text says beside it stays, to its last bit.
"""

import json
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, cast

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    StringProperty,
)

from ...core.errors import SpecError
from ...model.reading import parse_json
from ..ids import Choice
from .values import shortest

type Group = bpy.types.PropertyGroup
type Fitting = Callable[[dict[str, Any]], dict[str, Any]]
"""Makes what a text says fit after a choice in it has changed."""


@dataclass(frozen=True)
class Field:
    """A field of a text.

    Attributes:
        text: Property that holds the text.
        path: Names down to the field, with dots between.
    """

    text: str
    path: str

    def read(self, group: Group) -> Any:
        """Value of the field, or None where the text does not have it."""
        here: Any = document(getattr(group, self.text))
        for name in self.path.split("."):
            if not isinstance(here, dict):
                return None
            here = cast("dict[str, Any]", here).get(name)
        return here

    def write(self, group: Group, value: object) -> None:
        """Give the field a value; None takes it out."""
        found = deepcopy(document(getattr(group, self.text)))
        here = found
        *folders, last = self.path.split(".")
        for name in folders:
            if not isinstance(here.get(name), dict):
                here[name] = {}
            here = here[name]
        if value is None:
            here.pop(last, None)
        else:
            here[last] = value
        setattr(group, self.text, json.dumps(found))


def in_details(path: str) -> Field:
    """Make a field of the text that most groups have, ``details``."""
    return Field("details", path)


@lru_cache(maxsize=64)
def document(text: str) -> dict[str, Any]:
    """Read a text of details.

    Args:
        text: What the property holds.

    Returns:
        The object, not to be written to; an empty one where the text is not a JSON object, which
        `details.read` tells the user.
    """
    try:
        found = parse_json(text or "{}")
    except SpecError:
        return {}
    return cast("dict[str, Any]", found) if isinstance(found, dict) else {}


def number(
    field: Field,
    name: str,
    words: str,
    default: float,
    limits: tuple[float, float] = (-1e30, 1e30),
    **look: Any,
) -> Any:
    """Make a property of a number.

    Args:
        field: The field.
        name: Label.
        words: Tooltip, with the unit.
        default: Number where the text has none.
        limits: Least and most.
        look: Further options of ``FloatProperty``, such as soft limits and precision.
    """

    def get(group: Group) -> float:
        value = field.read(group)
        return float(value) if is_number(value) else default

    def put(group: Group, value: float) -> None:
        field.write(group, _within(limits, value))

    low, high = limits
    return FloatProperty(
        name=name, description=words, min=low, max=high, get=get, set=put, options=set(), **look
    )


def whole(
    field: Field, name: str, words: str, default: int, limits: tuple[int, int], **look: Any
) -> Any:
    """Make a property of a whole number; see `number`."""

    def get(group: Group) -> int:
        value = field.read(group)
        return value if isinstance(value, int) else default

    def put(group: Group, value: int) -> None:
        field.write(group, max(limits[0], min(limits[1], value)))

    low, high = limits
    return IntProperty(
        name=name, description=words, min=low, max=high, get=get, set=put, options=set(), **look
    )


def vector(
    field: Field,
    name: str,
    words: str,
    default: Sequence[float],
    limits: tuple[float, float] = (-1e30, 1e30),
    **look: Any,
) -> Any:
    """Make a property of some numbers; of a longer list these are the first; see `number`."""
    size = len(default)

    def get(group: Group) -> list[float]:
        values = _numbers(field.read(group))
        return [*values, *default[len(values) :]][:size]

    def put(group: Group, value: Sequence[float]) -> None:
        rest = _numbers(field.read(group))[size:]
        field.write(group, [*(_within(limits, item) for item in value), *rest])

    low, high = limits
    return FloatVectorProperty(
        name=name,
        description=words,
        size=size,
        min=low,
        max=high,
        get=get,
        set=put,
        options=set(),
        **look,
    )


def flag(field: Field, name: str, words: str, *, default: bool = False) -> Any:
    """Make a property of a yes or no."""

    def get(group: Group) -> bool:
        value = field.read(group)
        return value if isinstance(value, bool) else default

    def put(group: Group, value: bool) -> None:
        field.write(group, value)

    return BoolProperty(name=name, description=words, get=get, set=put, options=set())


def word(field: Field, name: str, words: str, default: str = "", **look: Any) -> Any:
    """Make a property of a text; with ``subtype="FILE_PATH"`` of a file."""

    def get(group: Group) -> str:
        value = field.read(group)
        return value if isinstance(value, str) else default

    def put(group: Group, value: str) -> None:
        path = bpy.path.abspath(value) if look.get("subtype") == "FILE_PATH" else value
        field.write(group, path)

    return StringProperty(name=name, description=words, get=get, set=put, options=set(), **look)


def choice(
    field: Field,
    name: str,
    words: str,
    choices: type[Choice],
    default: Choice,
    fitting: Fitting | None = None,
) -> Any:
    """Make a property of one of several words.

    Args:
        field: The field.
        name: Label.
        words: Tooltip.
        choices: All of them.
        default: That where the text has none.
        fitting: Makes the rest of the text fit the new choice.
    """
    by_number = {item.number: item for item in choices}

    def get(group: Group) -> int:
        value = field.read(group)
        return (choices(value) if value in list(choices) else default).number

    def put(group: Group, value: int) -> None:
        field.write(group, by_number[value].value)
        if fitting is not None:
            found = fitting(deepcopy(document(getattr(group, field.text))))
            setattr(group, field.text, json.dumps(found))

    return EnumProperty(
        name=name,
        description=words,
        items=choices.items(),
        default=default,
        get=get,
        set=put,
        options=set(),
    )


def is_number(value: object) -> bool:
    """Tell whether a value of a text is a number."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def _numbers(value: object) -> list[float]:
    items = cast("list[object]", value) if isinstance(value, list) else []
    return [float(cast("float", item)) for item in items if is_number(item)]


def _within(limits: tuple[float, float], value: float) -> float:
    # Blender holds the slider within them, but not a script.
    return max(limits[0], min(limits[1], shortest(value)))
