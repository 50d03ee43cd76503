# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shares listed one a row, put onto a grid: every node has to be there once."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray, IntArray
from ...core.efficiency.table_check import SIDES
from ...core.errors import SpecError
from .edges import MOST_NUMBERS, NAMES, FileTable, check_frequency, check_nodes, check_order

type Column = tuple[int, str, float]
"""Order, side, and grating frequency over that of the pattern."""


@dataclass(frozen=True, eq=False)
class Records:
    """Rows of a file.

    Attributes:
        values: Values of the five axes in the units of files, shape ``(N, 5)``.
        incidence: Side that the light comes from, N of them.
        columns: Branch of each row.
        efficiency: Share of each row, shape ``(N,)``.
        first_row: Number of the first row in the file.
    """

    values: FloatArray
    incidence: Sequence[str]
    columns: Sequence[Column]
    efficiency: FloatArray
    first_row: int


def gridded(rows: Records) -> FileTable:
    """Put rows onto the grid of all values that occur in them.

    Directions that are none, beyond grazing, may be left out. A node that stands twice must have
    the same share both times.

    Args:
        rows: The rows, in any order.

    Returns:
        The contents of the file.

    Raises:
        SpecError: A node is missing, or stands twice with different shares.
    """
    _check_rows(rows)
    axes: list[FloatArray] = []
    for axis, name in enumerate(NAMES):
        nodes, first = np.unique(rows.values[:, axis], return_index=True)
        check_nodes(axis, nodes, name, [rows.first_row + int(place) for place in first])
        axes.append(nodes)
    sides = [side for side in SIDES if side in set(rows.incidence)]
    columns = list(dict.fromkeys(rows.columns))
    shape = (len(sides), *(len(axis) for axis in axes), len(columns))
    most = MOST_NUMBERS if np.prod(shape, dtype=float) <= MOST_NUMBERS else 0
    if not most or len(rows.efficiency) * 4 < np.prod(shape, dtype=float):
        words = " x ".join(str(count) for count in shape)
        raise SpecError(
            f"rows: must be a full grid; the values in {len(rows.efficiency)} rows make one of "
            f"{words} (incidence, {', '.join(NAMES)}, order)"
        )
    index: list[IntArray] = [
        np.asarray([sides.index(side) for side in rows.incidence], dtype=np.int64)
    ]
    index += [np.searchsorted(axis, rows.values[:, place]) for place, axis in enumerate(axes)]
    number = {column: place for place, column in enumerate(columns)}
    index.append(np.asarray([number[column] for column in rows.columns], dtype=np.int64))
    flat = np.ravel_multi_index(tuple(index), shape)
    shares = np.full(int(np.prod(shape)), np.nan)
    shares[flat] = rows.efficiency
    twice = np.flatnonzero(shares[flat] != rows.efficiency)
    if len(twice):
        row = int(twice[0])
        rule = "a node stands twice with different shares"
        raise SpecError(
            f"efficiency: {rule}, got {rows.efficiency[row]:g} in row {row + rows.first_row}"
        )
    wavelength, along, across, x, y = axes
    return FileTable(
        (wavelength, along, across, x, y),
        sides,
        [column[0] for column in columns],
        [column[1] for column in columns],
        [column[2] for column in columns],
        _without_gaps(shares.reshape(shape), along, across),
    )


def _check_rows(rows: Records) -> None:
    if not len(rows.efficiency):
        raise SpecError("rows: must hold at least one")
    parts = (*rows.values.T, rows.efficiency)
    for name, column in zip((*NAMES, "efficiency"), parts, strict=True):
        bad = np.flatnonzero(~np.isfinite(column))
        if len(bad):
            row = int(bad[0])
            raise SpecError(
                f"{name}: must be finite, got {column[row]} in row {row + rows.first_row}"
            )
    for row, (order, _, frequency) in enumerate(rows.columns, start=rows.first_row):
        check_order(order, f"row {row}")
        check_frequency(frequency, f"row {row}")
    low = np.flatnonzero(rows.efficiency < 0.0)
    if len(low):
        row = int(low[0])
        got = f"got {rows.efficiency[row]:g} in row {row + rows.first_row}"
        raise SpecError(f"efficiency: must be at least 0, {got}")


def _without_gaps(shares: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray:
    """Give corners beyond grazing the share of the nearest direction across the grating."""
    sines = np.sin(np.radians(along))[:, None], np.sin(np.radians(across))[None, :]
    missing = np.isnan(shares)
    if not missing.any():
        return shares
    far = np.hypot(*sines) > 1.0 - 1e-9
    filled = shares.copy()
    for row, column in np.argwhere(far).tolist():
        inside = np.flatnonzero(~far[row])
        if len(inside):
            nearest = int(inside[np.argmin(np.abs(sines[1][0, inside] - sines[1][0, column]))])
            here = filled[:, :, row, column]
            filled[:, :, row, column] = np.where(np.isnan(here), filled[:, :, row, nearest], here)
    return filled
