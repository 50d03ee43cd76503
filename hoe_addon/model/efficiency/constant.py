# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiencies of a document that are given as numbers, one for each order and side."""

import math
import re
from collections.abc import Iterable, Mapping
from typing import cast

from msgspec import Struct, field
from msgspec.structs import force_setattr

from ...core.efficiency import EfficiencyModel
from ...core.efficiency.constant import ConstantShares
from ...core.orders import Branch
from .. import field_kinds, fields
from ..field_error import FieldError
from .common import CommonFields

_ORDER = re.compile(r"0|-?[1-9][0-9]{0,5}")


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


class ConstantSpec(CommonFields, frozen=True, tag_field="model", tag="constant"):
    """The same shares at every wavelength, direction and place.

    Attributes:
        table: Share by side and order.
    """

    table: ShareTable

    def __post_init__(self) -> None:
        """Check the flag, and that no more than all light is given away."""
        field_kinds.instance(self, "table", ShareTable)
        total = math.fsum((*self.table.T.values(), *self.table.R.values()))
        if total > 1.0 + fields.SHARE_SLACK:
            raise FieldError("table", "efficiencies must sum to at most 1", total)
        self.check_common()

    def listed_orders(self) -> tuple[int, ...]:
        """Give every order that has an entry on either side.

        Returns:
            The orders, increasing.
        """
        return tuple(sorted({*self.table.shares("T"), *self.table.shares("R")}))

    def branches(self, orders: Iterable[int], recorded_nm: float) -> tuple[Branch, ...]:
        """List the ways out that can get light.

        Args:
            orders: The orders to trace.
            recorded_nm: Wavelength that the pattern is stated for, nm.

        Returns:
            The entries of the table, transmitted first.
        """
        del recorded_nm
        asked, given = tuple(orders), self._by_branch()
        ways = (Branch(order, reflected=side) for side in (False, True) for order in asked)
        return tuple(way for way in ways if way in given)

    def model(self) -> EfficiencyModel:
        """Make the model of the core."""
        return ConstantShares(self._by_branch())

    def _by_branch(self) -> dict[Branch, float]:
        return {
            Branch(order, reflected=side == "R"): share
            for side in ("T", "R")
            for order, share in self.table.shares(side).items()
        }
