# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays to many points: a few are searched thoroughly, their neighbours start from these.

Points are sorted into the cells of a square grid over their box in x and y. One point of each
cell, its seed, is searched. What the seeds of a cell and of the eight around it say decides how
the other points of the cell are treated.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .landing import Landing, smallest_stretch
from .newton import newton, tolerance
from .search import SINGULAR, Fan, search
from .system import OpticalSystem

_FEW = 2000
"""Up to so many points are searched one by one: cells over them would be too large to trust."""

_PER_CELL = 16
"""Points that share one seed."""

_MOST_CELLS = 32
"""Cells along an axis. A search costs as much as some thousand rays."""

_NONE = -1
"""In place of the number of a point."""


class FitStatus(IntEnum):
    """What became of a point."""

    FITTED = 0
    """Exactly one ray reaches it."""
    VIGNETTED = 1
    """No ray: an aperture, a missed surface or total reflection takes it."""
    CAUSTIC = 2
    """More than one ray, or rays that cross there, or none for the same reason."""


def land_all(system: OpticalSystem, points: FloatArray) -> tuple[Landing, IntArray]:
    """Find the ray to each point.

    Args:
        system: The chain.
        points: The points, metres, shape ``(N, 3)``, N at least 1.

    Returns:
        The landings, which count where the status is fitted; and the `FitStatus` of each point,
        shape ``(N,)``.
    """
    work = _Work(
        system,
        Fan.of(system),
        points,
        Landing.nowhere(len(points)),
        np.full(len(points), FitStatus.VIGNETTED, dtype=np.int64),
    )
    if len(points) <= _FEW:
        _searched(work, np.arange(len(points)))
        return work.landing, work.status
    cell, side = _cells(points)
    _, seeds = np.unique(cell, return_index=True)
    near = _searched(work, seeds)
    alone = near > _diagonal(points, side)
    seed_of = np.full(side * side, _NONE)
    seed_of[cell[seeds]] = seeds
    alone_of = np.ones(side * side, dtype=np.bool_)
    alone_of[cell[seeds]] = alone
    plan = _Plan.of(seed_of.reshape(side, side), alone_of.reshape(side, side), work.status)

    others = np.setdiff1d(np.arange(len(points)), seeds, assume_unique=True)
    _spread_out(work, plan, others, cell[others], seed_of)
    return work.landing, work.status


@dataclass(frozen=True, eq=False)
class _Work:
    """The task, and what is known so far: the last two are filled in."""

    system: OpticalSystem
    fan: Fan
    points: FloatArray
    landing: Landing
    status: IntArray


@dataclass(frozen=True, eq=False)
class _Plan:
    """How the points of each cell are treated, shapes ``(cells,)``.

    Attributes:
        alike: They get the status of the seed.
        start: The point whose ray starts Newton's method for them, or `_NONE`.
    """

    alike: BoolArray
    start: IntArray

    @classmethod
    def of(cls, seed_of: IntArray, alone: BoolArray, status: IntArray) -> "_Plan":
        """Decide from the seeds of each cell and its neighbours, arrays of cells in a square."""
        kind = np.where(seed_of == _NONE, _NONE, status[seed_of])
        kinds = _neighbourhood(kind, _NONE)
        dark = np.all((kinds == FitStatus.VIGNETTED) | (kinds == _NONE), axis=0)
        dark &= np.all(_neighbourhood(alone, True), axis=0)
        folded = np.all((kinds == FitStatus.CAUSTIC) | (kinds == _NONE), axis=0)
        # Without a caustic around, one ray at most reaches a point: where Newton ends is that.
        fitted = kinds == FitStatus.FITTED
        simple = fitted.any(axis=0) & ~np.any(kinds == FitStatus.CAUSTIC, axis=0)
        chosen = np.argmax(fitted, axis=0)[None]
        start = np.take_along_axis(_neighbourhood(seed_of, _NONE), chosen, axis=0)[0]
        return cls((dark | folded).ravel(), np.where(simple, start, _NONE).ravel())


def _spread_out(
    work: _Work, plan: _Plan, others: IntArray, cell: IntArray, seed_of: IntArray
) -> None:
    """Treat the points that are no seeds, each in its cell."""
    # Far from every ray, or deep in a caustic, a point is like its seed.
    alike = plan.alike[cell]
    work.status[others[alike]] = work.status[seed_of[cell[alike]]]
    others, start = others[~alike], plan.start[cell[~alike]]
    settled = np.zeros(len(others), dtype=np.bool_)
    startable = start != _NONE
    settled[startable] = _continued(work, others[startable], start[startable])
    _searched(work, others[~settled])


def _neighbourhood(values: np.ndarray, beyond: int) -> np.ndarray:
    """Return the value of each cell, then those of its eight neighbours, shape ``(9, ...)``."""
    padded = np.pad(values, 1, constant_values=beyond)
    rows, columns = values.shape
    steps = sorted(((j, i) for j in range(3) for i in range(3)), key=lambda step: step != (1, 1))
    return np.stack([padded[j : j + rows, i : i + columns] for j, i in steps])


def _cells(points: FloatArray) -> tuple[IntArray, int]:
    """Return the cell of each point, and how many cells there are along an axis."""
    side = int(np.clip(np.sqrt(len(points) / _PER_CELL), 1, _MOST_CELLS))
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    place = np.minimum((points[:, :2] - low) / size * side, side - 1).astype(np.int64)
    return place[:, 1] * side + place[:, 0], side


def _diagonal(points: FloatArray, side: int) -> float:
    """Return an upper bound of how far two points of one cell lie apart, metres."""
    size = (points.max(axis=0) - points.min(axis=0)) / (side, side, 1.0)
    return float(np.linalg.norm(size))


def _continued(work: _Work, chosen: IntArray, seeds: IntArray) -> BoolArray:
    """Fit points from their seeds; return which are settled."""
    found = newton(work.system, work.landing.start[seeds], work.points[chosen])
    arrived = found.error <= tolerance(work.system, work.points[chosen])
    arrived &= smallest_stretch(found.jacobian) >= SINGULAR
    with np.errstate(invalid="ignore"):
        turned = np.linalg.det(found.jacobian) * np.linalg.det(work.landing.jacobian[seeds])
    arrived &= turned > 0.0
    fitted = arrived & (found.blocked < 0) & (found.ahead > 0.0)
    work.landing.put(chosen[fitted], found.part(fitted))
    work.status[chosen[fitted]] = FitStatus.FITTED
    work.status[chosen[arrived & ~fitted]] = FitStatus.VIGNETTED
    return arrived


def _searched(work: _Work, chosen: IntArray) -> FloatArray:
    """Search points; return how near the nearest ray of the fan comes, metres."""
    if chosen.size == 0:
        return np.empty(0)
    found = search(work.system, work.fan, work.points[chosen])
    work.landing.put(chosen, found.landing)
    no_ray = np.where(found.in_shadow, FitStatus.VIGNETTED, FitStatus.CAUSTIC)
    work.status[chosen] = np.select(
        (found.count == 1, found.count > 1), (FitStatus.FITTED, FitStatus.CAUSTIC), no_ray
    )
    return found.nearest
