# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a document may hold at a place: used to tell the user which names exist there."""

from collections.abc import Sequence
from functools import cache
from typing import Any, cast

import msgspec
from msgspec import inspect

type Part = str | int

WHOLE = "a whole number"

_WORDS = {
    "float": "a number",
    "int": WHOLE,
    "str": "a text",
    "bool": "true or false",
    "object": "an object",
    "array": "a list",
    "null": "null",
}


def in_words(expected: str) -> str:
    """Say in words what JSON types were expected.

    Args:
        expected: Types as msgspec writes them, e.g. ``float | str``.

    Returns:
        The same for a reader, e.g. ``a number or a text``.
    """
    words = [_WORDS.get(name, name) for name in expected.split(" | ")]
    if len(words) == 1:
        return words[0]
    return f"{', '.join(words[:-1])} or {words[-1]}"


def known_names(kind: type[msgspec.Struct], document: object, parts: Sequence[Part]) -> list[str]:
    """List the names that may stand at a place of a document.

    Args:
        kind: Struct of the whole document.
        document: The document as read; its tags choose among the kinds of a part.
        parts: Keys and indices down to the place.

    Returns:
        Field names of a struct, tags of a union of structs, or the values of a choice, behind
        them `WHOLE` where that may stand too; empty where anything of a type may stand.
    """
    info: inspect.Type | None = _type_info(kind)
    here = document
    for place, part in enumerate(parts):
        chosen = _struct_for(info, here)
        if chosen is not None and chosen.tag_field == part and place == len(parts) - 1:
            return [str(struct.tag) for struct in _structs(info)]
        info = _inside(chosen or info, part)
        here = _item(here, part)
    choices = [member for member in _members(info) if isinstance(member, inspect.LiteralType)]
    if choices:
        names = [str(value) for member in choices for value in member.values]
        numbers = any(isinstance(member, inspect.IntType) for member in _members(info))
        return [*names, WHOLE] if numbers else names
    chosen = _struct_for(info, here)
    if chosen is None:
        return []
    tag = [chosen.tag_field] if chosen.tag_field else []
    return [*tag, *(field.encode_name for field in chosen.fields)]


@cache
def _type_info(kind: type[msgspec.Struct]) -> inspect.Type:
    """Look into a struct once: it takes longer than to read the document."""
    return inspect.type_info(kind)


def _members(info: inspect.Type | None) -> list[inspect.Type | None]:
    """The types that a value may have; a named union stands inside another as a whole."""
    if not isinstance(info, inspect.UnionType):
        return [info]
    return [member for part in info.types for member in _members(part)]


def _structs(info: inspect.Type | None) -> list[inspect.StructType]:
    return [member for member in _members(info) if isinstance(member, inspect.StructType)]


def _struct_for(info: inspect.Type | None, value: object) -> inspect.StructType | None:
    structs = _structs(info)
    for struct in structs:
        if struct.tag_field and _item(value, struct.tag_field) == struct.tag:
            return struct
    return structs[0] if structs else None


def _inside(info: inspect.Type | None, part: Part) -> inspect.Type | None:
    if isinstance(info, inspect.StructType):
        return next((field.type for field in info.fields if field.encode_name == part), None)
    for member in _members(info):
        if isinstance(member, inspect.VarTupleType | inspect.ListType):
            return member.item_type
        if isinstance(member, inspect.TupleType) and isinstance(part, int):
            return member.item_types[part]
        if isinstance(member, inspect.DictType):
            return member.value_type
    return None


def _item(value: object, part: Part) -> object:
    try:
        return cast("Any", value)[part]
    except (LookupError, TypeError):
        return None
