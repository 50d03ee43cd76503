# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists of a hologram: the orders that are traced, and the shares of a constant efficiency."""

import bpy

from ...core.errors import HoeError
from ...model.fields import MAX_ORDER
from ..ids import Side
from ..props.changes import mark_block


def add_order(material: bpy.types.Material) -> int:
    """Trace one more order: the lowest that is not traced yet, above 0 first.

    Args:
        material: A hologram.

    Returns:
        The order.

    Raises:
        HoeError: All are traced.
    """
    orders = material.hologram.orders
    new = _free({entry.order for entry in orders})
    orders.add().order = new
    mark_block(material)
    return new


def remove_order(material: bpy.types.Material, place: int) -> int:
    """Trace an order no more.

    Args:
        material: A hologram.
        place: Its place in the list.

    Returns:
        The order.

    Raises:
        HoeError: There is no such place.
    """
    return _remove(material, material.hologram.orders, place)


def add_share(material: bpy.types.Material) -> int:
    """Give one more order a share, which is 0 at first.

    Args:
        material: A hologram.

    Returns:
        The order, which is transmitted.

    Raises:
        HoeError: All have one.
    """
    shares = material.hologram.efficiency.shares
    new = _free({entry.order for entry in shares if entry.side == Side.TRANSMITTED})
    shares.add().order = new
    mark_block(material)
    return new


def remove_share(material: bpy.types.Material, place: int) -> int:
    """Take the share of an order away.

    Args:
        material: A hologram.
        place: Its place in the list.

    Returns:
        The order.

    Raises:
        HoeError: There is no such place.
    """
    return _remove(material, material.hologram.efficiency.shares, place)


def _free(taken: set[int]) -> int:
    for size in range(MAX_ORDER + 1):
        for order in (size, -size):
            if order not in taken:
                return order
    raise HoeError(f"all orders from -{MAX_ORDER} to {MAX_ORDER} are in the list")


def _remove(
    material: bpy.types.Material, entries: bpy.types.bpy_prop_collection, place: int
) -> int:
    if not 0 <= place < len(entries):
        raise HoeError(f"the list has no entry {place}; it has {len(entries)}")
    order = entries[place].order
    entries.remove(place)
    mark_block(material)
    return order
