# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the text of a JSON file to plain data, strictly and soon, whatever the text is."""

import json
import math
from collections import Counter
from collections.abc import Iterable
from itertools import chain
from typing import Any, cast

from ..core.errors import SpecError
from .field_error import FieldError, join, show_name
from .plain import is_unicode

MAX_DEPTH = 64


class _Doubled(dict[str, Any]):
    """An object of the text in which a name stands twice."""

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        counts = Counter(name for name, _ in pairs)
        self.name = next(name for name, count in counts.items() if count > 1)


def parse_json(text: str) -> object:
    """Parse JSON strictly.

    Args:
        text: The text.

    Returns:
        Plain objects, lists, strings, finite numbers, booleans, None.

    Raises:
        SpecError: On bad syntax, a doubled name, a number that is not finite, or deep nesting.
    """
    try:
        document = json.loads(text, object_pairs_hook=_object)
    except json.JSONDecodeError as error:
        place = f"line {error.lineno} column {error.colno}"
        raise SpecError(f"{place}: is not valid JSON: {error.msg}") from error
    except ValueError as error:
        raise SpecError(f"holds a number that is not valid: {error}") from error
    except RecursionError as error:
        raise SpecError(f"is nested deeper than {MAX_DEPTH} levels") from error
    if not _is_plain([document], 0):
        raise _odd_place(document, "", 0)
    return document


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    plain = dict(pairs)
    return plain if len(plain) == len(pairs) else _Doubled(pairs)


def _is_plain(level: list[Any], depth: int) -> bool:
    """Tell whether values may stand in a document, all of a level at once: there may be millions.

    Args:
        level: Values as the parser gives them.
        depth: How deep in the document they stand.
    """
    while level:
        kinds = set(map(type, level))
        if _Doubled in kinds or (depth >= MAX_DEPTH and kinds & {dict, list}):
            return False
        objects: list[dict[str, Any]] = [item for item in level if type(item) is dict]
        lists: list[list[Any]] = [item for item in level if type(item) is list]
        texts: list[str] = [item for item in level if type(item) is str]
        texts += chain.from_iterable(objects)
        # A whole number may be too large for a float.
        numbers: list[float] = [item for item in level if type(item) in (int, float)]
        try:
            if not all(map(math.isfinite, numbers)) or not is_unicode("".join(texts)):
                return False
        except OverflowError:
            return False
        level = [*chain.from_iterable(map(_values, objects)), *chain.from_iterable(lists)]
        depth += 1
    return True


def _values(table: dict[str, Any]) -> Iterable[Any]:
    return table.values()


def _odd_place(value: Any, path: str, depth: int) -> SpecError:
    """Find the first place of a value that may not stand in a document, by halving."""
    if isinstance(value, dict | list) and depth >= MAX_DEPTH:
        return SpecError(f"is nested deeper than {MAX_DEPTH} levels")
    if isinstance(value, _Doubled):
        return FieldError(join(path, show_name(value.name)), "stands twice", value[value.name])
    if isinstance(value, dict):
        parts = list(cast("dict[str, Any]", value).items())
        place = _first_odd([list(part) for part in parts], depth + 1)
        name, item = parts[place]
        if not is_unicode(name):
            return FieldError(path, "must be valid Unicode", name)
        return _odd_place(item, join(path, show_name(name)), depth + 1)
    if isinstance(value, list):
        items = cast("list[Any]", value)
        place = _first_odd([[item] for item in items], depth + 1)
        return _odd_place(items[place], f"{path}[{place}]", depth + 1)
    rule = "must be valid Unicode" if isinstance(value, str) else "must be a finite number"
    return FieldError(path, rule, value)


def _first_odd(groups: list[list[Any]], depth: int) -> int:
    """Find the first group that is not plain, of which there is one."""
    first, last = 0, len(groups)
    while last - first > 1:
        middle = (first + last) // 2
        if _is_plain(list(chain(*groups[first:middle])), depth):
            first = middle
        else:
            last = middle
    return first
