# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments: a parser that complains like the rest of the program, and lists of numbers."""

import argparse
import math
import re
from fractions import Fraction
from typing import NoReturn

from ..core.errors import HoeError
from ..core.limits import MAX_ORDER

LIST_HELP = "A:B:STEP (B included) or a,b,c"

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_WHOLE = re.compile(r"[+-]?\d{1,6}", re.ASCII)
_LONGEST = 64
_MAX_VALUES = 1_000_000
_LARGEST = 1e30
_SMALLEST = 1e-30
_STEP_SLACK = Fraction(1, 10**9)
"""Share of a step by which the last value may miss the end; larger than any rounding of STEP."""


class Parser(argparse.ArgumentParser):
    """An ArgumentParser whose errors are HoeError, for one line and exit code 2 like any other."""

    def error(self, message: str) -> NoReturn:
        """Raise the parser's complaint.

        Args:
            message: What argparse found wrong.

        Raises:
            HoeError: Always.
        """
        option, colon, what = message.removeprefix("argument ").partition(": ")
        where = f"{option}: {what}" if colon and message.startswith("argument ") else message
        raise HoeError(f"{where} (see {self.prog} --help)")


def parse_number(text: str) -> float:
    """Read a finite number as files and options write it: digits, point, exponent, ASCII only.

    Args:
        text: The text.

    Returns:
        The nearest float.

    Raises:
        ValueError: If it is no such number.
    """
    stripped = text.strip()
    if not _NUMBER.fullmatch(stripped) or not math.isfinite(value := float(stripped)):
        raise ValueError(text)
    return value


def parse_whole(text: str) -> int:
    """Read a whole number of up to six digits.

    Args:
        text: The text.

    Returns:
        The number.

    Raises:
        ValueError: If it is no such number.
    """
    stripped = text.strip()
    if not _WHOLE.fullmatch(stripped):
        raise ValueError(text)
    return int(stripped)


def numbers(text: str) -> list[float]:
    """Read a LIST: ``A:B:STEP`` with B included, or ``a,b,c``.

    The steps are counted in exact arithmetic, so that ``400:401:0.1`` gives the float nearest to
    400.3 and not that of three additions.

    Args:
        text: The text of an option.

    Returns:
        The numbers, at least one.

    Raises:
        argparse.ArgumentTypeError: If it is no such list.
    """
    if ":" not in text:
        return [float(_exact(part, text)) for part in text.split(",")]
    parts = text.split(":")
    if len(parts) != len(("A", "B", "STEP")):
        raise argparse.ArgumentTypeError(f"must be {LIST_HELP}, got {text!r}")
    start, end, step = (_exact(part, text) for part in parts)
    if step == 0 or (end - start) / step < 0:
        raise argparse.ArgumentTypeError(f"STEP must lead from A to B, got {text!r}")
    steps = (end - start) / step + _STEP_SLACK
    if steps >= _MAX_VALUES:
        raise argparse.ArgumentTypeError(f"must be at most {_MAX_VALUES} values, got {text!r}")
    clip = min if step > 0 else max
    return [float(clip(start + place * step, end)) for place in range(int(steps) + 1)]


def _exact(part: str, text: str) -> Fraction:
    try:
        value = parse_number(part) if len(part) <= _LONGEST else math.nan
    except ValueError:
        value = math.nan
    if value == 0.0:
        return Fraction(0)
    if not _SMALLEST <= abs(value) <= _LARGEST:
        raise argparse.ArgumentTypeError(f"must be {LIST_HELP}, finite numbers, got {text!r}")
    return Fraction(part.strip())


def orders(text: str) -> list[int]:
    """Read orders: ``A:B`` with both included, or ``a,b,c``.

    Args:
        text: The text of an option.

    Returns:
        The orders, each once.

    Raises:
        argparse.ArgumentTypeError: If it is no such list.
    """
    try:
        found = [parse_whole(part) for part in text.split(":" if ":" in text else ",")]
    except ValueError:
        found = []
    if ":" in text:
        is_range = len(found) == len(("A", "B")) and found[0] <= found[1]
        found = list(range(found[0], found[1] + 1)) if is_range else []
    if not found or len(set(found)) < len(found):
        rule = "must be A:B with A not above B, or different whole numbers a,b,c"
        raise argparse.ArgumentTypeError(f"{rule}, got {text!r}")
    if max(map(abs, found)) > MAX_ORDER:
        raise argparse.ArgumentTypeError(f"must be from -{MAX_ORDER} to {MAX_ORDER}, got {text!r}")
    return found
