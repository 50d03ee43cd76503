# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which orders of a hologram can show anything at all."""

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from ...core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from ..efficiency import ConstantSpec, RcwaSpec, ShareTable
from ..hologram import HologramSpec
from . import errors
from .budget import Budget
from .costs import COSTS
from .names import Effect
from .sight import Sight
from .words import named, percent


def decide_orders(sight: Sight, budget: Budget, name: str, given: HologramSpec) -> HologramSpec:
    """Decide about each order of a hologram, the least important first.

    Args:
        sight: The rays of the picture.
        budget: The decisions so far.
        name: Name of the hologram in the document.
        given: The hologram.

    Returns:
        The hologram without the orders that are left out.
    """
    groups = branch_groups(given)
    found = [(_error(sight, name, given, group), group) for group in groups]
    by_error = sorted(found, key=lambda pair: pair[0])
    dropped: list[Branch] = []
    for place, (error, group) in enumerate(by_error):
        effect = _effect(group)
        last = place == len(by_error) - 1
        fixed = last or _is_needed(given, group)
        why = _why(sight, name, group, error) + _why_kept(given, group, last=last)
        part = " ".join(named(branch) for branch in group)
        if fixed:
            budget.note(effect, name, off=False, why=why, error=None, cost=COSTS[effect], part=part)
        elif budget.decide(effect, name, error, why, COSTS[effect], part):
            dropped += group
    return less(given, dropped)


def branch_groups(spec: HologramSpec) -> list[tuple[Branch, ...]]:
    """List the branches that a document can only leave out together.

    Args:
        spec: The hologram.

    Returns:
        Each branch of constant shares by itself; of other models all of one order.
    """
    listed = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    if isinstance(spec.efficiency, ConstantSpec):
        return [(branch,) for branch in listed]
    orders = dict.fromkeys(branch.order for branch in listed)
    return [tuple(each for each in listed if each.order == order) for order in orders]


def _effect(group: Sequence[Branch]) -> Effect:
    return Effect.REFLECTED_ORDERS if all(way.reflected for way in group) else Effect.ORDERS


def _is_needed(spec: HologramSpec, group: Sequence[Branch]) -> bool:
    """Whether others depend on the order: where it is totally reflected, or nothing is recorded."""
    zero = TRANSMITTED_ZERO in group or REFLECTED_ZERO in group
    return zero and spec.efficiency.total_internal_reflection


def _why_kept(spec: HologramSpec, group: tuple[Branch, ...], *, last: bool) -> str:
    if _is_needed(spec, group):
        return "; kept, total reflection takes its share"
    return "; kept, one order has to stay" if last else ""


def _error(sight: Sight, name: str, spec: HologramSpec, group: tuple[Branch, ...]) -> float:
    unseen = errors.unseen_share(sight, name, group)
    if isinstance(spec.efficiency, RcwaSpec):
        # Its shares are not looked at, so any order that goes on counts in full.
        return 1.0 if unseen > 0.0 else 0.0
    haze = spec.efficiency.haze
    if haze is not None and unseen > 0.0:
        # What is scattered may show anything.
        unseen += sight.brightest * errors.largest_scatter(sight, name, spec, haze)
    return max(sight.error(errors.order_change(sight, name, group)), unseen)


def _why(sight: Sight, name: str, group: tuple[Branch, ...], error: float) -> str:
    least = np.inf
    most = 0.0
    for hits in errors.hits_of(sight, name):
        chosen = np.array([way in group for way in hits.ways])
        least = min(least, float(hits.reach[:, chosen].min(initial=np.inf)))
        most = max(most, float(hits.shares[:, chosen].max(initial=0.0)))
    if least > 1.0:
        return f"evanescent for all light that occurs: sine of at least {least:.3g}"
    return f"takes up to {percent(most)} of the light and shows {percent(error)} of the picture"


def less(spec: HologramSpec, dropped: Sequence[Branch]) -> HologramSpec:
    """Take orders from a hologram.

    Args:
        spec: The hologram.
        dropped: The branches that are left out.

    Returns:
        The hologram with the others; their shares stay.
    """
    if not dropped:
        return spec
    model = spec.efficiency
    if not isinstance(model, ConstantSpec):
        out = {way.order for way in dropped}
        return replace(spec, orders=tuple(each for each in spec.orders if each not in out))
    gone = {(way.reflected, way.order) for way in dropped}
    sides = {
        side: {
            order: share for order, share in table.items() if (side == "R", int(order)) not in gone
        }
        for side, table in (("T", model.table.T), ("R", model.table.R))
    }
    left = {int(order) for table in sides.values() for order in table}
    return replace(
        spec,
        efficiency=replace(model, table=ShareTable(T=sides["T"], R=sides["R"])),
        orders=tuple(order for order in spec.orders if order in left),
    )
