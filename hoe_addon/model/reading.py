# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the text of a JSON file to a valid spec; every mistake is named with its place and value.

Files may come from strangers: their size and depth are limited, and nothing in them is run.
"""

import re
import stat
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import msgspec

from ..core.errors import SpecError
from .field_error import FieldError, join, show_name
from .json_text import parse_json as parse_json
from .known import WHOLE, Part, in_words, known_names

MAX_BYTES = 8 * 2**20

_PLACE = re.compile(r"^(?P<what>.*?)(?: - at `(?P<key>key in )?\$(?P<path>.*)`)?$", re.DOTALL)
_STEP = re.compile(r"\.(?P<name>[^.\[]+)|\[(?P<index>\d+|\.\.\.)\]")
_LENGTH = re.compile(r"Expected `array` of length (?P<length>[^,]+)(?:, got \d+)?")
_TEXT_LENGTH = re.compile(r"Expected `str` of length <= (?P<length>\d+)")
_TYPE = re.compile(r"Expected `(?P<expected>.+)`, got `(?P<got>.+)`")
_JSON_TYPES = {"dict": "object", "list": "array", "NoneType": "null"}


@contextmanager
def naming(source: str | Path) -> Generator[None]:
    """Put the name of a file before the message of every SpecError raised inside.

    Args:
        source: The file, as the user gave it.

    Yields:
        Nothing.

    Raises:
        SpecError: The same error, its message starting with ``FILE:``.
    """
    try:
        yield
    except SpecError as error:
        raise SpecError(f"{source}: {error}") from error


def read_text(path: str | Path, max_bytes: int = MAX_BYTES) -> str:
    """Read a text file that may be anything.

    Args:
        path: The file.
        max_bytes: Size above which it is refused.

    Returns:
        The text, without a byte-order mark.

    Raises:
        SpecError: If it cannot be read, is too large, or is not UTF-8.
    """
    try:
        mode = Path(path).stat().st_mode
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            # Opening a pipe could wait for ever.
            raise SpecError("cannot be read: not a regular file")
        with Path(path).open("rb") as file:
            data = file.read(max_bytes + 1)
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise SpecError(f"cannot be read: {reason}") from error
    if len(data) > max_bytes:
        raise SpecError(f"cannot be read: larger than {max_bytes // 2**20} MB")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SpecError(f"cannot be read: not UTF-8 text at byte {error.start}") from error


def to_spec[S: msgspec.Struct](document: object, kind: type[S]) -> S:
    """Turn plain data into a valid spec.

    Args:
        document: Objects, lists, strings and numbers, as JSON gives them.
        kind: Struct of the whole document.

    Returns:
        The spec.

    Raises:
        SpecError: With the path of the field, the rule, and the value.
    """
    try:
        return msgspec.convert(document, kind, strict=True)
    except msgspec.ValidationError as error:
        told = _explain(error, document, kind)
        raise told.moved(_with_names(told.field, document)) from error


def _with_names(field: str, document: object) -> str:
    """Add the names of numbered things to a path: ``elements[0] (lamp).size_mm``."""
    here = document

    def named(step: re.Match[str]) -> str:
        nonlocal here
        index = step["index"] or ""
        here = at(here, [int(index) if index.isdecimal() else step["name"] or index])
        name = at(here, ["name"]) if index else None
        return f"{step[0]} ({show_name(name)})" if isinstance(name, str) and name else step[0]

    return _STEP.sub(named, f".{field}")[1:]


def _explain(
    error: msgspec.ValidationError, document: object, kind: type[msgspec.Struct]
) -> FieldError:
    """Turn msgspec's complaint into one with our path, rule and value."""
    match = _PLACE.match(str(error))
    what, path = (match["what"], match["path"] or "") if match else (str(error), "")
    parts = _parts(path, document, what)
    cause = error.__cause__
    if isinstance(cause, FieldError):
        return cause.inside(_written(parts))
    name = re.search(r"field `(.*)`", what, re.DOTALL)
    if name and "missing" in what:
        return FieldError.told(_written([*parts, name[1]]), "is missing")
    if name:
        known = ", ".join(known_names(kind, document, parts))
        here = [*parts, name[1]]
        return FieldError(
            _written(here), f"is not a field here (known: {known})", at(document, here)
        )
    value = at(document, parts)
    if isinstance(value, float) and value.is_integer() and "`int" in what:
        # A whole number in another spelling, such as 1e9: its range is what matters.
        try:
            msgspec.convert(_with(document, parts, int(value)), kind, strict=True)
        except msgspec.ValidationError as other:
            cause = other.__cause__
            if isinstance(cause, FieldError) and cause.detail.startswith("must be from"):
                return cause.inside(_written(parts[:-1]))
    rule = _rule(what, known_names(kind, document, parts))
    return FieldError(_written(parts) or "document", rule, value)


def _with(document: object, parts: list[Part], value: object) -> object:
    """A copy of a document with another value at one place."""
    if not parts:
        return value
    first, rest = parts[0], parts[1:]
    if isinstance(document, dict):
        table = cast("dict[Part, object]", document)
        return {**table, first: _with(table.get(first), rest, value)}
    items = list(cast("list[object]", document))
    items[cast("int", first)] = _with(items[cast("int", first)], rest, value)
    return items


def _rule(what: str, known: list[str]) -> str:
    length = _LENGTH.match(what)
    if length:
        return f"must be a list of length {length['length'].replace('>=', 'at least')}"
    text = _TEXT_LENGTH.match(what)
    if text:
        return f"must be a text of at most {text['length']} characters"
    if known and known[-1] == WHOLE:
        return f"must be {', '.join(known[:-1])} or {WHOLE}"
    kind = _TYPE.match(what)
    if kind:
        return f"must be {in_words(kind['expected'])}"
    if known and what.startswith("Invalid"):
        return f"must be one of {', '.join(known)}"
    return what


def _parts(path: str, document: object, what: str) -> list[Part]:
    """Split msgspec's path; it writes ``[...]`` for a name in a free table, found by its type."""
    parts: list[Part] = []
    for step in _STEP.finditer(path):
        if step["name"] is not None:
            parts.append(step["name"])
        elif step["index"] != "...":
            parts.append(int(step["index"]))
        else:
            parts.append(_odd_one(at(document, parts), what))
    return parts


def _odd_one(table: object, what: str) -> str:
    kind = _TYPE.match(what)
    got = kind["got"] if kind else ""
    entries = cast("dict[str, object]", table) if isinstance(table, dict) else {}
    for name, item in entries.items():
        here = type(item).__name__
        if _JSON_TYPES.get(here, here) == got:
            return name
    return "..."


def at(document: object, parts: list[Part]) -> object:
    """Look a value up by its path.

    Args:
        document: Plain data.
        parts: Names and indices down to the value.

    Returns:
        The value, or None where the path ends early.
    """
    here: Any = document
    for part in parts:
        try:
            here = here[part]
        except (LookupError, TypeError):
            return None
    return here


def _written(parts: list[Part]) -> str:
    path = ""
    for part in parts:
        path = join(path, f"[{part}]" if isinstance(part, int) else show_name(part))
    return path
