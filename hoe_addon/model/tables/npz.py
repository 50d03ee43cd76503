# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as .npz archives of named arrays: objects are refused, and sizes looked at first."""

import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ..npy import NpyHeader
from .edges import MOST_NUMBERS, NAMES, SCHEMA, FileTable, default_axis, from_core, to_core

_NEEDED = ("order", "side", "efficiency")
_KNOWN = {*NAMES, *_NEEDED, "schema", "incidence", "frequency", "beyond"}
_DIMENSIONS = 7
_MOST_UNPACKED = 8 * MOST_NUMBERS + 2**20
"""Bytes of all arrays: the shares, and room for the rest."""

_PACKED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""What numpy writes; other ways to pack fail in ways of their own."""

_DAMAGED = (
    OSError,
    ValueError,
    EOFError,
    OverflowError,
    NotImplementedError,
    RuntimeError,
    zipfile.BadZipFile,
    zlib.error,
)
"""What reading a damaged archive can raise."""


def write_npz(part: Path, table: EfficiencyTable) -> None:
    """Write a table into a file that is being replaced.

    Args:
        part: The file; it exists.
        table: The table.
    """
    given = from_core(table)
    arrays = dict(zip(NAMES, given.axes, strict=True))
    with part.open("wb") as file:
        np.savez(
            file,
            schema=np.array(SCHEMA),
            incidence=np.array(given.incidence),
            order=np.array(given.order),
            side=np.array(given.side),
            frequency=np.array(given.frequency),
            efficiency=given.efficiency,
            beyond=np.array(given.beyond),
            **arrays,
        )


def read_npz(path: Path) -> EfficiencyTable:
    """Read a table.

    Args:
        path: The file.

    Returns:
        The table.

    Raises:
        SpecError: It is damaged, too large, or breaks a rule.
    """
    found = read_arrays(path, _KNOWN)
    for name in _NEEDED:
        if name not in found:
            raise SpecError(f"{name}: is missing")
    schema = found.get("schema", np.array(SCHEMA))
    if schema.shape != () or schema.dtype.kind not in "iu" or int(schema) != SCHEMA:
        raise SpecError(f"schema: must be {SCHEMA}, got {str(schema.ravel()[:1])[:40]}")
    order = _numbers(found, "order", "iu", 1)
    shares = _numbers(found, "efficiency", "fiu", _DIMENSIONS).astype(np.float64)
    axes = tuple(
        _numbers(found, name, "fiu", 1).astype(np.float64) if name in found else default_axis(axis)
        for axis, name in enumerate(NAMES)
    )
    columns = len(order)
    frequency = np.ones(columns)
    if "frequency" in found:
        frequency = _numbers(found, "frequency", "fiu", 1).astype(np.float64)
    side = _words(found, "side")
    if len(side) != columns or len(frequency) != columns:
        raise SpecError(f"side, frequency: must have {columns} entries, like order")
    wavelength, along, across, x, y = axes
    return to_core(
        FileTable(
            (wavelength, along, across, x, y),
            _words(found, "incidence") if "incidence" in found else ["back"],
            [int(number) for number in order.tolist()],
            side,
            [float(number) for number in frequency.tolist()],
            shares,
            _words(found, "beyond")[0] if "beyond" in found else "clamp",
        )
    )


def read_arrays(path: Path, known: set[str]) -> dict[str, NDArray[np.generic]]:
    """Read the arrays of an archive that may come from a stranger.

    Args:
        path: The file.
        known: Names that may stand in it.

    Returns:
        Array by name.

    Raises:
        SpecError: It is damaged or too large, or holds objects or other names.
    """
    found: dict[str, NDArray[np.generic]] = {}
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
            names = [member.filename.removesuffix(".npy") for member in members]
            if len(set(names)) < len(names) or not set(names) <= known:
                odd = next((name for name in names if name not in known), names[-1])
                raise SpecError(f"holds an array that is not known or doubled: {ascii(odd)[:40]}")
            if any(member.compress_type not in _PACKED for member in members):
                raise SpecError("must be packed as numpy does it, or not at all")
            if sum(member.file_size for member in members) > _MOST_UNPACKED:
                raise SpecError(f"must hold at most {_MOST_UNPACKED // 2**20} MB unpacked")
            for name, member in zip(names, members, strict=True):
                found[name] = _read(archive, member, name)
    except _DAMAGED as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise SpecError(f"is no readable .npz file ({reason})") from error
    return found


def _read(archive: zipfile.ZipFile, member: zipfile.ZipInfo, name: str) -> NDArray[np.generic]:
    with archive.open(member) as stream:
        try:
            return _array(stream)
        except SpecError as error:
            raise SpecError(f"{name}: {error}") from error


def _array(stream: IO[bytes]) -> NDArray[np.generic]:
    header = NpyHeader.read(stream)
    if header.dtype.kind not in "fiuU":
        raise SpecError(f"must hold numbers or words, not {header.dtype}")
    if header.size > _MOST_UNPACKED:
        raise SpecError(f"must hold at most {MOST_NUMBERS} numbers, got {header.shape}")
    # No more than was asked for is unpacked, and one byte that must not be there.
    return header.array(stream.read(header.size + 1))


def _numbers(
    found: Mapping[str, NDArray[np.generic]], name: str, kinds: str, dimensions: int
) -> NDArray[Any]:
    values = found[name]
    if values.dtype.kind not in kinds:
        rule = "whole numbers" if "f" not in kinds else "numbers"
        raise SpecError(f"{name}: must hold {rule}, not {values.dtype}")
    if values.ndim != dimensions:
        raise SpecError(f"{name}: must have {dimensions} dimensions, got the shape {values.shape}")
    return values


def _words(found: Mapping[str, NDArray[np.generic]], name: str) -> list[str]:
    values = found[name]
    if values.dtype.kind != "U" or values.ndim > 1 or values.size == 0:
        raise SpecError(f"{name}: must be a list of words, got {values.dtype} {values.shape}")
    return [str(word) for word in np.atleast_1d(values).tolist()]
