# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a table, measured at random points that it was not made of."""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from ..arrays import BoolArray, FloatArray
from .interpolation import interpolate, locate
from .node_grid import NodeGrid
from .node_source import NodeSource
from .table import EfficiencyTable

QUANTILE = 0.99
"""Part of the random points that have to be within the tolerance.

The largest of N errors says little about the largest of all; this quantile is found again at other
points.
"""


@dataclass(frozen=True, eq=False)
class Check:
    """Errors at random points.

    Attributes:
        nodes: The points, shape ``(N, 6)``.
        error: Largest error of the orders that propagate, shape ``(N,)``.
        near_cutoff: Whether a cut-off lies in the same cell, shape ``(N,)``.
    """

    nodes: FloatArray
    error: FloatArray
    near_cutoff: BoolArray

    @property
    def away(self) -> FloatArray:
        """Errors away from cut-offs."""
        return self.error[~self.near_cutoff]

    @property
    def quantile(self) -> float:
        """The error that `QUANTILE` of the points away from cut-offs keep; 0 without any."""
        away = self.away
        return float(np.quantile(away, QUANTILE, method="higher")) if len(away) else 0.0


def measured(grid: NodeGrid, table: EfficiencyTable, rng: np.random.Generator, count: int) -> Check:
    """Compare a table with the model at random points.

    Args:
        grid: The grid that the table was made on.
        table: The table.
        rng: Draws the points.
        count: How many.

    Returns:
        What was found where something is recorded and propagates.
    """
    check = errors_at(grid, table, grid.random(rng, count))
    return replace(check, near_cutoff=near_cutoff(grid.source, table, check.nodes))


def errors_at(grid: NodeGrid, table: EfficiencyTable, nodes: FloatArray) -> Check:
    """Compare a table with the model at given points, none of which counts as near a cut-off.

    Args:
        grid: The grid that the table was made on.
        table: The table.
        nodes: The points, shape ``(N, 6)``.

    Returns:
        What was found where something is recorded and propagates.
    """
    truth, passing = grid.source.at(nodes)
    known = np.isfinite(truth).all(axis=-1) & passing[:, : truth.shape[1]].any(axis=-1)
    nodes, truth, passing = nodes[known], truth[known], passing[known]
    cells = [locate(axis, nodes[:, 1 + place]) for place, axis in enumerate(table.axes)]
    side = np.searchsorted(np.asarray(grid.fronts), nodes[:, 0])
    found = interpolate(table.values, side, cells)
    error = np.where(passing[:, : truth.shape[1]], np.abs(found - truth), 0.0)
    return Check(nodes, error.max(axis=-1, initial=0.0), np.zeros(len(nodes), dtype=np.bool_))


def joined(first: Check, second: Check) -> Check:
    """Put two measurements together."""
    names = ("nodes", "error", "near_cutoff")
    return Check(*(np.concatenate((getattr(first, n), getattr(second, n))) for n in names))


def near_cutoff(source: NodeSource, table: EfficiencyTable, nodes: FloatArray) -> BoolArray:
    """Tell around which points the corners of the cell differ in the orders that propagate.

    Args:
        source: Knows the orders.
        table: Has the cells.
        nodes: Points, shape ``(N, 6)``.

    Returns:
        Shape ``(N,)``.
    """
    cells = [locate(axis, nodes[:, 1 + place]) for place, axis in enumerate(table.axes)]
    passing = source.passing(nodes)
    near = np.zeros(len(nodes), dtype=np.bool_)
    for corner in product(*((0,) if cell.share is None else (0, 1) for cell in cells)):
        moved = nodes.copy()
        for place, (axis, cell, step) in enumerate(zip(table.axes, cells, corner, strict=True)):
            if cell.share is not None:
                moved[:, 1 + place] = axis[cell.lower + step]
        near |= (source.passing(moved) != passing).any(axis=-1)
    return near
