# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A small stroke font, so that a test chart needs no font file.

Each letter is a few open lines on a grid 4 wide and 6 high: two digits are one point (x, y), a
comma lifts the pen.
"""

import itertools
from collections.abc import Iterator

GRID_HEIGHT = 6.0
"""Height of a capital letter in steps of the grid."""

_WIDTH = 4.0
_GAP = 2.0

_GLYPHS = {
    " ": "",
    "%": "00 46, 05 16 25 14 05, 21 32 41 30 21",
    "+": "03 43, 21 25",
    "-": "13 33",
    ".": "20 20",
    "/": "00 46",
    "0": "10 01 05 16 36 45 41 30 10",
    "1": "15 26 20",
    "2": "05 16 36 45 44 00 40",
    "3": "05 16 36 45 44 33 42 41 30 10 01, 33 23",
    "4": "30 36 02 42",
    "5": "46 06 04 34 43 41 30 10 01",
    "6": "45 36 16 05 01 10 30 41 42 33 13 02",
    "7": "06 46 10",
    "8": "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
    "9": "01 10 30 41 45 36 16 05 04 13 33 44",
    "A": "00 26 40, 12 32",
    "B": "00 06 36 45 44 33 03, 33 42 41 30 00",
    "C": "45 36 16 05 01 10 30 41",
    "D": "00 06 26 45 41 20 00",
    "E": "46 06 00 40, 03 33",
    "F": "46 06 00, 03 33",
    "G": "45 36 16 05 01 10 30 41 43 23",
    "H": "00 06, 40 46, 03 43",
    "I": "20 26",
    "J": "46 41 30 10 01",
    "K": "00 06, 46 02, 13 40",
    "L": "06 00 40",
    "M": "00 06 23 46 40",
    "N": "00 06 40 46",
    "O": "10 01 05 16 36 45 41 30 10",
    "P": "00 06 36 45 44 33 03",
    "Q": "10 01 05 16 36 45 41 30 10, 22 40",
    "R": "00 06 36 45 44 33 03, 23 40",
    "S": "45 36 16 05 04 13 33 42 41 30 10 01",
    "T": "06 46, 26 20",
    "U": "06 01 10 30 41 46",
    "V": "06 20 46",
    "W": "06 10 24 30 46",
    "X": "00 46, 06 40",
    "Y": "06 23 46, 23 20",
    "Z": "06 46 00 40",
    "m": "00 04, 03 14 23 20, 23 34 43 40",
    "n": "00 04, 03 14 34 43 40",
    "x": "00 44, 04 40",
    "\N{DEGREE SIGN}": "05 16 25 14 05",
}

type Point = tuple[float, float]


def width(text: str) -> float:
    """Width of a line of text, from the first stroke's place to the last, in steps of the grid."""
    return len(text) * (_WIDTH + _GAP) - _GAP


def printable(text: str) -> str:
    """The capitals of a text, without the letters that the font lacks."""
    return "".join(letter for letter in text.upper() if letter in _GLYPHS)


def strokes(text: str) -> Iterator[tuple[Point, Point]]:
    """Draw a line of text.

    Args:
        text: Letters that the font has; others raise KeyError, which is our own mistake.

    Yields:
        Both ends of each stroke; the text starts at (0, 0) and its capitals are 6 high.
    """
    for number, letter in enumerate(text):
        start = number * (_WIDTH + _GAP)
        for line in filter(None, _GLYPHS[letter].split(",")):
            points = [(start + int(point[0]), float(point[1])) for point in line.split()]
            yield from itertools.pairwise(points)
