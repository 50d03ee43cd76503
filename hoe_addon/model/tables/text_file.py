# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as text with keywords, in the manner of the files by which scatter data are exchanged.

Lines that start with # are comments. A list is a keyword with the count of its entries, and the
entries on the next line. The data come in blocks, one for each incidence and wavelength in the
order of the lists::

    DataBegin back 532.0
    <one line a direction and place: a share for each order>
    DataEnd

The lines of a block run over AngleOfIncidence (slowest), AngleAcross, PositionX, PositionY.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ..reading import read_text
from .edges import (
    MOST_BYTES,
    MOST_NUMBERS,
    SCHEMA,
    FileTable,
    check_nodes,
    default_axis,
    from_core,
    to_core,
)

_AXES = ("Wavelength", "AngleOfIncidence", "AngleAcross", "PositionX", "PositionY")
_LISTS = (*_AXES, "Incidence", "Order", "ScatterType", "Frequency")
_WORDS = ("Schema", "Source", "Symmetry", "SpectralContent", "Beyond")
_SCATTER = {"BTDF": "T", "BRDF": "R"}
_HEAD = "# Share of the light in each order; nm, degrees, mm\n"


def text_lines(table: EfficiencyTable) -> Iterator[str]:
    """Write a table.

    Args:
        table: The table.

    Yields:
        The lines.
    """
    given = from_core(table)
    spectral = "Spectral" if len(table.wavelength) > 1 else "Monochrome"
    yield _HEAD + f"Schema  {SCHEMA}\nSource  Generated\nSymmetry  Asymmetrical\n"
    yield f"SpectralContent  {spectral}\nBeyond  {given.beyond}\n"
    types = {side: name for name, side in _SCATTER.items()}
    lists: dict[str, list[str]] = {
        "ScatterType": [types[side] for side in given.side],
        "Order": [str(order) for order in given.order],
        "Frequency": [repr(frequency) for frequency in given.frequency],
        "Incidence": list(given.incidence),
    }
    for name, nodes in zip(_AXES, given.axes, strict=True):
        lists[name] = [repr(node) for node in nodes.tolist()]
    for name, entries in lists.items():
        yield f"{name}  {len(entries)}\n{' '.join(entries)}\n"
    for side, incidence in enumerate(given.incidence):
        for colour, wavelength in enumerate(lists["Wavelength"]):
            block = given.efficiency[side, colour].reshape(-1, len(given.order))
            yield f"DataBegin {incidence} {wavelength}\n"
            yield "".join(" ".join(map(repr, row)) + "\n" for row in block.tolist())
            yield "DataEnd\n"


def read_text_table(path: Path) -> EfficiencyTable:
    """Read a table.

    Args:
        path: The file.

    Returns:
        The table.

    Raises:
        SpecError: It is damaged, too large, or breaks a rule; the message names the line.
    """
    lines = _Lines(read_text(path, MOST_BYTES).splitlines())
    words, lists = _header(lines)
    orders = [_whole(entry) for entry in _needed(lists, "Order")]
    types = _needed(lists, "ScatterType")
    for entry in types:
        if entry not in _SCATTER:
            raise SpecError(f"ScatterType: must be BTDF or BRDF, got {entry[:20]!a}")
    frequency = [_number("Frequency", entry) for entry in lists.get("Frequency", [])]
    frequency = frequency or [1.0] * len(orders)
    if not len(orders) == len(types) == len(frequency):
        raise SpecError(f"ScatterType, Frequency: must have {len(orders)} entries, like Order")
    wavelength, along, across, x, y = (
        np.asarray([_number(name, entry) for entry in lists[name]])
        if name in lists
        else default_axis(axis)
        for axis, name in enumerate(_AXES)
    )
    for axis, nodes in enumerate((wavelength, along, across, x, y)):
        check_nodes(axis, nodes, _AXES[axis])
    incidence = lists.get("Incidence", ["back"])
    rows = len(along) * len(across) * len(x) * len(y)
    size = len(incidence) * len(wavelength) * rows * len(orders)
    if size > MOST_NUMBERS:
        raise SpecError(f"Data: must be at most {MOST_NUMBERS} numbers, got lists for {size}")
    blocks = [
        _block(lines, side, colour, rows, len(orders))
        for side in incidence
        for colour in wavelength
    ]
    if lines.left():
        raise SpecError(f"Data: must end after {len(blocks)} blocks, got more in {lines.place}")
    shape = (len(incidence), len(wavelength), len(along), len(across), len(x), len(y), len(orders))
    return to_core(
        FileTable(
            (wavelength, along, across, x, y),
            incidence,
            orders,
            [_SCATTER[entry] for entry in types],
            frequency,
            np.asarray(blocks).reshape(shape),
            words.get("Beyond", "clamp"),
            _AXES,
        )
    )


