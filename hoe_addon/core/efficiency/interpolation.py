# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Values between the nodes of a grid: linear in each dimension, or one node drawn by its weight."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Cell:
    """Where values lie on one axis.

    Attributes:
        lower: Number of the node below, shape ``(...)``.
        share: How far they are on the way to the next node, 0 to 1, shape ``(...)``; None for an
            axis of one node, where there is no next.
    """

    lower: IntArray
    share: FloatArray | None


def locate(axis: FloatArray, values: FloatArray) -> Cell:
    """Find the neighbouring nodes of values; what lies outside is moved to the nearest end.

    Args:
        axis: Nodes, strictly increasing, shape ``(n,)``.
        values: Values, any shape; NaN counts as the first node.

    Returns:
        Their cell.
    """
    if len(axis) == 1:
        return Cell(np.zeros(values.shape, dtype=np.int64), None)
    inside = np.where(np.isnan(values), axis[0], np.clip(values, axis[0], axis[-1]))
    lower = np.clip(np.searchsorted(axis, inside, side="right") - 1, 0, len(axis) - 2)
    share = (inside - axis[lower]) / (axis[lower + 1] - axis[lower])
    return Cell(lower.astype(np.int64), share)


def outside(axis: FloatArray, values: FloatArray, slack: float) -> BoolArray:
    """Tell which values lie beyond the nodes.

    Args:
        axis: Nodes, strictly increasing, shape ``(n,)``; one node stands for any value.
        values: Values, any shape.
        slack: What rounding may add, as a share of the whole axis.

    Returns:
        Same shape as the values.
    """
    if len(axis) == 1:
        return np.zeros(values.shape, dtype=np.bool_)
    margin = slack * (axis[-1] - axis[0])
    return (values < axis[0] - margin) | (values > axis[-1] + margin)


def interpolate(grid: FloatArray, first: IntArray, cells: Sequence[Cell]) -> FloatArray:
    """Interpolate linearly in each dimension.

    Args:
        grid: Values, shape ``(S, n1, n2, ..., K)``.
        first: Number along the first axis, which is not interpolated, shape ``(...)``.
        cells: Where to look on each of the other axes but the last.

    Returns:
        Shape ``(..., K)``.
    """
    total = np.zeros((*first.shape, grid.shape[-1]))
    steps = [(0,) if cell.share is None else (0, 1) for cell in cells]
    for corner in product(*steps):
        weight = np.ones(first.shape)
        for cell, step in zip(cells, corner, strict=True):
            if cell.share is not None:
                weight = weight * (cell.share if step else 1.0 - cell.share)
        place = tuple(cell.lower + step for cell, step in zip(cells, corner, strict=True))
        total += weight[..., None] * grid[first, *place]
    return total


def draw_node(cells: Sequence[Cell], draws: FloatArray) -> tuple[IntArray, ...]:
    """Choose one of the neighbouring nodes, each with its weight in `interpolate`.

    Args:
        cells: Where to look on each axis.
        draws: Uniform numbers in [0, 1), one an axis, shape ``(..., axes)``.

    Returns:
        Number of the node on each axis, each of shape ``(...)``.
    """
    return tuple(
        cell.lower if cell.share is None else cell.lower + (draws[..., axis] < cell.share)
        for axis, cell in enumerate(cells)
    )
