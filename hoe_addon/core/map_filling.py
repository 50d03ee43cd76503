# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Filling of holes in a grid of samples, so that a spline through them stays good beside them.

A spline's coefficient depends on all samples, each step away by a factor of 0.27 less. Values that
continue the known ones as a cubic does leave its order of error as it is.
"""

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray

_EXTRAPOLATED = 4
"""Steps into a hole by cubics; further on they grow wild."""

_AVERAGED = 12
"""Steps after these by the mean of neighbours; 0.27^16 is below 1e-9."""

_FORMULAS = ((4.0, -6.0, 4.0, -1.0), (3.0, -3.0, 1.0), (2.0, -1.0), (1.0,))
"""The next value from the last ones, for a cubic, a parabola, a line, a constant."""

_DIRECTIONS = tuple((j, i) for j in (-1, 0, 1) for i in (-1, 0, 1) if (j, i) != (0, 0))


def filled(values: FloatArray, known: BoolArray) -> FloatArray:
    """Fill holes smoothly.

    Args:
        values: Samples, shape ``(ny, nx, channels)``.
        known: Which are there, shape ``(ny, nx)``, one at least.

    Returns:
        Samples with finite numbers everywhere; the known ones as they are.
    """
    if known.all():
        return values
    result = np.where(known[..., None], values, 0.0)
    low, high = values[known].min(axis=0), values[known].max(axis=0)
    there = known.copy()
    for step in range(_EXTRAPOLATED + _AVERAGED):
        if there.all():
            break
        formulas = _FORMULAS if step < _EXTRAPOLATED else _FORMULAS[-1:]
        result, there = _one_step(result, there, formulas)
        result = np.where(known[..., None], result, np.clip(result, 2 * low - high, 2 * high - low))
    return np.where(there[..., None], result, values[known].mean(axis=0))


def distance_from(places: BoolArray, farthest: int) -> IntArray:
    """Return how many steps, also diagonal ones, lead to the nearest of some places.

    Args:
        places: The places, shape ``(ny, nx)``.
        farthest: Steps after which to stop looking.

    Returns:
        Steps, at most `farthest`, shape ``(ny, nx)``; 0 at the places.
    """
    distance = np.where(places, 0, farthest)
    reached = places
    for step in range(1, farthest):
        wider = _widened(reached)
        distance = np.where(wider & ~reached, step, distance)
        reached = wider
    return distance


def _one_step(
    values: FloatArray, there: BoolArray, formulas: tuple[tuple[float, ...], ...]
) -> tuple[FloatArray, BoolArray]:
    """Fill the places beside known ones: the mean over directions of the highest order."""
    row, column = np.nonzero(_widened(there) & ~there)
    best = np.zeros(len(row), dtype=np.int64)
    total, count = np.zeros((len(row), values.shape[2])), np.zeros(len(row))
    for direction in _DIRECTIONS:
        numbers, run = _line(values, there, row, column, direction)
        for formula in formulas:
            order = len(formula)
            better, equal = (run >= order) & (order > best), (run >= order) & (order == best)
            value = np.tensordot(numbers[..., :order], np.asarray(formula), axes=1)
            added = np.where(equal[:, None], total + value, total)
            total = np.where(better[:, None], value, added)
            count = np.where(better, 1.0, count + equal)
            best = np.where(better, order, best)
    filled_in, known = values.copy(), there.copy()
    filled_in[row, column] = total / count[:, None]
    known[row, column] = True
    return filled_in, known


def _line(
    values: FloatArray,
    there: BoolArray,
    row: IntArray,
    column: IntArray,
    direction: tuple[int, int],
) -> tuple[FloatArray, IntArray]:
    """Return the next four values in a direction, and how many of them are known in a row."""
    rows, columns = there.shape
    numbers = np.zeros((len(row), values.shape[2], 4))
    run = np.zeros(len(row), dtype=np.int64)
    for step in range(1, 5):
        j, i = row + step * direction[0], column + step * direction[1]
        inside = (j >= 0) & (j < rows) & (i >= 0) & (i < columns)
        j, i = np.clip(j, 0, rows - 1), np.clip(i, 0, columns - 1)
        known = inside & there[j, i] & (run == step - 1)
        numbers[..., step - 1] = np.where(known[:, None], values[j, i], 0.0)
        run += known
    return numbers, run


def _widened(places: BoolArray) -> BoolArray:
    """Return the places and all beside them, also diagonally."""
    padded = np.pad(places, 1)
    rows, columns = places.shape
    around = [padded[j : j + rows, i : i + columns] for j in range(3) for i in range(3)]
    return np.any(around, axis=0)
