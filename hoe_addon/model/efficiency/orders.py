# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The orders that a hologram traces, together with its efficiency model."""

from msgspec import Struct
from msgspec.structs import force_setattr

from .. import fields
from ..field_error import FieldError
from .constant import ConstantSpec, ShareTable
from .specs import EfficiencySpec


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
    if not orders:
        orders = efficiency.listed_orders()
    if not orders:
        raise FieldError.told("orders", "is missing")
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
