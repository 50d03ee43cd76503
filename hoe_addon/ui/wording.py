# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems as panels tell them: with the labels of the window where messages have field paths.

The command line, whose users write documents, keeps the paths.
"""

import re

PARTS = {
    "surface": "Element",
    "media": "Element",
    "frame": "Element",
    "recording": "Recording",
    "characteristic": "Recording",
    "efficiency": "Efficiency",
    "orders": "Orders",
}
"""Panel of a hologram that a field of its document is in."""

_LABELS = {
    **PARTS,
    "recording.object": "Object Wave",
    "recording.reference": "Reference Wave",
    "media.front": "In Front",
    "media.back": "Behind",
    "guide": "Plate",
    "eyebox": "Eyebox Grid",
}
_NO_FILE = re.compile(r"(.*\.)?file: (must not be empty|is missing)")
_NO_SOURCE = re.compile(r"recording\.(\w+)\.target: must be an object")
_GONE_SOURCE = re.compile(r"recording\.(\w+)\.target: (.+) is in no scene")
_STEP = r"(\w+)(?:\[(\d+)\])?(?: \(([^)]*)\))?"
_PATH = re.compile(rf"((?=[a-z]){_STEP}(?:\.{_STEP})*): (?P<told>.+)")
_UNIT = re.compile(r"_(mm|nm|um|um2|deg|cd_m2)$")
_NOTHING = re.compile(r', got (null|"")$')


def part_of(words: str) -> str:
    """Find the panel of a hologram that a problem belongs to.

    Args:
        words: The problem.

    Returns:
        Its title, or nothing.
    """
    return PARTS.get(words.split(":")[0].split(".")[0].split("[")[0], "")


def is_question(words: str) -> bool:
    """Tell whether a problem is only that something was not chosen yet, which is no fault.

    Args:
        words: The problem.
    """
    return bool(_NO_FILE.match(words))


def in_plain_words(words: str) -> str:
    """Write a problem with the labels of the panels.

    Args:
        words: The problem, as messages have it.

    Returns:
        One sentence.
    """
    if _NO_FILE.match(words):
        return "Choose a table file." if words.startswith("efficiency") else "Choose a file."
    unset, gone = _NO_SOURCE.match(words), _GONE_SOURCE.match(words)
    if unset is not None:
        return f"The {unset[1]} wave follows no object: choose its source, or untick Follow."
    if gone is not None:
        return (
            f"{gone[2]}, the source of the {gone[1]} wave, was deleted; its last place counts. "
            "Choose another, or untick Follow."
        )
    told = _PATH.fullmatch(words)
    if told is None:
        return words
    return f"{_label(told[1])}: {_NOTHING.sub('', told['told'])}"


def _label(path: str) -> str:
    """Name a field as the panels do, from the outermost to its own."""
    known = [name for name in _LABELS if path == name or path.startswith((f"{name}.", f"{name}["))]
    start = max(known, key=len, default="")
    names = [_LABELS[start]] if start else []
    for name, place, title in re.findall(_STEP, path[len(start) :]):
        which = title or (str(int(place) + 1) if place else "")
        names.append(f"{_UNIT.sub('', name).replace('_', ' ').title()} {which}".strip())
    return " > ".join(names)
