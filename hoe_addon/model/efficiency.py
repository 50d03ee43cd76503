# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light each order gets: the efficiency models of a document."""

import math
import re
from collections.abc import Mapping
from typing import cast

from msgspec import Struct, field
from msgspec.structs import force_setattr

from . import field_kinds, fields, medium
from .field_error import FieldError
from .medium import MediumRef

_ORDER = re.compile(r"0|-?[1-9][0-9]{0,5}")
_MAX_LEVELS = 1_000_000


class KinoformSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="model", tag="kinoform"
):
    """A blazed phase relief, continuous or in steps.

    Attributes:
        levels: Number of levels; 0 is the continuous relief.
        design_wavelength_nm: Vacuum wavelength in nm where the relief is one wave deep.
        relief: Medium of the relief, in air.
        total_internal_reflection: Whether the share of the transmitted order 0 is reflected into
            order 0 where the transmitted one is evanescent.
    """

    levels: int
    design_wavelength_nm: float
    relief: MediumRef
    total_internal_reflection: bool = False

    def __post_init__(self) -> None:
        """Check the levels, and that the relief has a depth at the design wavelength."""
        if fields.integer(self, "levels", 0, _MAX_LEVELS) == 1:
            raise FieldError("levels", "must be 0 (continuous) or at least 2", 1)
        design_nm = fields.wavelength(self, "design_wavelength_nm")
        medium.check(self, "relief")
        if medium.index_at(self, "relief", design_nm) <= 1.0:
            rule = "must have an index above 1 at the design wavelength"
            raise FieldError("relief", rule, self.relief)
        field_kinds.flag(self, "total_internal_reflection")


class ShareTable(Struct, frozen=True, forbid_unknown_fields=True):
    """Share of the light by side and order; what the sum lacks from 1 is absorbed.

    Attributes:
        T: Share by transmitted order; the order is written as a text, as JSON wants it.
        R: Share by reflected order.
    """

    T: dict[str, float] = field(default_factory=dict[str, float])
    R: dict[str, float] = field(default_factory=dict[str, float])

    def __post_init__(self) -> None:
        """Check orders and shares."""
        for side in ("T", "R"):
            force_setattr(self, side, _checked_shares(side, getattr(self, side)))

    def shares(self, side: str) -> dict[int, float]:
        """Give the shares of one side with orders as numbers.

        Args:
            side: ``"T"`` or ``"R"``.

        Returns:
            Share by order.
        """
        table = self.T if side == "T" else self.R
        return {int(order): share for order, share in table.items()}


def _checked_shares(side: str, value: object) -> dict[str, float]:
    shares: dict[str, float] = {}
    if not isinstance(value, Mapping):
        raise FieldError(side, "must map orders to shares", value)
    for order, share in cast("Mapping[object, object]", value).items():
        name = str(order)
        if not _ORDER.fullmatch(name) or abs(int(name)) > fields.MAX_ORDER:
            rule = f"order must be a whole number from {-fields.MAX_ORDER} to {fields.MAX_ORDER}"
            raise FieldError(side, rule, name)
        shares[name] = fields.share(f"{side}.{name}", share)
    return shares


class ConstantSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="model", tag="constant"
):
    """The same shares at every wavelength, direction and place.

    Attributes:
        table: Share by side and order.
        total_internal_reflection: Whether the share of the transmitted order 0 is reflected into
            order 0 where the transmitted one is evanescent.
    """

    table: ShareTable
    total_internal_reflection: bool = False

    def __post_init__(self) -> None:
        """Check the flag, and that no more than all light is given away."""
        field_kinds.instance(self, "table", ShareTable)
        total = math.fsum((*self.table.T.values(), *self.table.R.values()))
        if total > 1.0 + fields.SHARE_SLACK:
            raise FieldError("table", "efficiencies must sum to at most 1", total)
        field_kinds.flag(self, "total_internal_reflection")

    def listed_orders(self) -> tuple[int, ...]:
        """Give every order that has an entry on either side.

        Returns:
            The orders, increasing.
        """
        return tuple(sorted({*self.table.shares("T"), *self.table.shares("R")}))


type EfficiencySpec = KinoformSpec | ConstantSpec


def settle_orders(owner: Struct, efficiency: EfficiencySpec) -> None:
    """Check the field ``orders`` of a struct, or fill it from a table where it is left out.

    Args:
        owner: Struct that holds the field ``orders``; an empty tuple means left out.
        efficiency: The model of the same hologram.

    Raises:
        FieldError: If orders are missing, doubled, too many or too high, or if the table gives
            light to an order that is not listed.
    """
    orders = fields.integers(owner, "orders", -fields.MAX_ORDER, fields.MAX_ORDER)
    if not orders and isinstance(efficiency, ConstantSpec):
        orders = efficiency.listed_orders()
    if not orders:
        raise FieldError("orders", "must list at least one order", orders)
    if len(orders) > fields.MAX_ORDERS:
        raise FieldError("orders", f"must list at most {fields.MAX_ORDERS}", len(orders))
    if len(set(orders)) < len(orders):
        twice = next(order for order in orders if orders.count(order) > 1)
        raise FieldError("orders", "must list each order once", twice)
    force_setattr(owner, "orders", orders)
    if isinstance(efficiency, ConstantSpec):
        _check_all_listed(efficiency.table, orders)


def _check_all_listed(table: ShareTable, orders: tuple[int, ...]) -> None:
    for side in ("T", "R"):
        for order, value in table.shares(side).items():
            if order not in orders:
                path = f"efficiency.table.{side}.{order}"
                raise FieldError(path, "order is not listed in orders", value)