@dataclass
class _Lines:
    """The lines of a file that hold something, one after the other."""

    lines: list[str]
    number: int = 0
    place: str = field(default="line 0")

    def left(self) -> bool:
        """Go to the next line that holds something; return whether there is one."""
        while self.number < len(self.lines):
            text = self.lines[self.number].strip()
            if text and not text.startswith("#"):
                self.place = f"line {self.number + 1}"
                return True
            self.number += 1
        return False

    def next(self, what: str) -> list[str]:
        """Take the words of the next line; `what` is missing if there is none."""
        if not self.left():
            raise SpecError(f"{what}: is missing at the end of the file")
        words = self.lines[self.number].split()
        self.number += 1
        return words


def _header(lines: _Lines) -> tuple[dict[str, str], dict[str, list[str]]]:
    words: dict[str, str] = {}
    lists: dict[str, list[str]] = {}
    while lines.left() and lines.lines[lines.number].split()[0] != "DataBegin":
        line = lines.next("DataBegin")
        name = line[0]
        if name in words or name in lists:
            raise SpecError(f"{name[:20]}: stands twice, in {lines.place}")
        if len(line) != 2 or name not in (*_WORDS, *_LISTS):
            rule = "must be a keyword and one value"
            raise SpecError(f"{lines.place}: {rule}, got {ascii(' '.join(line))[:60]}")
        if name in _WORDS:
            words[name] = line[1]
            continue
        entries = lines.next(name)
        if str(len(entries)) != line[1]:
            rule = f"must have {line[1][:20]} entries"
            raise SpecError(f"{name}: {rule}, got {len(entries)} in {lines.place}")
        lists[name] = entries
    _check_words(words)
    return words, lists


def _check_words(words: dict[str, str]) -> None:
    allowed: dict[str, tuple[str, ...]] = {
        "Schema": (str(SCHEMA),),
        "Symmetry": ("Asymmetrical",),
        "SpectralContent": ("Monochrome", "Spectral"),
        "Beyond": ("clamp", "zero"),
    }
    for name, choices in allowed.items():
        if name in words and words[name] not in choices:
            got = ascii(words[name][:20])
            raise SpecError(f"{name}: must be one of {', '.join(choices)}, got {got}")


def _block(lines: _Lines, side: str, colour: float, rows: int, orders: int) -> FloatArray:
    """Read the shares of one incidence and wavelength, shape ``(rows, orders)``."""
    head = lines.next("DataBegin")
    expected = f"DataBegin {side[:20]} {float(colour)!r}"
    if len(head) != 3 or head[:2] != ["DataBegin", side] or _number(lines.place, head[2]) != colour:
        got = ascii(" ".join(head))[:60]
        raise SpecError(f"{lines.place}: must be {expected}, got {got}")
    found: list[list[float]] = []
    for _ in range(rows):
        words = lines.next("DataEnd")
        if len(words) != orders:
            rule = f"must hold {orders} numbers, one an order, in each of {rows} lines"
            raise SpecError(f"{lines.place}: {rule}, got {ascii(' '.join(words))[:60]}")
        found.append([_number(lines.place, word) for word in words])
    if lines.next("DataEnd") != ["DataEnd"]:
        raise SpecError(f"{lines.place}: must be DataEnd after {rows} lines")
    return np.asarray(found)


def _needed(lists: dict[str, list[str]], name: str) -> list[str]:
    if name not in lists:
        raise SpecError(f"{name}: is missing")
    return lists[name]


def _number(name: str, word: str) -> float:
    return _parsed(float, name, "a number", word)


def _whole(word: str) -> int:
    return _parsed(int, "Order", "a whole number", word[:12])


def _parsed[T](kind: Callable[[str], T], name: str, what: str, word: str) -> T:
    try:
        return kind(word)
    except ValueError as error:
        raise SpecError(f"{name}: must be {what}, got {word[:20]!a}") from error
