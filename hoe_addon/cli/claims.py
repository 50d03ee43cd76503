# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of an example beside the ones that are expected."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ..files import write_text

type Row = dict[str, Any]
"""One number of expected.json: name, unit, value, allowed."""


@dataclass(frozen=True)
class Claim:
    """One number.

    Attributes:
        name: What it is.
        unit: Its unit.
        expected: What it should be.
        found: What it is.
        allowed: How far they may be apart.
    """

    name: str
    unit: str
    expected: float
    found: float
    allowed: float

    @property
    def holds(self) -> bool:
        """Whether the number is as expected; NaN never is."""
        return abs(self.found - self.expected) <= self.allowed


def row(name: str, unit: str, value: float, allowed: float) -> Row:
    """Write down one number for expected.json.

    Args:
        name: What it is.
        unit: Its unit.
        value: What it should be.
        allowed: How far the number found may be from it.

    Returns:
        The number as `compare` takes it.
    """
    return {"name": name, "unit": unit, "value": value, "allowed": allowed}


def compare(expected: Mapping[str, Any], found: Mapping[str, float]) -> list[Claim]:
    """Set the numbers found beside the expected ones.

    Args:
        expected: What expected.json holds: ``numbers``, each with name, unit, value, allowed.
        found: Number by name; every expected one must be there.

    Returns:
        The claims, in the order of expected.json.
    """
    return [
        Claim(row["name"], row["unit"], row["value"], found[row["name"]], row["allowed"])
        for row in expected["numbers"]
    ]


def report(claims: list[Claim], path: Path) -> int:
    """Print the claims as a table and write them to a file.

    Args:
        claims: The numbers.
        path: JSON file for them.

    Returns:
        Exit code: 0 if all hold, else 1.
    """
    widest = max(len(claim.name) for claim in claims)
    print(f"{'':{widest}}      expected         found    difference    allowed")
    for claim in claims:
        verdict = "" if claim.holds else "  NOT AS EXPECTED"
        print(
            f"{claim.name:{widest}} {claim.expected:13.6g} {claim.found:13.6g} "
            f"{claim.found - claim.expected:13.2e} {claim.allowed:10.2e} {claim.unit}{verdict}"
        )
    rows = [{**asdict(claim), "as_expected": claim.holds} for claim in claims]
    write_text(path, (json.dumps(rows, indent=2), "\n"))
    return 0 if all(claim.holds for claim in claims) else 1
