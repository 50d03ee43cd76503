# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A table made of any model: as small as the tolerance allows, with the error that was measured.

Axes without effect are collapsed. The others are bisected where linear interpolation misses the
model, first at the middle of each interval, then where random points that were never looked at
before show an error. What counts is the error that 99 % of such points keep, in the orders that
propagate, and apart from the cells in which an order begins or ceases to do so: there no number of
nodes would do. Random points miss a narrow peak: landmarks, nodes at which the model is known to be
steep, are looked at as well, and all of them count.
"""

import numpy as np

from ..arrays import BoolArray, FloatArray
from .baked import BakedTable
from .incidence import Polarization
from .interpolation import locate
from .node_grid import NodeGrid
from .node_source import NODE, NodeSource
from .table import EfficiencyTable
from .table_check import AXES, SIDES, Side
from .table_error import Check, errors_at, joined, measured

LARGEST = 65_536
"""Most numbers of a table in the shader: larger constant arrays stop its compiler."""

CHECKS = 1000
"""Fewest random points of one measurement of the error."""
_COSTLY_CHECKS = 300
"""The same of models that search at each ray."""
_CHECKED_PART = 30
"""There is one random point at least for so many evaluations of the model."""

_SETTLING = 50
"""Random nodes at which a model that searches settles, beside the ends of colours and places."""

_LINES = 48
_WORST = 32
"""Random points with too large an error that are looked into at once."""

_SPREAD_CHECKS = 256
"""Points at which s is compared with p; the first of the last measurement."""

_LEAST_GAIN = 0.25
"""Intervals whose gain is this part of the best one's are bisected in the same round."""

_MOST_ROUNDS = 200
_SEED = 20260601


def bake(
    source: NodeSource,
    sides: tuple[Side, ...],
    ranges: tuple[tuple[float, float], ...],
    tolerance: float,
    largest: int = LARGEST,
    checks: int | None = None,
    landmarks: FloatArray | None = None,
) -> BakedTable:
    """Make a table of a model.

    Args:
        source: The model, with the light of each node; what it has evaluated is not done again.
        sides: Sides that the light comes from.
        ranges: First and last wavelength, cosine along and across, x and y; metres or no dimension.
            An axis whose two values are alike is collapsed.
        tolerance: Largest error to reach, absolute in the share.
        largest: Most numbers of the table.
        checks: Fewest random points of each measurement; None for as many as fit the model.
        landmarks: Nodes where shares may be steep, such as light on Bragg, the most important
            ones first, shape ``(N, 6)``.

    Returns:
        The table and its error, which is above the tolerance where the size does not suffice.

    Raises:
        SpecError: The model does, or gives no number.
    """
    rng = np.random.default_rng(_SEED)
    grid = NodeGrid(source, tuple(float(SIDES.index(side)) for side in sides), ranges)
    _settle(grid)
    if checks is None:
        checks = CHECKS if source.settled is None else _COSTLY_CHECKS
    peaks = np.empty((0, NODE)) if landmarks is None else landmarks
    flat = _collapse(grid, rng, peaks, tolerance, largest)
    goal = 0.5 * tolerance
    for _ in range(_MOST_ROUNDS):
        if _refine(grid, goal, largest):
            continue
        table = _table(grid, flat)
        check = _check(grid, table, rng, checks)
        marked = errors_at(grid, table, peaks)
        both = joined(check, marked)
        bad = (both.error > tolerance) & ~both.near_cutoff
        if not bad.any() or not _mend(grid, both, bad, largest):
            break
        flat = [axis for axis in flat if len(grid.axes[axis]) == 1]
    else:
        table = _table(grid, flat)
        check, marked = _check(grid, table, rng, checks), errors_at(grid, table, peaks)
    return _report(grid, table, check, marked, tolerance)


def _settle(grid: NodeGrid) -> None:
    """Let a model that searches do so once for the whole range, with its ends."""
    rng = np.random.default_rng(_SEED)
    nodes = grid.random(rng, _SETTLING + 8)
    # Wavelength, x and y: each end with each.
    for corner in range(8):
        for bit, axis in enumerate((0, 3, 4)):
            nodes[corner, 1 + axis] = grid.ranges[axis][corner >> bit & 1]
    grid.source.settle(nodes)


