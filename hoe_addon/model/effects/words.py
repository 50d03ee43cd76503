# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in the sentences of a plan."""

from ...core.orders import Branch


def percent(value: float) -> str:
    """Write a relative error, such as ``0.13 %``; what is above the whole is told as that."""
    return "all" if value >= 0.9995 else f"{100.0 * value:.2g} %"


def named(branch: Branch) -> str:
    """Name an order and its side, such as ``T+1``."""
    side = "R" if branch.reflected else "T"
    return f"{side}{branch.order:+d}" if branch.order else f"{side}0"
