# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Media as a document names them: a number, a catalogue name, or Sellmeier coefficients."""

from msgspec import Struct

from ..core import media
from ..core.errors import SpecError
from ..core.units import nm_to_m
from . import field_kinds, fields
from .field_error import FieldError


class SellmeierTerms(Struct, frozen=True, forbid_unknown_fields=True):
    """Coefficients of n^2 = a + sum_i b_i L^2 / (L^2 - c_i), L the wavelength in micrometres.

    Attributes:
        b: The three b, dimensionless.
        c_um2: The three c, in square micrometres.
        a: The constant, 1 for most glasses.
    """

    b: tuple[float, float, float]
    c_um2: tuple[float, float, float]
    a: float = 1.0

    def __post_init__(self) -> None:
        """Check every coefficient."""
        fields.number(self, "a")
        fields.vector(self, "b", 3)
        fields.vector(self, "c_um2", 3)


class SellmeierMedium(Struct, frozen=True, forbid_unknown_fields=True):
    """A medium of one's own.

    Attributes:
        sellmeier: The coefficients.
    """

    sellmeier: SellmeierTerms

    def __post_init__(self) -> None:
        """Check the kind of the coefficients."""
        field_kinds.instance(self, "sellmeier", SellmeierTerms)


type MediumRef = float | str | SellmeierMedium
"""A constant index, a name of ``core.media.CATALOGUE``, or own coefficients."""


def check(owner: Struct, field: str) -> None:
    """Check a medium of a document.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.

    Raises:
        FieldError: If the index is below 1, the name unknown, or the kind wrong.
    """
    value = getattr(owner, field)
    if isinstance(value, str):
        field_kinds.choice(owner, field, media.CATALOGUE)
    elif not isinstance(value, SellmeierMedium):
        fields.number(owner, field, at_least=1.0)


def index_at(owner: Struct, field: str, wavelength_nm: float) -> float:
    """Evaluate a medium where it is needed, so that a bad formula is found with its field.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        wavelength_nm: Vacuum wavelength in nm.

    Returns:
        The refractive index.

    Raises:
        FieldError: If the formula gives no index of at least 1 there.
    """
    value = getattr(owner, field)
    try:
        return float(medium_from(value).index(nm_to_m(wavelength_nm)))
    except SpecError as error:
        rule = f"must have an index of at least 1 at {wavelength_nm:g} nm"
        raise FieldError(field, rule, _plain(value)) from error


def medium_from(ref: MediumRef) -> media.Medium:
    """Make the medium that a document names.

    Args:
        ref: A constant index, a catalogue name, or own coefficients.

    Returns:
        The medium of the core.
    """
    if isinstance(ref, str):
        return media.by_name(ref)
    if isinstance(ref, SellmeierMedium):
        terms = ref.sellmeier
        return media.Medium(
            name="sellmeier",
            a=terms.a,
            b=terms.b,
            c_um2=terms.c_um2,
            range_nm=fields.WAVELENGTH_RANGE_NM,
            source="document",
        )
    return media.constant(ref)


def _plain(value: MediumRef) -> object:
    if isinstance(value, SellmeierMedium):
        terms = value.sellmeier
        return {"sellmeier": {"a": terms.a, "b": terms.b, "c_um2": terms.c_um2}}
    return value
