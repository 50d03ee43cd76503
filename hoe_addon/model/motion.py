# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves carried from one frame to another."""

from typing import Any, cast

import msgspec
import numpy as np

from ..core.arrays import FloatArray, as_float
from .field_error import FieldError
from .plain import plain
from .reading import to_spec
from .waves import WaveSpec

POINT_FIELDS = frozenset({"position_mm", "vertex_mm", "first_mm", "second_mm"})
"""Fields of a wave that are points."""

DIRECTION_FIELDS = frozenset({"direction", "normal", "x_axis", "line_direction"})
"""Fields of a wave that are directions."""


def to_wave(document: object) -> WaveSpec:
    """Make a wave from plain data.

    Args:
        document: The wave as documents write it.

    Returns:
        The valid wave.

    Raises:
        SpecError: With the path of the field inside the wave, the rule, and the value.
    """
    try:
        return to_spec({"wave": document}, _Holder).wave
    except FieldError as error:
        raise error.moved(error.field.removeprefix("wave.")) from error


class _Holder(msgspec.Struct, frozen=True):
    """Only structs can be read; this one holds a wave."""

    wave: WaveSpec


def moved(wave: WaveSpec, rotation: FloatArray, origin_mm: FloatArray) -> WaveSpec:
    """Give a wave, stated in one frame, in the frame around it.

    Args:
        wave: The wave in its own frame.
        rotation: Orthogonal matrix whose columns are the axes of that frame, shape ``(3, 3)``.
        origin_mm: Its origin in the frame around, mm, shape ``(3,)``.

    Returns:
        The same wave in the frame around.

    Raises:
        SpecError: A number grows beyond what a document may hold.
    """
    document = _moved(plain(msgspec.to_builtins(wave)), as_float(rotation), origin_mm)
    return to_wave(document)


def _moved(value: Any, rotation: FloatArray, origin_mm: FloatArray) -> Any:
    if isinstance(value, list):
        return [_moved(item, rotation, origin_mm) for item in cast("list[Any]", value)]
    if not isinstance(value, dict):
        return value
    carried: dict[str, Any] = {}
    for name, item in cast("dict[str, Any]", value).items():
        if name in POINT_FIELDS:
            carried[name] = (rotation @ np.asarray(item) + origin_mm).tolist()
        elif name in DIRECTION_FIELDS:
            carried[name] = (rotation @ np.asarray(item)).tolist()
        else:
            carried[name] = _moved(item, rotation, origin_mm)
    return carried
