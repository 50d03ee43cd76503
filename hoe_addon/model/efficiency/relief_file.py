# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Heights of a relief over one period, in files that may come from strangers."""

from functools import lru_cache
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import SpecError
from ..npy import read_npy
from ..reading import read_text

FEWEST, MOST = 2, 4096
LARGEST = 100.0
"""Heights along one period, and the largest one in size, in full depths."""

_MAX_TEXT_BYTES = 2**20
_SUFFIXES = (".csv", ".npy", ".txt")


def read_heights(file: str) -> FloatArray:
    """Read the heights of one period; a file that has not changed since is not read again.

    Args:
        file: A one-dimensional .npy, or a .csv or .txt with one number a line or commas between.

    Returns:
        Finite heights, not to be written to, shape ``(n,)``.

    Raises:
        SpecError: The file is missing, of another kind, damaged, or of a wrong size, or holds a
            value that is no usable height; the message tells what, without the file's name.
    """
    path = Path(file)
    if path.suffix.lower() not in _SUFFIXES:
        raise SpecError(f"must end in {', '.join(_SUFFIXES)}")
    try:
        status = path.stat()
        is_file = path.is_file()
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise SpecError(f"must be a file that exists ({reason})") from error
    if not is_file:
        raise SpecError("must be a file")
    return _read(file, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=8)
def _read(file: str, _time: int, _size: int) -> FloatArray:
    path = Path(file)
    values = read_npy(path, _check_shape) if path.suffix.lower() == ".npy" else _from_text(path)
    _check_count(len(values))
    # A comparison with NaN is false.
    bad = ~(np.abs(values) <= LARGEST)
    if bad.any():
        place = int(np.argmax(bad))
        rule = f"must hold finite heights up to {LARGEST:g}"
        raise SpecError(f"{rule}, not {values[place]} at number {place + 1}")
    values.flags.writeable = False
    return values


def _check_count(count: int) -> None:
    if not FEWEST <= count <= MOST:
        raise SpecError(f"must hold {FEWEST} to {MOST} heights, not {count}")


def _check_shape(shape: tuple[int, ...]) -> None:
    if len(shape) != 1:
        raise SpecError(f"must have one dimension, not the shape {shape}")
    _check_count(shape[0])


def _from_text(path: Path) -> FloatArray:
    cells = read_text(path, _MAX_TEXT_BYTES).replace(",", "\n").split("\n")
    while cells and not cells[-1].strip():
        cells.pop()
    _check_count(len(cells))
    values = np.empty(len(cells))
    for place, cell in enumerate(cells):
        try:
            values[place] = float(cell)
        except ValueError as error:
            shown = ascii(cell.strip()[:20])
            raise SpecError(f"must hold numbers, not {shown} at number {place + 1}") from error
    return values
