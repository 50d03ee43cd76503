# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for fields that are no numbers: texts, choices, flags, other structs."""

from collections.abc import Iterable
from typing import Any, cast

from msgspec import Struct

from .field_error import FieldError
from .plain import is_unicode


def flag(owner: Struct, field: str) -> bool:
    """Check a true or false.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.

    Returns:
        The value.

    Raises:
        FieldError: If it is anything else.
    """
    value = getattr(owner, field)
    if not isinstance(value, bool):
        raise FieldError(field, "must be true or false", value)
    return value


def text(owner: Struct, field: str, *, empty: bool = False) -> str:
    """Check a string that can be stored and shown.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        empty: Whether an empty string is allowed.

    Returns:
        The string.

    Raises:
        FieldError: If it is not a string, no valid Unicode, or is empty and must not be.
    """
    value = getattr(owner, field)
    if not isinstance(value, str):
        raise FieldError(field, "must be a text", value)
    if not empty and not value.strip():
        raise FieldError(field, "must not be empty", value)
    if not is_unicode(value):
        raise FieldError(field, "must be valid Unicode", value)
    return value


def choice(owner: Struct, field: str, known: Iterable[str]) -> str:
    """Check a name against the names that exist.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        known: Names that are allowed.

    Returns:
        The name.

    Raises:
        FieldError: If the name is not one of ``known``; the message lists them.
    """
    names = list(known)
    value = getattr(owner, field)
    if value not in names:
        raise FieldError(field, f"must be one of {', '.join(names)}", value)
    return cast("str", value)


def instance(owner: Struct, field: str, *types: type[Any]) -> None:
    """Check that a field holds one of the structs it should; matters for specs made in Python.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        types: Structs that are allowed.

    Raises:
        FieldError: If it holds anything else.
    """
    value = getattr(owner, field)
    if not isinstance(value, types):
        names = " or ".join(kind.__name__ for kind in types)
        raise FieldError(field, f"must be a {names}", value)
