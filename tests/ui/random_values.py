# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random values of properties, as a user may set them: by a slider, a menu, a field of text."""

import math
import random
from inspect import get_annotations
from typing import Any

import bpy

WIDE = 1e3
"""Ranges that are wider are not for dragging; the value is changed by a factor there."""

_TEXTS = ("", "Hologram", "out_coupler", "in coupler", "\N{GREEK SMALL LETTER ALPHA}/2", "a" * 80)
_COLLECTIONS = {"Object": "objects", "Material": "materials", "Image": "images"}


def random_value(rng: random.Random, owner: Any, name: str) -> Any:
    """Choose a value that a property takes.

    Args:
        rng: Random numbers.
        owner: What has the property.
        name: The property.

    Returns:
        The value.

    Raises:
        LookupError: There is none to choose.
    """
    prop = owner.bl_rna.properties[name]
    if prop.is_readonly:
        raise LookupError(name)
    count = getattr(prop, "array_length", 0)
    match prop.type:
        case "BOOLEAN":
            one = lambda _: rng.random() < 0.5  # noqa: E731
        case "INT":
            one = lambda now: round(_number(rng, prop, now))  # noqa: E731
        case "FLOAT":
            one = lambda now: _number(rng, prop, now)  # noqa: E731
        case "STRING":
            return rng.choice(_TEXTS)
        case "ENUM":
            return _item(rng, prop)
        case "POINTER":
            return _datablock(rng, owner, prop)
        case _:
            raise LookupError(name)
    now = getattr(owner, name)
    return [one(each) for each in now] if count else one(now)


def _number(rng: random.Random, prop: Any, now: float) -> float:
    low, high = prop.soft_min, prop.soft_max
    if rng.random() < 0.05:
        return rng.choice((prop.hard_min, prop.hard_max)) if high - low <= WIDE else 0.0
    if high - low <= WIDE:
        return rng.uniform(low, high)
    value = (now or 10.0) * math.exp(rng.gauss(0.0, 0.5)) * rng.choice((1.0, 1.0, -1.0))
    return min(max(value, low), high)


def _item(rng: random.Random, prop: Any) -> Any:
    names = [item.identifier for item in prop.enum_items]
    if not names:
        raise LookupError(prop.identifier)
    return {rng.choice(names)} if prop.is_enum_flag else rng.choice(names)


def _datablock(rng: random.Random, owner: Any, prop: Any) -> Any:
    collection = _COLLECTIONS.get(prop.fixed_type.identifier)
    if collection is None:
        raise LookupError(prop.identifier)
    allowed = _poll(owner, prop.identifier)
    found = [block for block in getattr(bpy.data, collection) if allowed(owner, block)]
    if not prop.is_never_none:
        found.append(None)
    if not found:
        raise LookupError(prop.identifier)
    return rng.choice(found)


def _poll(owner: Any, name: str) -> Any:
    """What a field of the window offers; Python may set anything."""
    for kind in type(owner).__mro__:
        declared = get_annotations(kind).get(name)
        if declared is not None and "poll" in getattr(declared, "keywords", {}):
            return declared.keywords["poll"]
    if name == "camera":
        return lambda _owner, block: block.type == "CAMERA"
    return lambda _owner, _block: True
