# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files damaged by accident or on purpose."""

import random
import re
from collections.abc import Sequence

from tests.strangers.texts import some_number, some_text

_NUMBER = re.compile(rb"-?\d+(\.\d+)?")
_LIES = tuple(
    value.to_bytes(size, order)  # type: ignore[arg-type]
    for size in (2, 4, 8)
    for value in (0, 1, 255, 2 ** (8 * size) - 1, 2 ** (8 * size - 1), 2 ** (8 * size - 1) - 1)
    for order in ("little", "big")
)
_HEADER = 240


def damaged(rng: random.Random, good: bytes, others: Sequence[bytes], *, is_text: bool) -> bytes:
    """Damage a file in one to three ways.

    Args:
        rng: Random numbers.
        good: What is in a good file.
        others: What is in good files of other kinds.
        is_text: Whether people may write such a file by hand.

    Returns:
        What is in the damaged one.
    """
    ways = _OF_TEXT if is_text and rng.random() < 0.75 else _OF_BYTES
    data = rng.choice(others) if rng.random() < 0.03 else good
    for _ in range(rng.choice((1, 1, 2, 3))):
        data = rng.choice(ways)(rng, data)
    return data


def _flip(rng: random.Random, data: bytes) -> bytes:
    made = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8)) if made else 0):
        made[rng.randrange(len(made))] ^= 1 << rng.randrange(8)
    return bytes(made)


def _flip_header(rng: random.Random, data: bytes) -> bytes:
    return _flip(rng, data[:_HEADER]) + data[_HEADER:]


def _lie(rng: random.Random, data: bytes) -> bytes:
    """Write another number into the header, such as a size."""
    lie, place = rng.choice(_LIES), rng.randrange(min(_HEADER, len(data)) + 1)
    return data[:place] + lie + data[place + len(lie) :]


def _lie_at_end(rng: random.Random, data: bytes) -> bytes:
    """The directory of an archive stands at its end."""
    lie, place = rng.choice(_LIES), max(0, len(data) - rng.randrange(_HEADER))
    return data[:place] + lie + data[place + len(lie) :]


def _cut(rng: random.Random, data: bytes) -> bytes:
    return data[: rng.randrange(len(data) + 1)]


def _leave_out(rng: random.Random, data: bytes) -> bytes:
    place = rng.randrange(len(data) + 1)
    return data[:place] + data[place + rng.choice((1, 2, 4, 30)) :]


def _insert(rng: random.Random, data: bytes) -> bytes:
    place = rng.randrange(len(data) + 1)
    return data[:place] + rng.randbytes(rng.choice((1, 2, 4, 40))) + data[place:]


def _repeat(rng: random.Random, data: bytes) -> bytes:
    first, last = sorted(rng.randrange(len(data) + 1) for _ in range(2))
    return data[:last] + data[first:last] * rng.choice((1, 3)) + data[last:]


def _noise(rng: random.Random, data: bytes) -> bytes:
    return data[: rng.choice((0, 4, 16))] + rng.randbytes(rng.randrange(200))


def _other_number(rng: random.Random, data: bytes) -> bytes:
    found = list(_NUMBER.finditer(data))
    if not found:
        return data
    match = rng.choice(found)
    number = some_number(rng)
    text = repr(number) if abs(number) < 1e300 else "1e999"
    text = rng.choice((text, text, "nan", "-inf", "1_0", "0x1", "9" * 30, "9" * 5000, "--1", "+1"))
    return data[: match.start()] + text.encode() + data[match.end() :]


def _other_word(rng: random.Random, data: bytes) -> bytes:
    words = list(re.finditer(rb"[^\s,]+", data))
    if not words:
        return data
    match = rng.choice(words)
    word = some_text(rng).encode("utf-8", "replace")
    return data[: match.start()] + word + data[match.end() :]


def _separators(rng: random.Random, data: bytes) -> bytes:
    old, new = rng.sample(
        (b",", b"\n", b" ", b";", b"\t", b"\r\n", b"\x00", b'"', b"\xe2\x80\xa8"), 2
    )
    return data.replace(old, new, rng.choice((1, 2, -1)))


def _lines(rng: random.Random, data: bytes) -> bytes:
    lines = data.split(b"\n")
    for _ in range(rng.choice((1, 1, 3))):
        place = rng.randrange(len(lines))
        line = lines.pop(place) if rng.random() < 0.5 and len(lines) > 1 else lines[place]
        lines.insert(
            rng.randrange(len(lines) + 1), line if rng.random() < 0.7 else line + b"," + line
        )
    return b"\n".join(lines)


_OF_BYTES = (
    *(_flip, _flip, _flip_header, _flip_header, _lie, _lie, _lie_at_end, _cut, _leave_out),
    *(_insert, _repeat, _noise),
)
_OF_TEXT = (_other_number, _other_number, _other_word, _separators, _lines, _cut, _flip)
