# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which orders of a device's holograms get the least light, and the device without them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from ...model.device import DeviceSpec, LightGuideSpec
from ...model.evaluate import efficiencies, incident_direction
from ...model.hologram import HologramSpec
from ...model.scene_parts import HologramElement

type Document = dict[str, Any]

_MOST = 4
"""Most orders that are left out one after the other."""

_ANGLES_DEG = (-30.0, -10.0, 10.0, 30.0)
_WAVELENGTHS_NM = (460.0, 530.0, 610.0)


@dataclass(frozen=True)
class WeakOrder:
    """An order of one hologram.

    Attributes:
        hologram: Name of the hologram.
        order: The order.
        share: Mean share of the light that it gets on both sides together.
    """

    hologram: str
    order: int
    share: float


def weakest_orders(spec: DeviceSpec) -> list[WeakOrder]:
    """Find the orders that get the least light.

    Args:
        spec: The device.

    Returns:
        Up to four, the weakest first; each hologram keeps its strongest one.
    """
    found: list[WeakOrder] = []
    for name, hologram in holograms_of(spec):
        ranked = sorted(_shares(name, hologram), key=lambda each: each.share)
        found += ranked[:-1]
    return sorted(found, key=lambda each: each.share)[:_MOST]


def names_of(orders: Sequence[WeakOrder]) -> str:
    """Name orders for people, such as ``in_coupler 0 +1; out_coupler -1``."""
    names = dict.fromkeys(each.hologram for each in orders)
    return "; ".join(
        " ".join([name, *(_signed(each.order) for each in orders if each.hologram == name)])
        for name in names
    )


def _signed(order: int) -> str:
    return f"{order:+d}" if order else "0"


def holograms_of(spec: DeviceSpec) -> list[tuple[str, HologramSpec]]:
    """All holograms of a device with their names."""
    if isinstance(spec, LightGuideSpec):
        return [(patch.name, patch.hologram(spec.guide)) for patch in spec.holograms]
    return [
        (element.name, element.hologram)
        for element in spec.elements
        if isinstance(element, HologramElement)
    ]


def without_orders(left_out: Sequence[WeakOrder]) -> Callable[[Document], None]:
    """Give the change of a device's document that leaves some orders out.

    Args:
        left_out: The orders; their light is lost, that of the others stays as it is.

    Returns:
        A function that changes a document, every field written out, in place.
    """

    def change(document: Document) -> None:
        for name, hologram in named_documents(document):
            gone = {each.order for each in left_out if each.hologram == name}
            hologram["orders"] = [order for order in hologram["orders"] if order not in gone]
            if hologram["efficiency"]["model"] == "constant":
                table = cast("dict[str, dict[str, float]]", hologram["efficiency"]["table"])
                for side, shares in table.items():
                    kept = {
                        order: share for order, share in shares.items() if int(order) not in gone
                    }
                    table[side] = kept

    return change


def named_documents(document: Document) -> list[tuple[str, Document]]:
    """Find the holograms in the document of a device.

    Args:
        document: Plain data with every field written out.

    Returns:
        Name and plain data of each; the data are those of the document, not a copy.
    """
    if "holograms" in document:
        return [(patch["name"], patch) for patch in document["holograms"]]
    return [
        (element["name"], element["hologram"])
        for element in document["elements"]
        if element["kind"] == "hologram"
    ]


def _shares(name: str, hologram: HologramSpec) -> list[WeakOrder]:
    """Mean shares over some directions from both sides, and some colours."""
    directions = np.array(
        [
            incident_direction(angle, 0.0, from_front=front)
            for front in (False, True)
            for angle in _ANGLES_DEG
        ]
    )
    values = efficiencies(
        hologram, directions[:, None, :], np.array(_WAVELENGTHS_NM), hologram.orders
    )
    means = np.nan_to_num(values).sum(axis=-1).mean(axis=(0, 1))
    return [
        WeakOrder(name, order, float(share))
        for order, share in zip(hologram.orders, means, strict=True)
    ]
