# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes to a document from the command line: ``path.to.field=value``."""

import copy
import json
from collections.abc import Iterable
from typing import Any, cast

from ..core.errors import SpecError
from .field_error import FieldError, show, show_name
from .plain import is_unicode
from .reading import parse_json

_DIGITS = 9
"""Of the number of an item in a list."""


def override(document: dict[str, Any], assignments: Iterable[str]) -> dict[str, Any]:
    """Change fields of a document that exist in it.

    An item of a list is named by its number from 0, or by its own ``name``:
    ``holograms.1.size_mm=[20, 20]``, ``holograms.out_coupler.efficiency.table={"T": {"0": 1}}``.
    A value is read as JSON, and as a plain text where it is not JSON. Names that a table does not
    hold yet are not added; the table is set as a whole.

    Args:
        document: Plain data with every field written out; left as it is.
        assignments: The changes, applied in turn.

    Returns:
        A changed copy; whether it is a valid document is for the reader to say.

    Raises:
        SpecError: If an assignment has no ``=``, or its path leads nowhere; the message lists the
            names that exist there.
    """
    changed = copy.deepcopy(document)
    for assignment in assignments:
        path, equals, text = assignment.partition("=")
        if not equals or not path:
            raise SpecError(f"--set: must be path.to.field=value, got {show(assignment)}")
        steps = path.strip().split(".")
        here: object = changed
        for depth, step in enumerate(steps):
            key = _key(here, step, ".".join(steps[: depth + 1]))
            if depth == len(steps) - 1:
                cast("Any", here)[key] = _value(path, text)
            else:
                here = cast("Any", here)[key]
    return changed


def _key(container: object, step: str, path: str) -> str | int:
    """Find the key of a step of the path, or say which steps there are."""
    names: list[str] = []
    if isinstance(container, dict):
        names = list(cast("dict[str, object]", container))
        if step in names:
            return step
    elif isinstance(container, list):
        items = cast("list[object]", container)
        if step.isascii() and step.isdigit() and len(step) <= _DIGITS and int(step) < len(items):
            return int(step)
        own = [_own_name(item, place) for place, item in enumerate(items)]
        if step in own:
            return own.index(step)
        names = own
    existing = ", ".join(names) if names else "nothing below it"
    raise SpecError(f"{show_name(path)}: no such field, there is: {existing}")


def _own_name(item: object, place: int) -> str:
    name = cast("dict[str, object]", item).get("name") if isinstance(item, dict) else None
    return name if isinstance(name, str) else str(place)


def _value(path: str, text: str) -> object:
    if not is_unicode(text):
        raise FieldError(path, "must be valid Unicode", text)
    try:
        json.loads(text)
    except (ValueError, RecursionError):
        return text
    try:
        return parse_json(text)
    except FieldError as error:
        raise error.inside(path) from error
    except SpecError as error:
        raise SpecError(f"{show_name(path)}: {error}") from error
