# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is recorded in an element: by two waves, or a characteristic function outright."""

from typing import Protocol, cast

import numpy as np
from msgspec import Struct

from ..core.units import mm_to_m
from . import field_kinds
from .characteristic import (
    CHARACTERISTICS,
    CharacteristicSpec,
    FormulaSpec,
    SampledSpec,
    SplineSpec,
)
from .characteristic.convert import characteristic_from
from .field_error import FieldError
from .recording import RecordingSpec
from .surface import SurfaceSpec

_LOOKED_AT = 8
"""Places along a side where the steepness is looked at; even, so that the centre is none."""

_STEEPEST = 1e6
"""Orders of any visible wavelength are evanescent long before; float32 squares go on to 1e38."""

_WITH_HOLES = (FormulaSpec, SampledSpec, SplineSpec)
"""Kinds that may have places where nothing is recorded."""

type PatternSpec = RecordingSpec | CharacteristicSpec
"""Both have ``wavelength_nm``."""


class HasPattern(Protocol):
    """A struct with the two fields, of which exactly one is given."""

    @property
    def recording(self) -> RecordingSpec | None:
        """The recording scheme."""
        ...

    @property
    def characteristic(self) -> CharacteristicSpec | None:
        """The characteristic function."""
        ...


def pattern_of(owner: HasPattern) -> PatternSpec:
    """Give what is recorded in an element.

    Args:
        owner: A hologram or a patch.

    Returns:
        Its recording scheme or its characteristic function.
    """
    found = owner.recording if owner.characteristic is None else owner.characteristic
    assert found is not None, "a checked element has one of the two"
    return found


def check(owner: Struct, surface: SurfaceSpec) -> None:
    """Check that an element has exactly one of ``recording`` and ``characteristic``.

    Args:
        owner: A hologram or a patch.
        surface: Its surface.

    Raises:
        FieldError: If it has none or both, or a source lies on the surface.
    """
    recording = getattr(owner, "recording", None)
    characteristic = getattr(owner, "characteristic", None)
    if recording is None and characteristic is None:
        raise FieldError("recording", "must be given, or characteristic instead", None)
    if recording is not None and characteristic is not None:
        raise FieldError(
            "characteristic", "must not be given beside recording", type(characteristic).__name__
        )
    if characteristic is not None:
        field_kinds.instance(owner, "characteristic", *CHARACTERISTICS)
        _check_formula(characteristic, surface)
        _check_steepness(characteristic, surface)
        return
    field_kinds.instance(owner, "recording", RecordingSpec)
    try:
        cast("RecordingSpec", recording).check_clear_of(surface)
    except FieldError as error:
        raise error.inside("recording") from error


def _check_steepness(characteristic: CharacteristicSpec, surface: SurfaceSpec) -> None:
    """Check that grad V is a number that float32 and the ray law can do something with."""
    half_width, half_height = (0.5 * mm_to_m(side) for side in surface.size_mm)
    steps = np.linspace(-1.0, 1.0, _LOOKED_AT)
    x, y = np.meshgrid(half_width * steps, half_height * steps)
    points = np.stack((x, y, np.zeros_like(x)), axis=-1)
    with np.errstate(over="ignore", invalid="ignore"):
        gradient = characteristic_from(characteristic).gradient(points)
    steepest = float(np.max(np.abs(gradient), where=~np.isnan(gradient), initial=0.0))
    overflown = not isinstance(characteristic, _WITH_HOLES) and bool(np.isnan(gradient).any())
    if overflown or not steepest <= _STEEPEST:
        rule = f"must have a gradient of at most {_STEEPEST:g} on the element"
        raise FieldError("characteristic", rule, "infinity" if overflown else steepest)


def _check_formula(characteristic: object, surface: SurfaceSpec) -> None:
    """Check that a formula has a value all over the surface."""
    if not isinstance(characteristic, FormulaSpec):
        return
    try:
        characteristic.check_on(surface)
    except FieldError as error:
        raise error.inside("characteristic") from error
