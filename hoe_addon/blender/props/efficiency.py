# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The efficiency model as properties.

The usual numbers of a kinoform, and a list of shares, have properties of their own. All else is
kept as text: one for each model, so that changing the model back and forth loses nothing.
"""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ...model.field_error import FieldError
from ...model.fields import MAX_ORDER
from ..ids import EfficiencyModel, Side
from ..registration import class_registrars
from . import details
from .changes import mark
from .efficiency_fields import EfficiencyFields
from .medium import HOE_PG_medium
from .recording import WAVELENGTH_LIMITS
from .values import number, reset, rounded_down, store

ORDER_LIMITS = {"min": -MAX_ORDER, "max": MAX_ORDER, "soft_min": -5, "soft_max": 5}
"""Limits and slider range of every diffraction order."""

_OWN = {
    EfficiencyModel.KINOFORM: ("levels", "design_wavelength_nm", "relief"),
    EfficiencyModel.CONSTANT: ("table",),
}
"""Fields of a model that have properties."""
_COMMON = ("haze", "lookup")
"""Fields of every model that are kept in a text of their own."""
_FOLD = "total_internal_reflection"
_PATH = "efficiency"


def _details(name: str, default: str = "") -> Any:
    return StringProperty(
        name=f"{name} Details",
        description="JSON of the fields of this model that have no properties",
        default=default,
        update=mark,
    )


class HOE_PG_share(bpy.types.PropertyGroup):
    """Share of the light in one order on one side."""

    order: IntProperty(
        name="Order", description="Diffraction order", default=0, update=mark, **ORDER_LIMITS
    )
    side: EnumProperty(
        name="Side",
        description="Which way the order leaves",
        items=Side.items(),
        default=Side.TRANSMITTED,
        update=mark,
    )
    share: FloatProperty(
        name="Share",
        description="Share of the light in this order, from 0 to 1; all shares sum to at most 1",
        default=0.0,
        min=0.0,
        max=1.0,
        step=1,
        precision=4,
        update=mark,
    )


class HOE_PG_efficiency(EfficiencyFields, bpy.types.PropertyGroup):
    """How the light is shared; only the fields of the model count."""

    model: EnumProperty(
        name="Model",
        description="How the light is shared among the orders",
        items=EfficiencyModel.items(),
        default=EfficiencyModel.KINOFORM,
        update=mark,
    )
    levels: IntProperty(
        name="Levels",
        description="Number of levels of the relief, at least 2; 0 is a continuous relief",
        default=0,
        min=0,
        max=1_000_000,
        soft_max=64,
        update=mark,
    )
    design_wavelength_nm: FloatProperty(
        name="Design Wavelength",
        description="Vacuum wavelength where the relief is one wave deep, in nm",
        default=532.0,
        update=mark,
        **WAVELENGTH_LIMITS,
    )
    relief: PointerProperty(
        name="Relief", description="Medium that the relief is made of, in air", type=HOE_PG_medium
    )
    shares: CollectionProperty(
        name="Shares",
        description="Share of the light by order and side; what lacks from 1 is absorbed",
        type=HOE_PG_share,
    )
    total_internal_reflection: BoolProperty(
        name="Total Internal Reflection",
        description="Reflect the share of order 0 where it cannot leave",
        default=False,
        update=mark,
    )

    kinoform_details: _details("Kinoform")
    kogelnik_details: _details(
        "Volume Hologram", '{"thickness_um": 10, "index": 1.5, "modulation": 0.02}'
    )
    rcwa_details: _details(
        "Rigorous Grating", '{"profile": {"shape": "binary", "depth_um": 0.5}, "ridge": 1.5}'
    )
    table_details: _details("Table")
    common_details: StringProperty(
        name="Haze and Look-up",
        description="JSON of haze and lookup, which every model may have",
        update=mark,
    )

    def to_document(self) -> dict[str, Any]:
        """The model as documents write it."""
        document: dict[str, Any] = {"model": self.model}
        if self.model != EfficiencyModel.CONSTANT:
            text = getattr(self, f"{self.model}_details")
            elsewhere = (_FOLD, *_COMMON, *_OWN.get(self.model, ()))
            document |= details.read(text, "model", self.model, _PATH, elsewhere)
        document |= self._common()
        document[_FOLD] = self.total_internal_reflection
        if self.model == EfficiencyModel.CONSTANT:
            document["table"] = self._table()
        elif self.model == EfficiencyModel.KINOFORM:
            document |= {
                "levels": self.levels,
                "design_wavelength_nm": number(self, "design_wavelength_nm"),
                "relief": self.relief.to_document(),
            }
        return document

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the model of a document.

        Args:
            document: The model.
            path: Its path, for messages.
        """
        reset(self)
        self.model = document["model"]
        self.total_internal_reflection = document[_FOLD]
        self._keep_as_text(document)
        if document["model"] == EfficiencyModel.CONSTANT:
            for side, shares in document["table"].items():
                for order, share in shares.items():
                    entry = self.shares.add()
                    entry.side, entry.order = side, int(order)
                    entry.share = rounded_down(share)
        elif document["model"] == EfficiencyModel.KINOFORM:
            self.levels = document["levels"]
            store(self, "design_wavelength_nm", document["design_wavelength_nm"], path)
            self.relief.from_document(document["relief"], f"{path}.relief")

    def _keep_as_text(self, document: dict[str, Any]) -> None:
        """Keep what has no properties; what is null is left out, as it is by default."""
        given = {name: item for name, item in document.items() if item is not None}
        common = {name: given.pop(name) for name in _COMMON if name in given}
        if common:
            self.common_details = details.written(common, "model")
        for name in (_FOLD, *_OWN.get(document["model"], ())):
            given.pop(name, None)
        if document["model"] != EfficiencyModel.CONSTANT:
            setattr(self, f"{document['model']}_details", details.written(given, "model"))

    def _common(self) -> dict[str, Any]:
        found = details.read(self.common_details, "model", self.model, _PATH, (_FOLD,))
        for name in found.keys() - {"model", *_COMMON}:
            rule = f"must not stand in the text of {' and '.join(_COMMON)}"
            raise FieldError(f"{_PATH}.{name}", rule, found[name])
        return found

    def _table(self) -> dict[str, dict[str, float]]:
        table: dict[str, dict[str, float]] = {side.value: {} for side in Side}
        for entry in self.shares:
            shares, order = table[entry.side], str(entry.order)
            share = number(entry, "share")
            if order in shares:
                raise FieldError(f"efficiency.table.{entry.side}.{order}", "stands twice", share)
            shares[order] = share
        return table


register, unregister = class_registrars((HOE_PG_share, HOE_PG_efficiency))
