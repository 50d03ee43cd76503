# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the text of a formula to words: numbers, names and signs."""

import re
from dataclasses import dataclass
from enum import Enum, auto

from .error import FormulaError

MAX_CHARACTERS = 2000

_NUMBER = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_WORD = re.compile(
    rf"(?P<space>[ \t\r\n]+)|(?P<number>{_NUMBER})|(?P<name>[A-Za-z_][A-Za-z_0-9]*)"
    r"|(?P<sign>\*\*|[-+*/^(),])"
)


class Kind(Enum):
    """What a word is."""

    NUMBER = auto()
    NAME = auto()
    SIGN = auto()
    END = auto()


@dataclass(frozen=True)
class Token:
    """One word of a formula.

    Attributes:
        kind: What it is.
        text: As written; ``**`` is given as ``^``.
        column: Its first character, counted from 1.
    """

    kind: Kind
    text: str
    column: int


def tokens(text: str) -> list[Token]:
    """Split a formula into words.

    Args:
        text: The formula.

    Returns:
        The words, and one more that stands for the end.

    Raises:
        FormulaError: It is too long or holds a sign that has no meaning here.
    """
    if len(text) > MAX_CHARACTERS:
        raise FormulaError(MAX_CHARACTERS + 1, f"must have at most {MAX_CHARACTERS} characters")
    found: list[Token] = []
    place = 0
    while place < len(text):
        match = _WORD.match(text, place)
        if match is None:
            shown = ascii(text[place])
            raise FormulaError(place + 1, f"{shown} has no meaning in a formula")
        place = match.end()
        if match.lastgroup != "space":
            found.append(_token(match))
    return [*found, Token(Kind.END, "the end", len(text) + 1)]


def _token(match: re.Match[str]) -> Token:
    text, column = match.group(), match.start() + 1
    if match.lastgroup == "number":
        return Token(Kind.NUMBER, text, column)
    if match.lastgroup == "name":
        return Token(Kind.NAME, text, column)
    return Token(Kind.SIGN, "^" if text == "**" else text, column)
