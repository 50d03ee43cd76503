# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables from files and to files, by the ending of the name."""

from functools import lru_cache
from pathlib import Path

from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ...files import replacing, write_pieces
from .csv_file import csv_lines, read_csv
from .edges import MOST_BYTES
from .exr_file import read_exr, write_exr
from .npz import read_npz, write_npz
from .text_file import read_text_table, text_lines

SUFFIXES = (".npz", ".csv", ".txt", ".bsdf", ".exr")

_READERS = {
    ".npz": read_npz,
    ".csv": read_csv,
    ".txt": read_text_table,
    ".bsdf": read_text_table,
    ".exr": read_exr,
}


def read_table(file: str) -> EfficiencyTable:
    """Read a table; a file that has not changed since is not read again.

    Args:
        file: A file whose name ends in one of `SUFFIXES`.

    Returns:
        The table, not to be written to.

    Raises:
        SpecError: The file is missing, of another kind, too large or damaged, or a number in it
            breaks a rule; one line that tells axis, row and value, without the file's name.
    """
    path = Path(file)
    check_suffix(path)
    try:
        status = path.stat()
        if not path.is_file():
            raise SpecError("must be a file")
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise SpecError(f"must be a file that exists ({reason})") from error
    if status.st_size == 0:
        raise SpecError("is empty")
    if status.st_size > MOST_BYTES:
        raise SpecError(f"must be at most {MOST_BYTES // 2**20} MB")
    return _read(file, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=8)
def _read(file: str, _time: int, _size: int) -> EfficiencyTable:
    path = Path(file)
    table = _READERS[path.suffix.lower()](path)
    for array in (*table.axes, table.values):
        array.flags.writeable = False
    return table


def write_table(file: str | Path, table: EfficiencyTable) -> None:
    """Write a table; the file appears whole or not at all.

    Args:
        file: The file; its ending chooses the format.
        table: The table.

    Raises:
        SpecError: The name has another ending.
        OutputError: The file cannot be written.
    """
    path = Path(file)
    suffix = check_suffix(path)
    with replacing(path) as part:
        if suffix == ".npz":
            write_npz(part, table)
        elif suffix == ".exr":
            write_exr(part, table)
        else:
            write_pieces(path, part, (csv_lines if suffix == ".csv" else text_lines)(table))


def check_suffix(path: Path) -> str:
    """Check the ending of a table's name.

    Args:
        path: The file.

    Returns:
        The ending in small letters.

    Raises:
        SpecError: It is none of `SUFFIXES`.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise SpecError(f"must end in {', '.join(SUFFIXES)}")
    return suffix
