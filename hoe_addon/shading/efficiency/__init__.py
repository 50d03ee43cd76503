# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiency models in the shader: which one a hologram gets."""

from collections.abc import Iterable

from ...core.efficiency.table import EfficiencyTable
from ...core.orders import Branch
from ...model.efficiency import ConstantSpec, KinoformSpec, KogelnikSpec
from ...model.hologram import HologramSpec
from ..part import SocketValues
from .constant import constant_part
from .kinoform import kinoform_part
from .part import EfficiencyPart as EfficiencyPart
from .table import table_part, table_sockets
from .volume import volume_part


def efficiency_part(
    spec: HologramSpec,
    branches: Iterable[Branch],
    table: EfficiencyTable | None = None,
    *,
    forward: bool = False,
) -> EfficiencyPart:
    """The shader's part for the efficiency model of a hologram.

    Args:
        spec: The hologram.
        branches: The ways out that are asked for.
        table: What the shader looks up where the model uses a table; indexed by the walked ray.
        forward: Whether the walk follows the light; shares are never drawn then.

    Returns:
        Its part.

    Raises:
        SpecError: The table is too large for a text.
    """
    model = spec.efficiency
    if model.uses_table:
        drawn = model.lookup is not None and model.lookup.choice == "stochastic"
        return table_part(_given(table), tuple(branches), drawn=drawn and not forward)
    return _formula_part(spec, branches, 1.0)


def efficiency_sockets(
    spec: HologramSpec,
    branches: Iterable[Branch],
    units_per_mm: float,
    table: EfficiencyTable | None = None,
) -> SocketValues:
    """The numbers of an efficiency model as socket values.

    Args:
        spec: The hologram.
        branches: The ways out that are traced.
        units_per_mm: Scene units in one mm.
        table: What the shader looks up where the model uses a table.

    Returns:
        Value by socket identifier.
    """
    if spec.efficiency.uses_table:
        return table_sockets(_given(table), units_per_mm)
    return _formula_part(spec, branches, units_per_mm).sockets


def _given(table: EfficiencyTable | None) -> EfficiencyTable:
    if table is None:
        raise ValueError("this model of efficiency needs its table")
    return table


def _formula_part(
    spec: HologramSpec, branches: Iterable[Branch], units_per_mm: float
) -> EfficiencyPart:
    model = spec.efficiency
    if isinstance(model, KogelnikSpec):
        return volume_part(spec, model, branches, units_per_mm)
    if isinstance(model, KinoformSpec):
        return kinoform_part(model, branches)
    assert isinstance(model, ConstantSpec), "other models have no formula"
    return constant_part(model, branches)
