# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields that every efficiency model has."""

from typing import Literal

from msgspec import Struct

from .. import field_kinds, fields
from ..field_error import FieldError
from .haze import HazeSpec

LEAST_TOLERANCE, MOST_TOLERANCE = 1e-6, 0.1
VISIBLE_NM = (380.0, 780.0)
WIDEST_DEG = 78.5
"""Nearer to grazing, shares change too fast for a table, and hardly any light goes there."""

_NARROWEST_DEG = 1.0


class LookupSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """How the shader gets at the shares.

    Attributes:
        form: ``formula`` where the model has one in the shader, ``table`` for a table made of the
            model, ``auto`` for the formula where there is one.
        choice: Between the nodes of a table: ``bilinear`` interpolates; ``stochastic`` draws one
            node by its bilinear weight, then one order by its share there. A formula has no nodes,
            so it is left as it is.
        tolerance: Largest interpolation error of a table, absolute in the share.
        angle_deg: Largest angle to the normal, in the medium that a ray comes from, for which a
            table is made, degrees; a narrow cone gives a better table. Beyond it the shares of
            its rim hold.
        wavelengths_nm: First and last vacuum wavelength for which a table is made, nm; beyond them
            the shares at the ends hold.
    """

    form: Literal["auto", "formula", "table"] = "auto"
    choice: Literal["bilinear", "stochastic"] = "bilinear"
    tolerance: float = 1e-3
    angle_deg: float = WIDEST_DEG
    wavelengths_nm: tuple[float, float] = VISIBLE_NM

    def __post_init__(self) -> None:
        """Check all fields."""
        field_kinds.choice(self, "form", ("auto", "formula", "table"))
        field_kinds.choice(self, "choice", ("bilinear", "stochastic"))
        fields.number(self, "tolerance", at_least=LEAST_TOLERANCE, at_most=MOST_TOLERANCE)
        fields.number(self, "angle_deg", at_least=_NARROWEST_DEG, at_most=WIDEST_DEG)
        fields.vector(self, "wavelengths_nm", 2)
        ends = [
            fields.wavelength_value(f"wavelengths_nm[{place}]", value)
            for place, value in enumerate(self.wavelengths_nm)
        ]
        if not ends[0] < ends[1]:
            raise FieldError("wavelengths_nm", "must increase", self.wavelengths_nm)


class CommonFields(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What each model may say beside its own fields.

    Attributes:
        total_internal_reflection: Whether the share of the transmitted order 0 is reflected into
            order 0 where the transmitted one is evanescent; of ``kogelnik`` the orders +1 and -1
            too, to the side on which they can leave.
        haze: Scattering of a share of each order around its direction; None for none.
        lookup: How the shader gets at the shares; None for the defaults.
    """

    total_internal_reflection: bool = False
    haze: HazeSpec | None = None
    lookup: LookupSpec | None = None

    @property
    def has_formula(self) -> bool:
        """Whether the shader can compute the shares itself, without a table."""
        return True

    @property
    def uses_table(self) -> bool:
        """Whether the shader looks the shares up in a table."""
        form = "auto" if self.lookup is None else self.lookup.form
        return form == "table" or not self.has_formula

    def check_common(self) -> None:
        """Check these fields, after those that `has_formula` depends on.

        Raises:
            FieldError: One of them is of another kind, or asks for a formula that there is not.
        """
        field_kinds.flag(self, "total_internal_reflection")
        if self.haze is not None:
            field_kinds.instance(self, "haze", HazeSpec)
        if self.lookup is not None:
            field_kinds.instance(self, "lookup", LookupSpec)
            if self.lookup.form == "formula" and not self.has_formula:
                rule = "must be auto or table, since this model has no formula in the shader"
                raise FieldError("lookup.form", rule, "formula")
