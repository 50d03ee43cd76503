# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of numbers in files that may come from strangers: nothing in them is run."""

from functools import lru_cache
from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)

from ...core.arrays import FloatArray
from ...core.errors import SpecError
from ..image_file import read_exr_pixels
from ..npy import read_npy
from ..reading import read_text

FEWEST, MOST = 4, 8192
LARGEST = 1e12
"""Values along each side."""

MAX_CSV_BYTES = 256 * 2**20
SUFFIXES = (".csv", ".exr", ".npy")


def read_grid(file: str) -> FloatArray:
    """Read a grid of numbers; one that has not changed since is not read again.

    Args:
        file: An .exr, .npy or .csv file.

    Returns:
        Finite values, not to be written to, the first row of the file first, shape ``(ny, nx)``.

    Raises:
        SpecError: The file is missing, of another kind, damaged, or of a wrong size, or holds a
            value that is not finite; the message tells what, without the file's name.
    """
    return _read(*stamped(file))


def stamped(file: str) -> tuple[str, int, int]:
    """Find the time and size of a file, so that what is made of it is made anew after a change.

    Args:
        file: An .exr, .npy or .csv file.

    Returns:
        The file, its time of change in ns, and its bytes.

    Raises:
        SpecError: It is missing or of another kind.
    """
    path = Path(file)
    if path.suffix.lower() not in SUFFIXES:
        raise SpecError(f"must end in {', '.join(SUFFIXES)}")
    try:
        status = path.stat()
        if not path.is_file():
            raise SpecError("must be a file")
    except (OSError, ValueError) as error:
        raise SpecError(f"must be a file that exists ({_reason(error)})") from error
    return file, status.st_mtime_ns, status.st_size


@lru_cache(maxsize=2)
def _read(file: str, _time: int, _size: int) -> FloatArray:
    path = Path(file)
    match path.suffix.lower():
        case ".npy":
            values = read_npy(path, _check_shape)
        case ".csv":
            values = _read_csv(path)
        case _:
            values = _read_exr(path)
    _check_size(*values.shape)
    # A comparison with NaN is false.
    bad = ~(np.abs(values) <= LARGEST)
    if bad.any():
        row, column = np.argwhere(bad)[0].tolist()
        rule = f"must hold finite numbers up to {LARGEST:g}, not {values[row, column]}"
        raise SpecError(f"{rule} in row {row + 1}, column {column + 1}")
    values.flags.writeable = False
    return values


def _check_size(rows: int, columns: int) -> None:
    if not (FEWEST <= rows <= MOST and FEWEST <= columns <= MOST):
        raise SpecError(
            f"must hold {FEWEST} to {MOST} rows and columns, not {rows} rows of {columns}"
        )


def _check_shape(shape: tuple[int, ...]) -> None:
    if len(shape) != 2:
        raise SpecError(f"must have two dimensions, not the shape {shape}")
    _check_size(*shape)


def _read_exr(path: Path) -> FloatArray:
    pixels, _ = read_exr_pixels(path, _check_picture)
    with np.errstate(invalid="ignore"):  # a signalling NaN becomes a quiet one
        return pixels[..., 0].astype(np.float64)


def _check_picture(spec: "oiio.ImageSpec") -> None:
    _check_size(spec.height, spec.width)
    if spec.nchannels != 1:
        raise SpecError(f"must have one channel, not {spec.nchannels}")


def _read_csv(path: Path) -> FloatArray:
    lines = read_text(path, MAX_CSV_BYTES).splitlines()
    while lines and not lines[-1].strip():
        lines.pop()
    if not FEWEST <= len(lines) <= MOST:
        raise SpecError(f"must hold {FEWEST} to {MOST} rows, not {len(lines)}")
    columns = lines[0].count(",") + 1
    _check_size(len(lines), columns)
    values = np.empty((len(lines), columns))
    for row, line in enumerate(lines):
        cells = line.split(",")
        if len(cells) != columns:
            raise SpecError(f"must hold {columns} numbers a row, not {len(cells)} in row {row + 1}")
        for column, cell in enumerate(cells):
            values[row, column] = _number(cell, row, column)
    return values


def _number(cell: str, row: int, column: int) -> float:
    try:
        return float(cell)
    except ValueError as error:
        shown = ascii(cell.strip()[:20])
        place = f"in row {row + 1}, column {column + 1}"
        raise SpecError(f"must hold numbers, not {shown} {place}") from error


def _reason(error: Exception) -> str:
    reason = error.strerror if isinstance(error, OSError) else None
    return reason or str(error) or type(error).__name__
