# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a field that breaks a rule, and how paths and values are written in it."""

import json
from collections.abc import Iterable, Iterator
from typing import cast

from ..core.errors import SpecError, one_line
from .plain import plain

_SHOWN = 60
_LONGEST_PATH = 300


def show(value: object) -> str:
    """Write a value of a document for a one-line message.

    Args:
        value: Any value that JSON or Python may hold.

    Returns:
        The value as JSON (or its ``repr``), cut to a readable length.
    """
    text = ""
    for piece in _pieces(value):
        text += piece
        if len(text) > _SHOWN:
            return text[: _SHOWN - 3] + "..."
    return text


def _pieces(value: object) -> Iterator[str]:
    """Write a value piece by piece: it may be millions of numbers, of which few are shown."""
    if isinstance(value, dict):
        yield "{"
        for place, (name, item) in enumerate(cast("dict[object, object]", value).items()):
            yield f"{', ' if place else ''}{json.dumps(str(name))}: "
            yield from _pieces(item)
        yield "}"
    elif isinstance(value, list | tuple):
        yield "["
        for place, item in enumerate(cast("Iterable[object]", value)):
            yield ", " if place else ""
            yield from _pieces(item)
        yield "]"
    else:
        yield _single(value)


def _single(value: object) -> str:
    try:
        return json.dumps(plain(value))
    except (TypeError, ValueError):
        return " ".join(repr(value).split())


def show_name(name: str) -> str:
    """Write the name of a field, as a document has it, for a path.

    Args:
        name: Any text.

    Returns:
        The name, cut to a readable length.
    """
    return name if len(name) <= _SHOWN else name[: _SHOWN - 3] + "..."


def _line(field: str, detail: str) -> str:
    place = field if len(field) <= _LONGEST_PATH else field[: _LONGEST_PATH - 3] + "..."
    return one_line(f"{place}: {detail}")


class FieldError(SpecError, ValueError):
    """A field breaks a rule; it is a ValueError too, so that msgspec adds where the struct stands.

    Attributes:
        field: Path of the field inside its own struct, e.g. ``position_mm[2]``.
        detail: The rule and the value got.
    """

    def __init__(self, field: str, rule: str, value: object) -> None:
        """Make the message ``field: rule, got value``."""
        self.field = field
        self.detail = f"{rule}, got {show(value)}"
        super().__init__(_line(field, self.detail))

    @classmethod
    def told(cls, field: str, detail: str) -> "FieldError":
        """Make the message ``field: detail``, where there is no value to show.

        Args:
            field: Path of the field inside its own struct.
            detail: What is wrong.

        Returns:
            The error.
        """
        error = cls(field, "", None)
        error.detail = detail
        error.args = (_line(field, detail),)
        return error

    def inside(self, parent: str) -> "FieldError":
        """Give the same complaint, seen from the struct around.

        Args:
            parent: Path of the struct that holds the field.

        Returns:
            A new error with the longer path.
        """
        return self.moved(join(parent, self.field))

    def moved(self, field: str) -> "FieldError":
        """Give the same complaint about another field, the one where the value came from.

        Args:
            field: Path of that field.

        Returns:
            A new error.
        """
        error = FieldError(field, "", None)
        error.detail = self.detail
        error.args = (_line(field, self.detail),)
        return error


def join(parent: str, child: str) -> str:
    """Join two parts of a field's path.

    Args:
        parent: Path of the outer field, may be empty.
        child: Path inside it, may be empty or start with an index in brackets.

    Returns:
        The whole path.
    """
    dot = "." if parent and child and not child.startswith("[") else ""
    return f"{parent}{dot}{child}"
