# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as people write them in JSON."""

import math
from typing import cast

_WHOLE_LIMIT = 2.0**53


def is_unicode(text: str) -> bool:
    """Tell whether a text can be written to a file: bytes that are no text leave odd halves in it.

    Args:
        text: Any text.

    Returns:
        Whether it holds no surrogates.
    """
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def plain(value: object) -> object:
    """Turn whole floats into integers and tuples into lists, all the way down.

    Args:
        value: Objects, lists, tuples, strings, numbers, booleans, None.

    Returns:
        The same data as JSON writes it; nothing changes in value.
    """
    if isinstance(value, dict):
        return {name: plain(item) for name, item in cast("dict[str, object]", value).items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in cast("list[object]", value)]
    if isinstance(value, float) and value.is_integer() and abs(value) < _WHOLE_LIMIT:
        # A whole number has no negative zero: that one stays a float.
        return value if value == 0.0 and math.copysign(1.0, value) < 0.0 else int(value)
    return value
