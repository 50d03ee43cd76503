# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as CSV, one share a row, with a header; also those of the command ``efficiency``."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ..reading import read_text
from .edges import MOST_BYTES, MOST_NUMBERS, NAMES, default_axis, from_core, to_core
from .records import Column, Records, gridded

_NEEDED = ("order", "side", "efficiency")
_ANGLES = ("theta_deg", "phi_deg")
_KNOWN = (*NAMES, *_ANGLES, "incidence", "frequency", *_NEEDED)
_LONGEST_HEADER = 10_000
_FIRST_ROW = 2


def csv_lines(table: EfficiencyTable) -> Iterator[str]:
    """Write a table.

    Args:
        table: The table.

    Yields:
        The lines; collapsed axes have no column.
    """
    given = from_core(table)
    kept = [axis for axis, nodes in enumerate(given.axes) if len(nodes) > 1]
    multiplexed = any(frequency != 1.0 for frequency in given.frequency)
    names = [NAMES[axis] for axis in kept]
    names += ["incidence", "order", "side", *["frequency"] * multiplexed, "efficiency"]
    yield ",".join(names) + "\n"
    texts = [[repr(float(node)) for node in given.axes[axis]] for axis in kept]
    columns = [
        ",".join((str(order), side, *[repr(frequency)] * multiplexed))
        for order, side, frequency in zip(given.order, given.side, given.frequency, strict=True)
    ]
    for place in _places(given.efficiency.shape[:-1]):
        nodes = [texts[column][place[1 + axis]] for column, axis in enumerate(kept)]
        start = ",".join((*nodes, given.incidence[place[0]]))
        for column, share in zip(columns, given.efficiency[place].tolist(), strict=True):
            yield f"{start},{column},{share!r}\n"


def _places(shape: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    return product(*map(range, shape))


def read_csv(path: Path) -> EfficiencyTable:
    """Read a table.

    Args:
        path: The file.

    Returns:
        The table.

    Raises:
        SpecError: It is damaged, too large, or breaks a rule; the message names column and row.
    """
    lines = read_text(path, MOST_BYTES).splitlines()
    while lines and not lines[-1].strip():
        lines.pop()
    if not lines:
        raise SpecError("is empty")
    if not 1 < len(lines) <= MOST_NUMBERS + 1:
        raise SpecError(f"rows: must be 1 to {MOST_NUMBERS} below a header, got {len(lines) - 1}")
    names = [name.strip() for name in lines[0].split(",")]
    _check_names(names)
    cells = [line.split(",") for line in lines[1:]]
    for row, line in enumerate(cells, start=_FIRST_ROW):
        if len(line) != len(names):
            raise SpecError(f"must hold {len(names)} columns, got {len(line)} in row {row}")
    by_name = dict(zip(names, zip(*cells, strict=True), strict=True))
    return to_core(gridded(_records(by_name, len(cells))))


def _check_names(names: Sequence[str]) -> None:
    for name in names:
        if name not in _KNOWN or names.count(name) > 1:
            rule = "must name each column once, one of " + ", ".join(_KNOWN)
            raise SpecError(f"header: {rule}, got {ascii(name)[:40]}")
    for name in _NEEDED:
        if name not in names:
            raise SpecError(f"header: {name} is missing")
    angles = [name for name in _ANGLES if name in names]
    if angles and (len(angles) < len(_ANGLES) or {"along_deg", "across_deg"} & set(names)):
        rule = "directions must be along_deg and across_deg, or theta_deg and phi_deg"
        raise SpecError(f"header: {rule}, got {', '.join(names)[:80]}")


def _records(columns: Mapping[str, Sequence[str]], count: int) -> Records:
    order = [_whole(cell, row) for row, cell in _rows(columns["order"])]
    side = [cell.strip() for cell in columns["side"]]
    frequency = [1.0] * count
    if "frequency" in columns:
        frequency = _numbers(columns, "frequency").tolist()
    values = np.stack(
        [
            _numbers(columns, name) if name in columns else np.repeat(default_axis(axis), count)
            for axis, name in enumerate(NAMES)
        ],
        axis=-1,
    )
    if _ANGLES[0] in columns:
        values[:, 1] = _along_deg(*(_numbers(columns, name) for name in _ANGLES))
    incidence = [cell.strip() for cell in columns.get("incidence", ["back"] * count)]
    for row, cell in enumerate(incidence, start=_FIRST_ROW):
        if cell not in ("back", "front"):
            raise SpecError(f"incidence: must be back or front, got {cell[:20]!r} in row {row}")
    for row, cell in enumerate(side, start=_FIRST_ROW):
        if cell not in ("T", "R"):
            raise SpecError(f"side: must be T or R, got {cell[:20]!r} in row {row}")
    ways: list[Column] = list(zip(order, side, frequency, strict=True))
    return Records(values, incidence, ways, _numbers(columns, "efficiency"), _FIRST_ROW)


def counts_along_the_element(path: Path) -> bool:
    """Tell whether directions in a file are told in the frame of the element.

    Args:
        path: A readable CSV of a table.

    Returns:
        True for theta_deg and phi_deg, False for angles along the grating.
    """
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        return _ANGLES[0] in [name.strip() for name in file.readline(_LONGEST_HEADER).split(",")]


def _along_deg(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """Angles along the grating of directions in the plane of x and the normal."""
    turned = np.where(theta == 0.0, 0.0, np.mod(phi, 180.0))
    bad = np.flatnonzero(~(turned == 0.0))
    if len(bad):
        row = int(bad[0])
        rule = "must be 0 or 180, so that the directions make a grid along the grating"
        raise SpecError(f"phi_deg: {rule}, got {phi[row]:g} in row {row + _FIRST_ROW}")
    forward = np.mod(phi, 360.0) == 0.0
    # The sign of a zero would make two nodes of one.
    return np.where(forward, theta, -theta) + 0.0


def _rows(cells: Sequence[str]) -> Iterator[tuple[int, str]]:
    return enumerate(cells, start=_FIRST_ROW)


def _numbers(columns: Mapping[str, Sequence[str]], name: str) -> FloatArray:
    cells = columns[name]
    try:
        return np.asarray([float(cell) for cell in cells])
    except ValueError:
        for row, cell in _rows(cells):
            try:
                float(cell)
            except ValueError as error:
                shown = ascii(cell.strip()[:20])
                raise SpecError(f"{name}: must be a number, got {shown} in row {row}") from error
        raise


def _whole(cell: str, row: int) -> int:
    text = cell.strip()
    if (
        not text.removeprefix("-").isascii()
        or not text.removeprefix("-").isdigit()
        or len(text) > 5
    ):
        raise SpecError(f"order: must be a whole number, got {text[:20]!a} in row {row}")
    return int(text)
