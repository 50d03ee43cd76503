# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writing of documents: specs as plain data, and as JSON text."""

import json
from collections.abc import Iterable
from typing import Any, cast

import msgspec

from .plain import plain

type Document = dict[str, Any]

_LINE = 80
_INDENT = "  "
_ABSENT = ("recording", "characteristic", "haze", "lookup")


def to_document(spec: msgspec.Struct) -> Document:
    """Turn a spec into plain data, every field written out.

    Args:
        spec: A hologram, a device, or a part of one.

    Returns:
        Objects, lists and numbers that give the same spec again; whole numbers without a point.
    """
    return cast("Document", _without_absent(plain(msgspec.to_builtins(spec))))


def _without_absent(value: object) -> object:
    """Leave out what is not there: one of recording and characteristic, no haze, and such."""
    if isinstance(value, list):
        return [_without_absent(item) for item in cast("list[object]", value)]
    if not isinstance(value, dict):
        return value
    return {
        name: _without_absent(item)
        for name, item in cast("Document", value).items()
        if item is not None or name not in _ABSENT
    }


def dump(spec: msgspec.Struct) -> str:
    """Write a spec as JSON text.

    Args:
        spec: A hologram, a device, or a part of one.

    Returns:
        The text: fields in fixed order, floats in the shortest form that reads back the same,
        lists of plain values on one line.
    """
    return _written(to_document(spec), "") + "\n"


def _written(value: object, indent: str) -> str:
    deeper = indent + _INDENT
    if isinstance(value, dict) and value:
        table = cast("Document", value)
        line = json.dumps(table, ensure_ascii=False, allow_nan=False)
        if _is_flat(table.values()) and len(line) <= _LINE:
            return line
        rows = [f"{json.dumps(name)}: {_written(item, deeper)}" for name, item in table.items()]
        return "{\n" + ",\n".join(deeper + row for row in rows) + "\n" + indent + "}"
    if isinstance(value, list) and not _is_flat(cast("list[object]", value)):
        rows = [deeper + _written(item, deeper) for item in cast("list[object]", value)]
        return "[\n" + ",\n".join(rows) + "\n" + indent + "]"
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _is_flat(values: Iterable[object]) -> bool:
    return not any(isinstance(value, dict | list) for value in values)
