# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Constant shares in the shader: one socket for each branch."""

from collections.abc import Iterable

from ...core.orders import Branch
from ...model.efficiency import ConstantSpec
from .part import EfficiencyPart


def constant_part(spec: ConstantSpec, branches: Iterable[Branch]) -> EfficiencyPart:
    """The shader's part for constant shares.

    Args:
        spec: The model of a document.
        branches: The ways out that are asked for; one that the document gives nothing gets none.

    Returns:
        Its part; the sockets are those of all entries of the document.
    """
    listed = tuple(dict.fromkeys(branches))
    return EfficiencyPart(
        shares={branch: _socket(branch) for branch in listed},
        parameters=" ".join(_parameter(branch) for branch in listed),
        sockets={
            _socket(Branch(order, reflected=side == "R")): share
            for side in ("T", "R")
            for order, share in spec.table.shares(side).items()
        },
    )


def _socket(branch: Branch) -> str:
    sign = "m" if branch.order < 0 else "p"
    return f"efficiency_{'r' if branch.reflected else 't'}_{sign}{abs(branch.order)}"


def _parameter(branch: Branch) -> str:
    side = "Reflected" if branch.reflected else "Transmitted"
    label = f"{side} {branch.order:+d}"
    words = "Share of the light in this order, 0 to 1"
    return (
        f"float {_socket(branch)} = 0.0 "
        f'[[ string label = "{label}", string help = "{words}", float min = 0, float max = 1 ]],'
    )
