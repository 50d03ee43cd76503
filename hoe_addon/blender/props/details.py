# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a document that a material keeps as text: kinds that have no properties of their own.

The text is the JSON of that part without its kind, so that every number comes back to its last bit.
"""

import json
from collections.abc import Collection
from typing import Any, cast

from ...core.errors import SpecError
from ...model.field_error import FieldError, show
from ...model.reading import parse_json


def written(document: dict[str, Any], tag: str) -> str:
    """Write a part as text.

    Args:
        document: The part.
        tag: Name of the field that tells its kind.

    Returns:
        JSON of all its other fields.
    """
    return json.dumps({name: item for name, item in document.items() if name != tag})


def read(
    text: str, tag: str, kind: str, path: str, elsewhere: Collection[str] = ()
) -> dict[str, Any]:
    """Read a part back; what it says is checked with the rest of the document.

    Args:
        text: What `written` gave, or what a person typed.
        tag: Name of the field that tells its kind.
        kind: The kind.
        path: Path of the part in the document, for messages.
        elsewhere: Fields that are properties of their own, or stand in another text.

    Returns:
        The part as documents write it.

    Raises:
        SpecError: The text is not a JSON object, or has a field that does not belong in it; with
            the path.
    """
    try:
        document = parse_json(text or "{}")
    except SpecError as error:
        raise SpecError(f"{path}: {error}") from error
    if not isinstance(document, dict):
        raise FieldError(path, "must be a JSON object", show(document))
    found = cast("dict[str, Any]", document)
    for name in (tag, *elsewhere):
        if name in found:
            rule = "is set outside this text and must not stand in it"
            raise FieldError(f"{path}.{name}", rule, found[name])
    return {tag: kind, **found}
