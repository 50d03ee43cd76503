# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables between the units of files (nm, degrees, mm) and those of the core, checked on the way.

An angle in a file is the arc sine of a direction cosine: along_deg of the component along the
grating, across_deg of that across it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.table import Beyond, EfficiencyTable
from ...core.efficiency.table_check import AXES, SIDES, Side, check_shares
from ...core.errors import SpecError
from ...core.orders import Branch
from ...core.units import m_to_mm, m_to_nm, mm_to_m, nm_to_m
from .. import fields

SCHEMA = 1
"""Version of the formats."""

MOST_NUMBERS = 4_000_000
"""Most shares in a file: 32 MB."""

MOST_BYTES = 256 * 2**20

NAMES = ("wavelength_nm", "along_deg", "across_deg", "x_mm", "y_mm")
"""Names of the axes in files."""

ANY_NM = 550.0
"""Stands for any wavelength, where a file has none."""

_MICROMETRES, _METRES = 20.0, 1e-3
"""Numbers below these are no wavelengths in nm."""


@dataclass(frozen=True, eq=False)
class FileTable:
    """What a file says.

    Attributes:
        axes: Wavelengths in nm, angles along and across in degrees, x and y in mm.
        incidence: Sides that the light comes from.
        order: Order of each column.
        side: ``T`` or ``R`` for each column.
        frequency: Grating frequency of each column over that of the pattern.
        efficiency: Shares, shape ``(S, W, A, B, X, Y, K)``.
        beyond: What holds outside the nodes.
        names: What the file calls the axes.
    """

    axes: tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]
    incidence: Sequence[str]
    order: Sequence[int]
    side: Sequence[str]
    frequency: Sequence[float]
    efficiency: FloatArray
    beyond: str = "clamp"
    names: Sequence[str] = NAMES


def to_core(given: FileTable) -> EfficiencyTable:
    """Check what a file says, and make the table.

    Args:
        given: The contents of the file.

    Returns:
        The table.

    Raises:
        SpecError: Something breaks a rule; the message tells the place in the words and units of
            the file, and the value.
    """
    for axis, nodes in enumerate(given.axes):
        check_nodes(axis, nodes, given.names[axis])
    _check_columns(given)
    if given.efficiency.size > MOST_NUMBERS:
        raise SpecError(f"efficiency: must hold at most {MOST_NUMBERS} numbers")
    columns = zip(given.order, given.side, given.frequency, strict=True)
    branches = tuple(
        Branch(order, reflected=side == "R", frequency=frequency)
        for order, side, frequency in columns
    )

    def show(axis: int, node: float) -> str:
        return f"{given.names[axis]} {node:.6g}"

    check_shares(given.efficiency, given.incidence, given.axes, branches, show)
    wavelength, along, across, x, y = given.axes
    return EfficiencyTable(
        branches,
        nm_to_m(wavelength),
        np.sin(np.radians(along)),
        np.sin(np.radians(across)),
        mm_to_m(x),
        mm_to_m(y),
        cast("tuple[Side, ...]", tuple(given.incidence)),
        given.efficiency,
        cast("Beyond", given.beyond),
    )


def from_core(table: EfficiencyTable) -> FileTable:
    """Turn a table into what files say.

    Args:
        table: The table.

    Returns:
        The same in nm, degrees and mm.
    """
    along, across = (np.degrees(np.arcsin(part)) for part in (table.along, table.across))
    axes = (m_to_nm(table.wavelength), along, across, m_to_mm(table.x), m_to_mm(table.y))
    return FileTable(
        axes,
        table.sides,
        [way.order for way in table.branches],
        ["R" if way.reflected else "T" for way in table.branches],
        [way.frequency for way in table.branches],
        table.values,
        table.beyond,
    )


def check_nodes(axis: int, nodes: FloatArray, name: str, rows: Sequence[int] | None = None) -> None:
    """Check the nodes of one axis of a file, among them whether the unit can be right.

    Args:
        axis: Number of the axis in `NAMES`.
        nodes: Nodes in the unit of the file.
        name: What the file calls the axis.
        rows: Row of the file where each node stands first; None where the file lists the nodes.

    Raises:
        SpecError: With the name of the axis, the row or the entry, and the value.
    """
    if nodes.ndim != 1 or nodes.size == 0:
        raise SpecError(f"{name}: must be a list of at least one node, got shape {nodes.shape}")
    if axis == 0 and float(np.max(np.abs(nodes))) < _MICROMETRES:
        unit = "metres" if float(np.max(np.abs(nodes))) < _METRES else "um"
        raise SpecError(f"{name}: must be in nm, got {nodes[0]:g}, which looks like {unit}")
    low, high = fields.WAVELENGTH_RANGE_NM
    for place, node in enumerate(nodes.tolist()):
        where = f"entry {place + 1}" if rows is None else f"row {rows[place]}"
        if not np.isfinite(node):
            raise SpecError(f"{name}: must be finite, got {node} in {where}")
        if place and node <= nodes[place - 1]:
            before = f"{nodes[place - 1]:g}"
            raise SpecError(f"{name}: must increase, got {node:g} after {before} in {where}")
        if axis in (1, 2) and abs(node) > 90.0:
            raise SpecError(f"{name}: must be from -90 to 90 degrees, got {node:g} in {where}")
        if axis == 0 and not low <= node <= high:
            rule = f"must be from {low:g} to {high:g} nm"
            raise SpecError(f"{name}: {rule}, got {node:g} in {where}")


def _check_columns(given: FileTable) -> None:
    for row, (order, side) in enumerate(zip(given.order, given.side, strict=True), start=1):
        check_order(order, f"entry {row}")
        if side not in ("T", "R"):
            raise SpecError(f"side: must be T or R, got {side[:20]!r} in entry {row}")
    for row, frequency in enumerate(given.frequency, start=1):
        check_frequency(frequency, f"entry {row}")
    for row, side in enumerate(given.incidence, start=1):
        if side not in SIDES:
            raise SpecError(f"incidence: must be back or front, got {side[:20]!r} in entry {row}")


def check_order(order: int, where: str) -> None:
    """Check one order.

    Args:
        order: The order.
        where: Where it stands, for the message.

    Raises:
        SpecError: It is too high.
    """
    if abs(order) > fields.MAX_ORDER:
        rule = f"must be from -{fields.MAX_ORDER} to {fields.MAX_ORDER}"
        raise SpecError(f"order: {rule}, got {order} in {where}")


def check_frequency(frequency: float, where: str) -> None:
    """Check one grating frequency over that of the pattern.

    Args:
        frequency: The ratio.
        where: Where it stands, for the message.

    Raises:
        SpecError: It is 0, not finite or too large.
    """
    if not (np.isfinite(frequency) and 0.0 < abs(frequency) < fields.MAX_ORDER):
        raise SpecError(f"frequency: must be finite and not 0, got {frequency} in {where}")


def default_axis(axis: int) -> FloatArray:
    """One node for an axis that a file leaves out: it stands for any value."""
    return np.array([ANY_NM if AXES[axis] == "wavelength" else 0.0])
