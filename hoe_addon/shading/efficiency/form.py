# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the shader of a hologram gets at its efficiencies, how good that is, and what it costs."""

from typing import NamedTuple

from ...model.efficiency import ConstantSpec, EfficiencySpec, KinoformSpec
from ...model.hologram import HologramSpec
from ...model.tables.cache import Progress, kept_table

_CONSTANT, _KINOFORM, _OTHER = 1e-7, 2e-5, 1e-4
"""Bounds of what float32 does to formulas, absolute in the share; tests hold them to it."""


class EfficiencyForm(NamedTuple):
    """How the shader gets at the shares.

    Attributes:
        form: ``formula``, ``table, bilinear`` or ``table, stochastic``.
        error: Error, absolute in the share: the largest of float32, or what 99 % of random points
            keep in a table, away from the cut-offs of orders.
        cost: Its cost in words.
        worst: Largest error: the same for a formula, or the worst of those random points.
    """

    form: str
    error: float
    cost: str
    worst: float


def efficiency_form(spec: HologramSpec, progress: Progress | None = None) -> EfficiencyForm:
    """Tell how the shader of a hologram gets at its efficiencies.

    Args:
        spec: The hologram.
        progress: Told the share that is done where a table has to be made.

    Returns:
        The form, its error and its cost.

    Raises:
        HoeError: The table can not be made, read or written.
    """
    model = spec.efficiency
    if not model.uses_table:
        bound = _rounding(model)
        return EfficiencyForm("formula", bound, "computed at each hit, for every order", bound)
    kept = kept_table(spec, progress)
    size = f"{kept.table.size} numbers in the shader"
    axes = sum(len(axis) > 1 for axis in kept.table.axes)
    if model.lookup is not None and model.lookup.choice == "stochastic":
        cost = f"{size}; at each hit {axes + 1} random numbers, one node and one order"
        return EfficiencyForm("table, stochastic", kept.quantile, cost, kept.error)
    cost = f"{size}; at each hit {2**axes} of them for every order"
    return EfficiencyForm("table, bilinear", kept.quantile, cost, kept.error)


def _rounding(model: EfficiencySpec) -> float:
    if isinstance(model, ConstantSpec):
        return _CONSTANT
    return _KINOFORM if isinstance(model, KinoformSpec) else _OTHER
