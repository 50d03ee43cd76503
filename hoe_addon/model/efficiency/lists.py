# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for lists inside a field: rows of numbers, and lists of structs."""

from collections.abc import Iterable
from typing import cast

from msgspec import Struct
from msgspec.structs import force_setattr

from .. import fields
from ..field_error import FieldError


def listed(path: str, value: object, fewest: int, most: int) -> list[object]:
    """Check that a value is a list of an allowed length.

    Args:
        path: Path for the message.
        value: The value.
        fewest: Least number of items.
        most: Largest number of items.

    Returns:
        Its items.

    Raises:
        FieldError: It is no list, or too short or too long.
    """
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise FieldError(path, "must be a list", value)
    items = list(cast("Iterable[object]", value))
    if not fewest <= len(items) <= most:
        raise FieldError(path, f"must have from {fewest} to {most} items", len(items))
    return items


def rows(owner: Struct, field: str, words: tuple[str, ...], most: int) -> list[list[float]]:
    """Check a list of rows of finite numbers.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        words: What the numbers of a row are.
        most: Largest number of rows; there must be two at least.

    Returns:
        The rows; the struct gets tuples.

    Raises:
        FieldError: A row has another length, or holds what is no finite number.
    """
    found: list[list[float]] = []
    for place, row in enumerate(listed(field, getattr(owner, field), 2, most)):
        path = f"{field}[{place}]"
        items = listed(path, row, 0, most)
        if len(items) != len(words):
            raise FieldError(path, f"must be [{', '.join(words)}]", items)
        found.append([fields.value(f"{path}[{j}]", item) for j, item in enumerate(items)])
    force_setattr(owner, field, tuple(map(tuple, found)))
    return found


def structs[S: Struct](owner: Struct, field: str, kind: type[S], fewest: int, most: int) -> None:
    """Check a list of structs.

    Args:
        owner: Struct that holds the field; it gets a tuple.
        field: Name of the field.
        kind: Struct that every item has to be.
        fewest: Least number of items.
        most: Largest number of items.

    Raises:
        FieldError: An item is of another kind, or there are too few or too many.
    """
    items = listed(field, getattr(owner, field), fewest, most)
    for place, item in enumerate(items):
        if not isinstance(item, kind):
            raise FieldError(f"{field}[{place}]", f"must be a {kind.__name__}", item)
    force_setattr(owner, field, tuple(items))
