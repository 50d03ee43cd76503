# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in Blender's properties, which are float32.

A number is read back as the shortest decimal that is stored as the same float32: 532.1 comes back
as 532.1. So numbers of a document with up to 6 significant digits come back exactly, and those
from 0.001 to 1e9 with up to 7. Longer ones come back within a relative error of 1.2e-7, half of it
from storing and half from the decimal. Shares of the light are rounded down, so that their sum
stays valid: the longer ones come back within 2.4e-7.
"""

import math
from collections.abc import Sequence

import bpy
import numpy as np

from ...model.field_error import FieldError

_ROUNDING = 6e-8
"""Half a unit in the last place of a float32, relative."""

_SMALLEST = 2.0**-126
"""Smallest normal float32; below it there are fewer digits, and nothing to tell from zero."""


def shortest(value: float) -> float:
    """The shortest decimal that is stored as the same float32.

    Args:
        value: A number as Blender gives it.

    Returns:
        The number as a person would have typed it.
    """
    # Not str(): its digits follow numpy's print options, which any module may have changed.
    return float(np.format_float_scientific(np.float32(value), unique=True))


def rounded_down(share: float) -> float:
    """The largest float32 that does not come back larger than a share.

    Args:
        share: A number of at least 0.

    Returns:
        A number that Blender stores unchanged.
    """
    single = np.float32(share)
    if shortest(float(single)) > share:
        single = np.nextafter(single, np.float32(0.0))
    return float(single)


def number(group: bpy.types.PropertyGroup, field: str) -> float:
    """Read one number.

    Args:
        group: Group that holds the property.
        field: Its name.

    Returns:
        The number.
    """
    return shortest(getattr(group, field))


def numbers(group: bpy.types.PropertyGroup, field: str) -> list[float]:
    """Read a vector.

    Args:
        group: Group that holds the property.
        field: Its name.

    Returns:
        Its components.
    """
    return [shortest(value) for value in getattr(group, field)]


def store(
    group: bpy.types.PropertyGroup, field: str, value: float | Sequence[float], path: str
) -> None:
    """Write a number or a vector, and make sure that Blender has not changed it.

    Args:
        group: Group that holds the property.
        field: Its name.
        value: What it gets.
        path: Path of the group in the document, for the message.

    Raises:
        FieldError: The value is outside what the property can hold.
    """
    setattr(group, field, value)
    stored = getattr(group, field)
    pairs = zip(_listed(stored), _listed(value), strict=True)
    if not all(math.isclose(a, b, rel_tol=_ROUNDING, abs_tol=_SMALLEST) for a, b in pairs):
        raise FieldError(f"{path}.{field}", "is outside what a material can hold", value)


def _listed(value: float | Sequence[float]) -> list[float]:
    return [float(value)] if isinstance(value, int | float) else [float(item) for item in value]


def reset(group: bpy.types.PropertyGroup) -> None:
    """Give all properties of a group their defaults, and empty its lists.

    Args:
        group: The group; groups inside it stay as they are.
    """
    for prop in group.bl_rna.properties:
        if prop.identifier in _OWN_OF_BLENDER or prop.type == "POINTER":
            continue
        if prop.type == "COLLECTION":
            getattr(group, prop.identifier).clear()
        else:
            group.property_unset(prop.identifier)


def make_whole(group: bpy.types.PropertyGroup) -> None:
    """Let a file hold all groups inside a group, also those where all is as by default.

    Blender makes a group when it is first asked for, and can override a property of a linked file
    only where that file holds its group.

    Args:
        group: The outermost group.
    """
    for prop in group.bl_rna.properties:
        if prop.type == "POINTER" and _is_group(prop.fixed_type):
            make_whole(getattr(group, prop.identifier))


def _is_group(kind: bpy.types.Struct) -> bool:
    return kind.base is not None and kind.base.identifier == "PropertyGroup"


_OWN_OF_BLENDER = ("rna_type", "name")
