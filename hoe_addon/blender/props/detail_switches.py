# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that switch between ways to give a field of a text of details."""

from copy import deepcopy
from typing import Any, cast

from bpy.props import BoolProperty

from .detail_fields import Field, Group, is_number


def presence(field: Field, name: str, words: str, made: object) -> Any:
    """Make a property that tells whether a field is there; switched on it becomes ``made``."""

    def put(group: Group, value: bool) -> None:
        field.write(group, deepcopy(made) if value else None)

    return BoolProperty(
        name=name,
        description=words,
        get=lambda group: field.read(group) is not None,
        set=put,
        options=set(),
    )


def either(
    field: Field, name: str, words: str, first: tuple[str, float], second: tuple[str, float]
) -> Any:
    """Make a property that tells which of two numbers an object has; True is the second.

    ``first`` and ``second`` are their names and where they begin.
    """

    def get(group: Group) -> bool:
        held = field.read(group)
        return isinstance(held, dict) and second[0] in held

    def put(group: Group, value: bool) -> None:
        held = cast("dict[str, Any]", field.read(group) or {})
        rest = {key: item for key, item in held.items() if key not in (first[0], second[0])}
        field.write(group, rest | dict([second if value else first]))

    return BoolProperty(name=name, description=words, get=get, set=put, options=set())


def varies(field: Field, name: str, words: str, default: float) -> Any:
    """Make a property that tells whether a field is a formula of the place, not a number."""

    def put(group: Group, value: bool) -> None:
        kept = field.read(group)
        if value != isinstance(kept, dict):
            start = {"formula": str(kept if is_number(kept) else default)}
            field.write(group, start if value else default)

    return BoolProperty(
        name=name,
        description=words,
        get=lambda group: isinstance(field.read(group), dict),
        set=put,
        options=set(),
    )
