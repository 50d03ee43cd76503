# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Zernike polynomials."""

import re
from collections.abc import Callable, Mapping
from typing import Annotated, Literal, cast

from msgspec import Meta, Struct
from msgspec.structs import force_setattr

from ...core.characteristic.zernike import FRINGE_TERMS, fringe, noll
from .. import field_kinds, fields
from ..field_error import FieldError
from .unit import UNITS, Unit

MAX_POLYNOMIALS = 100

type Order = Callable[[int], tuple[int, int, float]]
"""n, m and the normalising factor by index; see ``core.characteristic.zernike``."""

ORDERS: Mapping[str, tuple[Order, int]] = {"noll": (noll, 496), "fringe": (fringe, FRINGE_TERMS)}
"""Function and largest index of each order; Noll's 496 is the last of degree 30."""

_INDEX = re.compile(r"[1-9][0-9]{0,2}")


class ZernikeSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="zernike"):
    """A sum of Zernike polynomials of rho = r / normalization_mm and the azimuth from x to y.

    ``noll``: indices from 1 (piston) in Noll's order, even ones cosines, each of rms 1 over the
    disk. ``fringe``: indices 1 to 37 in the order of the University of Arizona, each 1 at its
    largest; 37 is the twelfth power. Beyond rho = 1 the same polynomials go on.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        index: The order of the indices and the normalisation.
        coefficients: Factor by index, in the unit; the index is written as a text, as JSON wants.
        normalization_mm: Radius where rho is 1, in mm.
        unit: Unit of V.
    """

    wavelength_nm: float
    index: Literal["noll", "fringe"]
    coefficients: Annotated[dict[str, float], Meta(min_length=1, max_length=MAX_POLYNOMIALS)]
    normalization_mm: float
    unit: Unit

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.wavelength(self, "wavelength_nm")
        order = field_kinds.choice(self, "index", ORDERS)
        fields.number(self, "normalization_mm", above=0.0)
        field_kinds.choice(self, "unit", UNITS)
        force_setattr(self, "coefficients", _checked(order, self.coefficients))


def _checked(order: str, value: object) -> dict[str, float]:
    if not isinstance(value, Mapping):
        raise FieldError("coefficients", "must map indices to numbers", value)
    table = cast("Mapping[object, object]", value)
    if not 1 <= len(table) <= MAX_POLYNOMIALS:
        raise FieldError("coefficients", f"must be 1 to {MAX_POLYNOMIALS} numbers", len(table))
    most = ORDERS[order][1]
    found: dict[str, float] = {}
    for index, factor in table.items():
        name = str(index)
        if not _INDEX.fullmatch(name) or int(name) > most:
            rule = f"index must be a whole number from 1 to {most} in the {order} order"
            raise FieldError("coefficients", rule, name)
        found[name] = fields.value(f"coefficients.{name}", factor)
    return found
