# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a model that may vary over the element: a number, or a formula of the place."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from ...core.arrays import BoolArray, FloatArray
from ...core.efficiency.volume import Quantity
from ...core.formula import Formula, FormulaError
from ...core.formula.check import find_trouble
from ...core.formula.tokens import MAX_CHARACTERS
from ...core.units import m_to_mm
from .. import field_kinds, fields
from ..field_error import FieldError
from ..surface import SurfaceSpec

_LOOKED_AT = 65
"""Places along a side of the element where the value is looked at."""


class PlaceFormula(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A formula of x, y, r (in mm) and phi on the element, as for a characteristic function.

    Attributes:
        formula: The formula; its value has the unit of the field that it stands in.
    """

    formula: Annotated[str, Meta(max_length=MAX_CHARACTERS)]

    def __post_init__(self) -> None:
        """Read the formula."""
        field_kinds.text(self, "formula")
        try:
            self.parsed()
        except FormulaError as error:
            raise FieldError("formula", str(error), self.formula) from error

    def parsed(self) -> Formula:
        """Read the formula, or give it again."""
        return _read(self.formula)


type Varying = float | PlaceFormula
"""A number, or a formula of the place."""


def check(
    owner: Struct,
    field: str,
    *,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
) -> None:
    """Check a number that may be a formula; what the formula gives is looked at in `check_on`.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        at_least: Smallest number allowed, if any.
        above: Number that must be exceeded, if any.
        at_most: Largest number allowed, if any.

    Raises:
        FieldError: It is neither, or the number is outside the bounds.
    """
    if not isinstance(getattr(owner, field), PlaceFormula):
        fields.number(owner, field, at_least=at_least, above=above, at_most=at_most)


def check_on(
    value: Varying,
    path: str,
    surface: SurfaceSpec,
    *,
    at_least: float | None = None,
    above: float | None = None,
) -> None:
    """Check that a formula has an allowed value all over an element.

    Args:
        value: The number or the formula.
        path: Path of the field, for the message.
        surface: The element's surface.
        at_least: Smallest value allowed, if any.
        above: Value that must be exceeded, if any.

    Raises:
        FieldError: It has not; the message says where.
    """
    if not isinstance(value, PlaceFormula):
        return

    def inside(x: FloatArray, y: FloatArray) -> BoolArray:
        return surface.covers(np.stack((x, y, np.zeros_like(x)), axis=-1))

    width, height = (0.5 * side for side in surface.size_mm)
    trouble = find_trouble(value.parsed(), (-width, width, -height, height), inside)
    if trouble is not None:
        where = f"at x = {trouble.x:.6g} mm, y = {trouble.y:.6g} mm {trouble.what}"
        raise FieldError(
            path, f"must have a smooth value all over the surface: {where}", value.formula
        )
    x, y = _places(surface)
    found = np.where(inside(x, y), value.parsed().at(x, y), np.inf)
    lowest = np.unravel_index(np.argmin(found), found.shape)
    least = float(found[lowest])
    where = f"all over the surface; at x = {x[lowest]:.6g} mm, y = {y[lowest]:.6g} mm it is not"
    if above is not None and least <= above:
        raise FieldError(path, f"must be above {above:g} {where}", least)
    if at_least is not None and least < at_least:
        raise FieldError(path, f"must be at least {at_least:g} {where}", least)


def check_sum(values: Sequence[Varying], path: str, surface: SurfaceSpec, below: float) -> None:
    """Check that the sum of numbers or formulas stays below a bound all over an element.

    Args:
        values: The numbers and formulas.
        path: Path of the field, for the message.
        surface: The element's surface.
        below: Number that the sum must stay below.

    Raises:
        FieldError: It does not; the message says how large it gets.
    """
    x, y = _places(surface)
    total = sum((_value(value, x, y) for value in values), np.zeros_like(x))
    inside = surface.covers(np.stack((x, y, np.zeros_like(x)), axis=-1))
    most = float(np.max(np.where(inside, total, 0.0)))
    if most >= below:
        raise FieldError(
            path, f"must be below index - 1 = {below:g}, of all exposures in sum", most
        )


def _places(surface: SurfaceSpec) -> tuple[FloatArray, FloatArray]:
    """X and y in mm of places all over an element."""
    width, height = (0.5 * side for side in surface.size_mm)
    steps = np.linspace(-1.0, 1.0, _LOOKED_AT)
    x, y = np.meshgrid(width * steps, height * steps)
    return x, y


def _value(value: Varying, x: FloatArray, y: FloatArray) -> FloatArray:
    if isinstance(value, PlaceFormula):
        return value.parsed().at(x, y)
    return np.full_like(x, value)


def quantity(value: Varying, unit: float) -> Quantity:
    """Make the number or the function of the core.

    Args:
        value: The number or the formula.
        unit: One of its units, in SI.

    Returns:
        A number, or a function of places in metres.
    """
    if not isinstance(value, PlaceFormula):
        return value * unit
    parsed = value.parsed()

    def at(place: FloatArray) -> FloatArray:
        place_mm = m_to_mm(place)
        return parsed.at(place_mm[..., 0], place_mm[..., 1]) * unit

    return at


@lru_cache(maxsize=64)
def _read(text: str) -> Formula:
    return Formula.read(text)
