# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields that every efficiency model has."""

from typing import Literal

from msgspec import Struct

from .. import field_kinds, fields
from ..field_error import FieldError
from .haze import HazeSpec

LEAST_TOLERANCE, MOST_TOLERANCE = 1e-6, 0.1


class LookupSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """How the shader gets at the shares.

    Attributes:
        form: ``formula`` where the model has one in the shader, ``table`` for a table made of the
            model, ``auto`` for the formula where there is one.
        choice: Between the nodes of a table: ``bilinear`` interpolates; ``stochastic`` draws one
            node by its bilinear weight, then one order by its share there. A formula has no nodes,
            so it is left as it is.
        tolerance: Largest interpolation error of a table, absolute in the share.
    """

    form: Literal["auto", "formula", "table"] = "auto"
    choice: Literal["bilinear", "stochastic"] = "bilinear"
    tolerance: float = 1e-3

    def __post_init__(self) -> None:
        """Check the choices and the tolerance."""
        field_kinds.choice(self, "form", ("auto", "formula", "table"))
        field_kinds.choice(self, "choice", ("bilinear", "stochastic"))
        fields.number(self, "tolerance", at_least=LEAST_TOLERANCE, at_most=MOST_TOLERANCE)


class CommonFields(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What each model may say beside its own fields.

    Attributes:
        total_internal_reflection: Whether the share of the transmitted order 0 is reflected into
            order 0 where the transmitted one is evanescent.
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
