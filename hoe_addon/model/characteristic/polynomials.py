# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Polynomials of the radius, or of x and y."""

from collections.abc import Sequence
from typing import Annotated, cast

from msgspec import Meta, Struct
from msgspec.structs import force_setattr

from .. import field_kinds, fields
from ..field_error import FieldError
from .unit import UNITS, Unit

MAX_COEFFICIENTS = 16
MAX_TERMS = 100
MAX_POWER = 20


class EvenRadialSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="even_radial"
):
    """V = c_1 rho^2 + c_2 rho^4 + ..., with rho = r / normalization_mm ("Binary 2").

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        coefficients: c_1, c_2, ..., in the unit; at most 16.
        normalization_mm: Radius where rho is 1, in mm.
        unit: Unit of V.
    """

    wavelength_nm: float
    coefficients: Annotated[tuple[float, ...], Meta(min_length=1, max_length=MAX_COEFFICIENTS)]
    normalization_mm: float = 1.0
    unit: Unit = "radians"

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.wavelength(self, "wavelength_nm")
        count = len(self.coefficients)
        if not 1 <= count <= MAX_COEFFICIENTS:
            raise FieldError("coefficients", f"must be 1 to {MAX_COEFFICIENTS} numbers", count)
        fields.vector(self, "coefficients", count)
        fields.number(self, "normalization_mm", above=0.0)
        field_kinds.choice(self, "unit", UNITS)


class PolynomialTerm(Struct, frozen=True, forbid_unknown_fields=True):
    """One term of a polynomial.

    Attributes:
        x: Power of x, 0 to 20.
        y: Power of y, 0 to 20.
        coefficient: Its factor, in the unit of V.
    """

    x: int
    y: int
    coefficient: float

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.integer(self, "x", 0, MAX_POWER)
        fields.integer(self, "y", 0, MAX_POWER)
        fields.number(self, "coefficient")


class PolynomialSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="polynomial"
):
    """V = sum of c u^i v^j, with u and v = x and y over normalization_mm ("Binary 1").

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        terms: The terms, each pair of powers once; at most 100.
        normalization_mm: Length where u and v are 1, in mm.
        unit: Unit of V.
    """

    wavelength_nm: float
    terms: Annotated[tuple[PolynomialTerm, ...], Meta(min_length=1, max_length=MAX_TERMS)]
    normalization_mm: float = 1.0
    unit: Unit = "radians"

    def __post_init__(self) -> None:
        """Check all fields, and that no term stands twice."""
        fields.wavelength(self, "wavelength_nm")
        fields.number(self, "normalization_mm", above=0.0)
        field_kinds.choice(self, "unit", UNITS)
        terms = tuple(cast("Sequence[object]", self.terms))
        if not 1 <= len(terms) <= MAX_TERMS:
            raise FieldError("terms", f"must be 1 to {MAX_TERMS} terms", len(terms))
        seen: set[tuple[int, int]] = set()
        for place, term in enumerate(terms):
            if not isinstance(term, PolynomialTerm):
                raise FieldError(f"terms[{place}]", "must be a PolynomialTerm", term)
            powers = (term.x, term.y)
            if powers in seen:
                raise FieldError(f"terms[{place}]", "must not repeat the powers x, y", powers)
            seen.add(powers)
        force_setattr(self, "terms", terms)
