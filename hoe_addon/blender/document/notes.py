# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each part of a scene was last made of: notes that lie with the part in its datablock."""

import hashlib
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bpy

_SIZE_OF = "size of "
_SAME_SIZE = 1e-4
"""Share by which the size of a part may differ: turning a device brings rounding."""


@dataclass(frozen=True)
class Part:
    """One part of a scene.

    Attributes:
        name: Its name among those of its owner.
        owner: Property group that keeps its digest in ``made_of``.
        what: All that it is made of, as plain data.
        make: Makes it anew.
        size: How large it stands in the scene, where it depends on that.
    """

    name: str
    owner: bpy.types.PropertyGroup
    what: Any
    make: Callable[[], None]
    size: float | None = None


def is_made(part: Part) -> bool:
    """Tell whether a part is as it was last made."""
    made = _made_of(part)
    if made.get(part.name) != _digest(part.what):
        return False
    size = made.get(_SIZE_OF + part.name, 1.0)
    return part.size is None or (
        isinstance(size, float) and math.isclose(size, part.size, rel_tol=_SAME_SIZE)
    )


def note(part: Part) -> None:
    """Note that a part is made."""
    made = _made_of(part) | {part.name: _digest(part.what)}
    if part.size is not None:
        made[_SIZE_OF + part.name] = part.size
    part.owner.made_of = json.dumps(made)


def forget(part: Part) -> None:
    """Note that a part has to be made anew."""
    made = _made_of(part)
    if made.pop(part.name, None) is not None:
        part.owner.made_of = json.dumps(made)


def _made_of(part: Part) -> dict[str, Any]:
    try:
        found = json.loads(part.owner.made_of or "{}")
    except (ValueError, RecursionError):
        # A file of a stranger may hold any text; all is made anew then.
        return {}
    return found if isinstance(found, dict) else {}


def _digest(what: Any) -> str:
    text = json.dumps(what, sort_keys=True)
    return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()
