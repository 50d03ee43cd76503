# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of a grating as documents write them; other than media they may absorb."""

import numpy as np
from msgspec import Struct
from msgspec.structs import force_setattr

from ...core import media
from ...core.material import Material, TabulatedIndex
from ...core.units import nm_to_m
from .. import field_kinds, fields
from ..field_error import FieldError
from ..medium import MediumRef, SellmeierMedium, SellmeierTerms, medium_from
from .lists import rows

LARGEST_INDEX = 100.0
_MOST_ROWS = 10_000
_WAYS = ("n", "table", "sellmeier")


class OwnIndex(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, omit_defaults=True):
    """An index of one's own: exactly one of ``n`` (with ``k``), ``table`` and ``sellmeier``.

    Attributes:
        n: Real part of the index, at least 0, the same at every wavelength.
        k: Imaginary part, at least 0; above 0 the material absorbs.
        table: Rows of wavelength in nm, n and k; the wavelengths ascend. Between them the index is
            linear; outside there is none.
        sellmeier: Coefficients of a transparent material.
    """

    n: float | None = None
    k: float = 0.0
    table: tuple[tuple[float, float, float], ...] | None = None
    sellmeier: SellmeierTerms | None = None

    def __post_init__(self) -> None:
        """Check that one way is chosen, and its numbers."""
        given = [name for name in _WAYS if getattr(self, name) is not None]
        if len(given) != 1:
            raise FieldError("", f"must have exactly one of {', '.join(_WAYS)}", given)
        fields.number(self, "k", at_least=0.0, at_most=LARGEST_INDEX)
        if self.n is None and self.k != 0.0:
            raise FieldError("k", f"must stand beside n, not beside {given[0]}", self.k)
        if self.n is not None:
            fields.number(self, "n", at_least=0.0, at_most=LARGEST_INDEX)
            if self.n == self.k == 0.0:
                raise FieldError("n", "must be above 0 where k is 0", self.n)
        if self.table is not None:
            _check_table(self)
        if self.sellmeier is not None:
            field_kinds.instance(self, "sellmeier", SellmeierTerms)

    def source(self) -> media.Medium | complex | TabulatedIndex:
        """Make the index for the core."""
        if self.sellmeier is not None:
            return medium_from(SellmeierMedium(self.sellmeier))
        if self.table is None:
            return complex(self.n or 0.0, self.k)
        values = np.asarray(self.table, dtype=np.float64)
        return TabulatedIndex(nm_to_m(values[:, 0]), values[:, 1] + 1j * values[:, 2])


def _check_table(owner: OwnIndex) -> None:
    before = 0.0
    for place, row in enumerate(rows(owner, "table", ("wavelength in nm", "n", "k"), _MOST_ROWS)):
        wavelength_nm = fields.wavelength_value(f"table[{place}][0]", row[0])
        if not wavelength_nm > before:
            rule = f"must be a wavelength above {before:g}, that of the row before"
            raise FieldError(f"table[{place}][0]", rule, row[0])
        before = wavelength_nm
        for part in (1, 2):
            if not 0.0 <= row[part] <= LARGEST_INDEX:
                rule = f"must be from 0 to {LARGEST_INDEX:g}"
                raise FieldError(f"table[{place}][{part}]", rule, row[part])
        if row[1] == row[2] == 0.0:
            raise FieldError(f"table[{place}]", "must have n or k above 0", row)


type OpticalIndex = float | str | OwnIndex
"""A constant index, a name of ``core.media.CATALOGUE``, or an index of one's own."""


def check(owner: Struct, field: str) -> None:
    """Check a material of a document.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.

    Raises:
        FieldError: If the index is not above 0, the name unknown, or the kind wrong.
    """
    value = getattr(owner, field)
    if isinstance(value, SellmeierMedium):
        force_setattr(owner, field, OwnIndex(sellmeier=value.sellmeier))
    elif isinstance(value, str):
        field_kinds.choice(owner, field, media.CATALOGUE)
    elif not isinstance(value, OwnIndex):
        fields.number(owner, field, above=0.0, at_most=LARGEST_INDEX)


def material_from(ref: OpticalIndex | MediumRef, field: str) -> Material:
    """Make the material that a document names.

    Args:
        ref: A constant index, a catalogue name, or an index of one's own.
        field: Path of the field in the document, for messages of the core.

    Returns:
        The material of the core.
    """
    if isinstance(ref, OwnIndex):
        return Material(field, ref.source())
    if isinstance(ref, str | SellmeierMedium):
        return Material(field, medium_from(ref))
    return Material(field, complex(ref))
