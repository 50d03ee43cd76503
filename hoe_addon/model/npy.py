# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of .npy files that may come from strangers.

numpy evaluates the header of such a file as a piece of Python, and a damaged one can raise almost
anything. Here the header is matched with a pattern: nothing in it is run, and the size is known
before any number is read.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Self

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import FloatArray
from ..core.errors import SpecError

_MAGIC = b"\x93NUMPY"
_LENGTH_BYTES = {1: 2, 2: 4, 3: 4}
"""Bytes of the header's length, by the version of the format."""

_LONGEST_HEADER = 10_000
_MOST_DIMENSIONS = 32
_MOST_DIGITS = 12
_LONGEST_WORD = 1000

_ENTRY = rb"\s*'([a-z_]{1,20})'\s*:\s*('[^'\\]{1,20}'|True|False|\([0-9,L ]{0,500}\))\s*"
_ENTRIES = re.compile(rb"\s*\{" + b",".join([_ENTRY] * 3) + rb"(?:,\s*)?\}\s*")
_DTYPE = re.compile(rb"'([<>|])([biufcU])([0-9]{1,4})'")
_BYTES = {b"b": (1,), b"i": (1, 2, 4, 8), b"u": (1, 2, 4, 8), b"f": (2, 4, 8), b"c": (8, 16)}


@dataclass(frozen=True)
class NpyHeader:
    """What an array is like.

    Attributes:
        shape: Its shape.
        by_columns: Whether the first index runs fastest in the file.
        dtype: Kind of its entries: numbers or words, never objects.
    """

    shape: tuple[int, ...]
    by_columns: bool
    dtype: np.dtype[np.generic]

    @classmethod
    def read(cls, file: IO[bytes]) -> Self:
        """Read the header of an array.

        Args:
            file: At its beginning; it is left at the first entry.

        Returns:
            What it says.

        Raises:
            SpecError: It is damaged, or that of an array of anything but numbers or words.
        """
        start = file.read(len(_MAGIC) + 2)
        version = start[-2] if len(start) == len(_MAGIC) + 2 else 0
        if not start.startswith(_MAGIC) or version not in _LENGTH_BYTES:
            raise _damaged("it does not begin as an array of version 1 to 3 does")
        length = int.from_bytes(file.read(_LENGTH_BYTES[version]), "little")
        text = file.read(length) if length <= _LONGEST_HEADER else b""
        matched = _ENTRIES.fullmatch(text)
        found = matched.groups() if matched is not None else ()
        entries: dict[bytes, bytes] = dict(zip(found[::2], found[1::2], strict=True))
        if entries.keys() != {b"descr", b"fortran_order", b"shape"}:
            raise _damaged("its header does not tell the kind, order and shape of an array")
        order = entries[b"fortran_order"]
        if order not in (b"True", b"False"):
            raise _damaged(f"fortran_order must be True or False, not {_shown(order)}")
        return cls(_shape(entries[b"shape"]), order == b"True", _dtype(entries[b"descr"]))

    @property
    def size(self) -> int:
        """Bytes of all entries."""
        return math.prod(self.shape) * self.dtype.itemsize

    def array(self, data: bytes) -> NDArray[np.generic]:
        """Make the array.

        Args:
            data: Its entries as they stand in the file.

        Returns:
            The array, not to be written to.

        Raises:
            SpecError: They are not as many as the header says.
        """
        if len(data) != self.size:
            raise _damaged(f"it must have as many entries as its shape says, {self.shape}")
        flat: NDArray[np.generic] = np.frombuffer(data, self.dtype)
        return flat.reshape(self.shape, order="F" if self.by_columns else "C")


def read_npy(path: Path, check_shape: Callable[[tuple[int, ...]], None]) -> FloatArray:
    """Read an array of real numbers.

    Args:
        path: The file.
        check_shape: Raises SpecError for a shape that is not wanted, before anything is read.

    Returns:
        The array, as float64.

    Raises:
        SpecError: The file cannot be read, is damaged, or holds something else.
    """
    try:
        with path.open("rb") as file:
            header = NpyHeader.read(file)
            if header.dtype.kind not in "fiu":
                raise SpecError(f"must hold real numbers, not {header.dtype}")
            check_shape(header.shape)
            values = header.array(file.read(header.size))
    except OSError as error:
        raise _damaged(error.strerror or str(error)) from error
    with np.errstate(invalid="ignore"):  # a signalling NaN becomes a quiet one
        return values.astype(np.float64)


def _damaged(reason: str) -> SpecError:
    return SpecError(f"is no readable .npy file ({reason})")


def _shown(text: bytes) -> str:
    return ascii(text.decode("latin-1"))[:60]


def _shape(text: bytes) -> tuple[int, ...]:
    parts = [part.strip().removesuffix(b"L") for part in text.strip(b"()").split(b",")]
    if not parts[-1]:
        parts.pop()
    good = all(part.isdigit() and len(part) <= _MOST_DIGITS for part in parts)
    if not good or len(parts) > _MOST_DIMENSIONS:
        raise _damaged(f"its shape must be whole numbers, not {_shown(text)}")
    return tuple(int(part) for part in parts)


def _dtype(text: bytes) -> np.dtype[np.generic]:
    matched = _DTYPE.fullmatch(text)
    if matched is not None:
        kind, size = matched[2], int(matched[3])
        fits = 0 < size <= _LONGEST_WORD if kind == b"U" else size in _BYTES[kind]
        if fits and (matched[1] != b"|" or size == 1):
            return np.dtype(text.strip(b"'").decode("ascii"))
    raise _damaged(f"it must hold numbers or words, not {_shown(text)}")
