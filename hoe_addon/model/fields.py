# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for single fields, used by every spec when it is made, from JSON or in Python.

Each checker reads a field of a frozen struct, tests it, and stores the plain Python value back
(a list, a numpy number or a Blender vector becomes a tuple of floats), so that a spec that exists
is valid and can always be written as JSON.
"""

import math
import numbers
from collections.abc import Iterable
from typing import cast

from msgspec import Struct
from msgspec.structs import force_setattr

from ..core.limits import MAX_ORDER as MAX_ORDER
from .field_error import FieldError

WAVELENGTH_RANGE_NM = (200.0, 20000.0)
MAX_ORDERS = 30
SHARE_SLACK = 1e-9

_LARGEST = 1e12
"""No length, index or luminance is larger; the squares of such numbers still fit into float32."""

_SMALLEST = 1e-18
"""No number that must be above 0 is smaller; the squares of such numbers are normal in float32."""


def _real(field: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise FieldError(field, "must be a number", value)
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise FieldError(field, "must be a finite number", value)
    if abs(number) > _LARGEST:
        raise FieldError(field, f"must be at most {_LARGEST:g} in size", value)
    return number


def _bounded(
    field: str,
    value: object,
    at_least: float | None,
    above: float | None,
    at_most: float | None,
) -> float:
    number = _real(field, value)
    if at_least is not None and number < at_least:
        raise FieldError(field, f"must be at least {at_least:g}", value)
    if above is not None and number <= above:
        raise FieldError(field, f"must be above {above:g}", value)
    if above == 0.0 and number < _SMALLEST:
        raise FieldError(field, f"must be at least {_SMALLEST:g}", value)
    if at_most is not None and number > at_most:
        raise FieldError(field, f"must be at most {at_most:g}", value)
    return number


def number(
    owner: Struct,
    field: str,
    *,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
) -> float:
    """Check a real, finite number.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        at_least: Smallest value allowed, if any.
        above: Value that must be exceeded, if any.
        at_most: Largest value allowed, if any.

    Returns:
        The number, as stored.

    Raises:
        FieldError: If it is not a number, not finite, or outside the bounds.
    """
    value = _bounded(field, getattr(owner, field), at_least, above, at_most)
    force_setattr(owner, field, value)
    return value


def wavelength(owner: Struct, field: str) -> float:
    """Check a vacuum wavelength in nm against the range that every model accepts.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.

    Returns:
        The wavelength in nm.

    Raises:
        FieldError: If it is not a number from 200 to 20000.
    """
    value = wavelength_value(field, getattr(owner, field))
    force_setattr(owner, field, value)
    return value


def wavelength_value(field: str, value: object) -> float:
    """Check one wavelength in nm that is not a field of a struct.

    Args:
        field: Name for the message.
        value: The wavelength.

    Returns:
        The wavelength in nm.

    Raises:
        FieldError: If it is not a number from 200 to 20000.
    """
    number_nm = _real(field, value)
    low, high = WAVELENGTH_RANGE_NM
    if not low <= number_nm <= high:
        raise FieldError(field, f"must be from {low:g} to {high:g} nm", value)
    return number_nm


def value(field: str, value: object) -> float:
    """Check one finite number that is not a field of a struct.

    Args:
        field: Name for the message.
        value: The number.

    Returns:
        The number.

    Raises:
        FieldError: If it is not a number, not finite, or too large.
    """
    return _real(field, value)


def share(field: str, value: object) -> float:
    """Check one share of the light.

    Args:
        field: Name for the message.
        value: The share.

    Returns:
        The share.

    Raises:
        FieldError: If it is not a number from 0 to 1.
    """
    return _bounded(field, value, 0.0, None, 1.0)


def vector(
    owner: Struct,
    field: str,
    size: int,
    *,
    above: float | None = None,
    at_most: float | None = None,
) -> tuple[float, ...]:
    """Check a fixed number of finite numbers.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        size: Number of components.
        above: Value that every component must exceed, if any.
        at_most: Largest value allowed for every component, if any.

    Returns:
        The components, as stored.

    Raises:
        FieldError: If the count or a component breaks its rule.
    """
    items = _sequence(field, getattr(owner, field))
    if len(items) != size:
        raise FieldError(field, f"must be {size} numbers", items)
    values = tuple(
        _bounded(f"{field}[{place}]", item, None, above, at_most)
        for place, item in enumerate(items)
    )
    force_setattr(owner, field, values)
    return values


def _sequence(field: str, value: object) -> list[object]:
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise FieldError(field, "must be a list", value)
    return list(cast("Iterable[object]", value))


def _whole(field: str, value: object, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise FieldError(field, "must be a whole number", value)
    whole = int(value)
    if not low <= whole <= high:
        raise FieldError(field, f"must be from {low} to {high}", value)
    return whole


def integer(owner: Struct, field: str, low: int, high: int) -> int:
    """Check a whole number within bounds, both included.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        low: Smallest value allowed.
        high: Largest value allowed.

    Returns:
        The number, as stored.

    Raises:
        FieldError: If it is not a whole number from ``low`` to ``high``.
    """
    value = _whole(field, getattr(owner, field), low, high)
    force_setattr(owner, field, value)
    return value


def integers(
    owner: Struct, field: str, low: int, high: int, *, size: int | None = None
) -> tuple[int, ...]:
    """Check a list of whole numbers within bounds.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        low: Smallest value allowed.
        high: Largest value allowed.
        size: How many there must be; any number if None.

    Returns:
        The numbers, as stored.

    Raises:
        FieldError: If the count is wrong, or an item is no whole number from ``low`` to ``high``.
    """
    items = _sequence(field, getattr(owner, field))
    if size is not None and len(items) != size:
        raise FieldError(field, f"must be {size} whole numbers", items)
    values = tuple(_whole(f"{field}[{place}]", item, low, high) for place, item in enumerate(items))
    force_setattr(owner, field, values)
    return values
