# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules that every table of shares keeps; what breaks one is named with its place and value."""

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import SpecError
from ..orders import Branch
from ..units import m_to_mm, m_to_nm

SUM_SLACK = 1e-6
"""Sums of shares in files are rounded: they may be above 1 by this."""

type Side = Literal["back", "front"]

SIDES: tuple[Side, Side] = ("back", "front")

AXES = ("wavelength", "along", "across", "x", "y")
"""Names of the dimensions between the side and the branch."""

_UNITS = ("nm", "", "", "mm", "mm")


def shown(axis: int, value: float) -> str:
    """Write a node for a message: nm, direction cosines, mm.

    Args:
        axis: Number of the axis in `AXES`.
        value: The node, metres or without dimension.

    Returns:
        Its name and value, such as ``wavelength 532 nm``.
    """
    number = m_to_nm(value) if axis == 0 else m_to_mm(value) if axis > 2 else value
    return f"{AXES[axis]} {number:.6g} {_UNITS[axis]}".rstrip()


def check_axis(axis: int, nodes: FloatArray) -> None:
    """Check one axis.

    Args:
        axis: Number of the axis in `AXES`.
        nodes: Its nodes.

    Raises:
        SpecError: It is empty, not finite, not strictly increasing, or out of its range.
    """
    name = AXES[axis]
    if nodes.ndim != 1 or nodes.size == 0:
        raise SpecError(f"{name}: must be a list of at least one node, got shape {nodes.shape}")
    for row, node in enumerate(nodes.tolist()):
        if not np.isfinite(node):
            raise SpecError(f"{name}: must be finite, got {node} in row {row + 1}")
        if axis == 0 and node <= 0.0:
            raise SpecError(f"{name}: must be above 0, got {m_to_nm(node):g} nm in row {row + 1}")
        if axis in (1, 2) and abs(node) > 1.0:
            raise SpecError(f"{name}: must be a cosine in [-1, 1], got {node:g} in row {row + 1}")
        if row and node <= nodes[row - 1]:
            before = shown(axis, float(nodes[row - 1]))
            rule = "must increase from row to row"
            raise SpecError(f"{name}: {rule}, got {shown(axis, node)} after {before}")


def check_shares(
    shares: FloatArray,
    sides: Sequence[str],
    axes: Sequence[FloatArray],
    branches: Sequence[Branch],
    show: Callable[[int, float], str] = shown,
) -> None:
    """Check the numbers of a table.

    Args:
        shares: Shares, shape ``(S, W, A, B, X, Y, K)``.
        sides: Side that the light comes from, S of them.
        axes: The five axes, metres or direction cosines unless `show` knows another unit.
        branches: The K ways out.
        show: Writes a node for a message, given the number of its axis and its value.

    Raises:
        SpecError: The shape is another, or a share is missing, negative, above 1, or the shares of
            one direction sum to more than 1.
    """
    expected = (len(sides), *(len(axis) for axis in axes), len(branches))
    if shares.shape != expected:
        raise SpecError(f"efficiency: must have the shape {expected}, got {shares.shape}")

    def complain(bad: BoolArray, rule: str, values: FloatArray) -> None:
        if bad.any():
            place = tuple(np.argwhere(bad)[0].tolist())
            where = _where(place, sides, axes, branches, show)
            raise SpecError(f"efficiency: {rule}, got {float(values[place]):.6g} at {where}")

    complain(np.isnan(shares), "must have a number at every node", shares)
    complain(shares < 0.0, "must be at least 0", shares)
    rule = "must be at most 1 (shares, no percent)"
    complain(shares > 1.0 + SUM_SLACK, rule, shares)
    total = np.sum(shares, axis=-1)
    complain(total > 1.0 + SUM_SLACK, "shares of one direction must sum to at most 1", total)


def _where(
    place: tuple[int, ...],
    sides: Sequence[str],
    axes: Sequence[FloatArray],
    branches: Sequence[Branch],
    show: Callable[[int, float], str],
) -> str:
    words = [f"incidence {sides[place[0]]}"]
    words += [
        show(axis, float(nodes[place[1 + axis]]))
        for axis, nodes in enumerate(axes)
        if len(nodes) > 1
    ]
    if len(place) > 1 + len(axes):
        branch = branches[place[-1]]
        words.append(f"order {branch.order} {'R' if branch.reflected else 'T'}")
    return ", ".join(words)
