# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays as CSV: read with every value checked, written so that it reads back to the last bit."""

import csv
import io
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..core.arrays import unit
from ..core.errors import SpecError
from ..model.field_error import FieldError
from ..model.fields import MAX_ORDER, wavelength_value
from ..model.rays import STATUS_NAMES, RayTable, TraceResult
from ..model.reading import naming, read_text
from .parser import parse_number, parse_whole

NUMBERS = ("x_mm", "y_mm", "z_mm", "l", "m", "n", "wavelength_nm")
COLUMNS = (*NUMBERS, "order", "side")
RESULTS = ("hit_x_mm", "hit_y_mm", "out_l", "out_m", "out_n", "status", "efficiency")
SIDES = ("T", "R")

_MAX_BYTES = 512 * 2**20

type Row = tuple[float, float, float, float, float, float, float, int, str]


def read_rays(path: str | Path) -> list[Row]:
    """Read rays, one a row, columns in any order.

    Args:
        path: The file.

    Returns:
        The rows in the order of ``COLUMNS``, numbers as written.

    Raises:
        SpecError: ``FILE: line, column: what is wrong, and the value``.
    """
    with naming(path):
        # newline="" keeps line ends inside quotes, as the csv module wants it.
        reader = csv.reader(io.StringIO(read_text(path, _MAX_BYTES), newline=""), strict=True)
        try:
            header = [name.strip() for name in next(reader, [])]
            _check_header(header)
            return [
                _row(reader.line_num, dict(zip(header, cells, strict=False)), len(cells))
                for cells in reader
                if cells
            ]
        except csv.Error as error:
            raise SpecError(f"line {reader.line_num}: is not valid CSV: {error}") from error


def _check_header(header: list[str]) -> None:
    if not header:
        raise SpecError(f"line 1: must name the columns {','.join(COLUMNS)}, got an empty line")
    for name in COLUMNS:
        if header.count(name) != 1:
            count = "is missing" if name not in header else "stands twice"
            raise FieldError("line 1", f"column {name} {count}", ",".join(header))
    for name in header:
        if name not in COLUMNS:
            raise FieldError("line 1", f"must name only {','.join(COLUMNS)}", name)


def _row(line: int, cells: dict[str, str], count: int) -> Row:
    if count != len(COLUMNS):
        raise FieldError(f"line {line}", f"must have {len(COLUMNS)} values", count)
    x, y, z, along_x, along_y, along_z, wavelength_nm = (
        _number(line, name, cells[name]) for name in NUMBERS
    )
    if not (along_x or along_y or along_z):
        direction = (along_x, along_y, along_z)
        raise FieldError(f"line {line}, columns l,m,n", "must not have zero length", direction)
    wavelength_value(f"line {line}, column wavelength_nm", wavelength_nm)
    side = cells["side"].strip()
    if side not in SIDES:
        raise FieldError(f"line {line}, column side", "must be T or R", side)
    order = _order(line, cells["order"])
    return x, y, z, along_x, along_y, along_z, wavelength_nm, order, side


def _number(line: int, name: str, text: str) -> float:
    try:
        return parse_number(text)
    except ValueError:
        field = f"line {line}, column {name}"
        raise FieldError(field, "must be a finite number", text) from None


def _order(line: int, text: str) -> int:
    try:
        order = parse_whole(text)
    except ValueError:
        order = MAX_ORDER + 1
    if abs(order) > MAX_ORDER:
        rule = f"must be a whole number from {-MAX_ORDER} to {MAX_ORDER}"
        raise FieldError(f"line {line}, column order", rule, text)
    return order


def ray_table(rows: list[Row]) -> RayTable:
    """Make the table for an engine; directions get length 1.

    Args:
        rows: Rows of `read_rays`.

    Returns:
        The rays.
    """
    values = np.asarray([row[:7] for row in rows], dtype=np.float64).reshape(-1, len(NUMBERS))
    return RayTable(
        origin_mm=values[:, 0:3],
        direction=unit(values[:, 3:6]),
        wavelength_nm=values[:, 6],
        order=np.asarray([row[7] for row in rows], dtype=np.int64),
        reflected=np.asarray([row[8] == "R" for row in rows], dtype=np.bool_),
    )


def result_lines(rows: list[Row], result: TraceResult) -> Iterator[str]:
    """Make the lines of the output, header first; what does not exist is ``nan``.

    Args:
        rows: Rows of `read_rays`.
        result: What became of them.

    Yields:
        Lines with their ends.
    """
    yield ",".join((*COLUMNS, *RESULTS)) + "\n"
    columns = (result.hit_mm[:, :2], result.direction, result.efficiency[:, None])
    found = np.concatenate(columns, axis=1).tolist()
    for row, (*numbers, efficiency), status in zip(
        rows, found, result.status.tolist(), strict=True
    ):
        cells = (*row[:8], row[8], *numbers, STATUS_NAMES[status], efficiency)
        yield ",".join(cell if isinstance(cell, str) else _written(cell) for cell in cells) + "\n"


def _written(number: float) -> str:
    return "nan" if math.isnan(number) else repr(number)