def _check(grid: NodeGrid, table: EfficiencyTable, rng: np.random.Generator, least: int) -> Check:
    """Measure the error at enough points for the work that is in the table."""
    return measured(grid, table, rng, max(least, grid.source.evaluated // _CHECKED_PART))


def _collapse(
    grid: NodeGrid,
    rng: np.random.Generator,
    peaks: FloatArray,
    tolerance: float,
    largest: int,
) -> list[int]:
    """Open the axes that have an effect; return those with an effect below the tolerance."""
    variation = grid.variation(rng, _LINES, peaks[:_LINES])
    flat: list[int] = []
    for axis in sorted(range(len(AXES)), key=lambda place: -variation[place]):
        if variation[axis] <= 0.5 * tolerance:
            if variation[axis] > 0.0:
                flat.append(axis)
            continue
        grid.open(axis)
        if grid.size > largest:
            # The smallest effects go first where there is no room for all.
            low, high = grid.ranges[axis]
            grid.axes[axis] = np.array([0.5 * (low + high)])
            flat.append(axis)
    return flat


def _refine(grid: NodeGrid, goal: float, largest: int) -> bool:
    """Bisect where it helps most, among the intervals that need it; return whether any was."""
    marks: list[tuple[float, int, int]] = []
    for axis in range(len(AXES)):
        if len(grid.axes[axis]) > 1:
            error, gain = grid.interval_errors(axis)
            needed = np.flatnonzero(error > goal).tolist()
            marks += [(float(gain[interval]), axis, int(interval)) for interval in needed]
    least = _LEAST_GAIN * max((gain for gain, _, _ in marks), default=0.0)
    return grid.bisect([mark for mark in marks if mark[0] >= least], largest)


def _table(grid: NodeGrid, flat: list[int]) -> EfficiencyTable:
    """Evaluate the nodes; an axis of little effect gets the middle of its values."""
    axes = list(grid.axes)
    for axis in flat:
        low, high = grid.ranges[axis]
        wide = [*axes[:axis], np.array([low, 0.5 * (low + high), high]), *axes[axis + 1 :]]
        nodes = len(grid.fronts) * int(np.prod([len(part) for part in wide]))
        axes = wide if nodes <= 4 * LARGEST else axes
    values, _ = grid.values(axes)
    values = _filled(values)
    for axis in flat:
        high = np.max(values, axis=1 + axis, keepdims=True)
        values = 0.5 * (high + np.min(values, axis=1 + axis, keepdims=True))
        axes[axis] = grid.axes[axis]
    values = values / np.maximum(np.sum(values, axis=-1, keepdims=True), 1.0)
    sides: tuple[Side, ...] = tuple(SIDES[int(front)] for front in grid.fronts)
    wavelength, along, across, x, y = axes
    return EfficiencyTable(grid.source.branches, wavelength, along, across, x, y, sides, values)


def _filled(values: FloatArray) -> FloatArray:
    """Give places where nothing is recorded the shares of the nearest place where something is."""
    unknown = np.isnan(values).any(axis=(0, 1, 2, 3, 6))
    if not unknown.any():
        return values
    known = np.argwhere(~unknown)
    filled = values.copy()
    for place in np.argwhere(unknown).tolist():
        if len(known):
            nearest = known[np.argmin(np.sum((known - place) ** 2, axis=-1))]
            filled[:, :, :, :, place[0], place[1]] = values[:, :, :, :, nearest[0], nearest[1]]
    return np.nan_to_num(filled)


def _mend(grid: NodeGrid, check: Check, bad: BoolArray, largest: int) -> bool:
    """Bisect, around the worst of some points, the interval of the axis that is to blame."""
    worst = np.flatnonzero(bad)[np.argsort(-check.error[bad])][:_WORST]
    nodes = check.nodes[worst]
    truth, passing = grid.source.at(nodes)
    live = passing[:, : truth.shape[1]]
    blame = np.zeros((len(AXES), len(nodes)))
    lower = np.zeros((len(AXES), len(nodes)), dtype=np.int64)
    for axis, (low, high) in enumerate(grid.ranges):
        if low == high:
            continue
        own = grid.axes[axis] if len(grid.axes[axis]) > 1 else np.array([low, high])
        cell = locate(own, nodes[:, 1 + axis])
        lower[axis] = cell.lower
        ends: list[FloatArray] = []
        for step in (0, 1):
            moved = nodes.copy()
            moved[:, 1 + axis] = own[cell.lower + step]
            ends.append(grid.source.at(moved)[0])
        assert cell.share is not None, "two nodes at least"
        share = cell.share[:, None]
        error = np.abs(ends[0] * (1.0 - share) + ends[1] * share - truth)
        blame[axis] = np.nan_to_num(np.where(live, error, 0.0)).max(axis=-1)
    chosen: list[int] = np.argmax(blame, axis=0).tolist()
    for axis in sorted(set(chosen)):
        if len(grid.axes[axis]) == 1:
            grid.open(axis)
            if grid.size > largest:
                grid.axes[axis] = np.array([0.5 * sum(grid.ranges[axis])])
                return False
            return True
    marks = {(axis, int(lower[axis, row])) for row, axis in enumerate(chosen)}
    return grid.bisect([(1.0, axis, interval) for axis, interval in marks], largest)


def _report(
    grid: NodeGrid, table: EfficiencyTable, check: Check, marked: Check, tolerance: float
) -> BakedTable:
    away = check.away
    near = check.error[check.near_cutoff]
    apart = _apart(grid.source, check.nodes[:_SPREAD_CHECKS])
    return BakedTable(
        table=table,
        tolerance=tolerance,
        quantile=check.quantile,
        error=float(np.max(away, initial=0.0)),
        rms=float(np.sqrt(np.mean(away**2))) if len(away) else 0.0,
        landmark_error=float(np.max(marked.error, initial=0.0)),
        landmark=marked.nodes[np.argmax(marked.error)] if len(marked.error) else None,
        landmarks=len(marked.error),
        cutoff_error=float(np.max(near, initial=0.0)),
        cutoff_part=len(near) / max(len(check.error), 1),
        checks=len(check.error),
        collapsed=tuple(
            name for name, nodes in zip(AXES, table.axes, strict=True) if len(nodes) == 1
        ),
        spread=float(np.max(apart, initial=0.0)),
        mean_spread=float(np.mean(apart)) if apart.size else 0.0,
        evaluated=grid.source.evaluated,
        excess=max(grid.source.excess, 0.0),
        settled=grid.source.settled,
    )


def _apart(source: NodeSource, nodes: FloatArray) -> FloatArray:
    """Difference of the shares of s and p light at nodes, shape ``(N, K)``."""
    own, passing = source.at(nodes)
    is_s = source.polarization is Polarization.S
    other, _ = source.polarised(Polarization.P if is_s else Polarization.S).at(nodes)
    # Unpolarised light is the mean of both: half way from one to the other.
    times = 2.0 if source.polarization is Polarization.UNPOLARISED else 1.0
    return np.where(passing[:, : own.shape[1]], times * np.abs(own - other), 0.0)
