# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of an example: measure and compare, or write expected.json anew."""

import argparse
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..files import writable_folder, write_text
from .claims import Row, compare, report


@dataclass(frozen=True)
class Example:
    """An example whose claim is a list of numbers.

    Attributes:
        folder: Its folder, with expected.json in it.
        preset: The device that it is about.
        source: Where the expected numbers come from.
        reason: Why the numbers found may be that far from them.
        measure: What finds the numbers, by name.
        expected: What makes the expected ones, without the code that ``measure`` tries.
    """

    folder: Path
    preset: str
    source: str
    reason: str
    measure: Callable[[], Mapping[str, float]]
    expected: Callable[[], list[Row]]

    def run(self, description: str | None) -> int:
        """Do what the arguments of the process ask for.

        Args:
            description: Text of ``--help``.

        Returns:
            Exit code: 0 if every number is as expected, else 1.
        """
        arguments = read_arguments(self.folder, description)
        if arguments.renew:
            return write_expected(self.folder, self.document())
        return self.check(arguments.out)

    def check(self, output: Path) -> int:
        """Measure and compare.

        Args:
            output: Folder for numbers.json.

        Returns:
            Exit code: 0 if every number is as expected, else 1.
        """
        from ..blender.quiet import forget_removed_engines

        forget_removed_engines()
        folder = writable_folder(output)
        return report(compare(read_expected(self.folder), self.measure()), folder / "numbers.json")

    def document(self) -> dict[str, Any]:
        """What expected.json holds."""
        return {
            "provenance": provenance(self.folder, self.source, self.preset),
            "tolerance": {"reason": self.reason},
            "numbers": self.expected(),
        }


def read_arguments(
    folder: Path, description: str | None, samples: int | None = None
) -> argparse.Namespace:
    """Read the arguments of the process.

    Args:
        folder: Folder of the example; the results go to a folder of its name.
        description: Text of ``--help``.
        samples: Default of ``--samples``, an option of examples that can be quick or exact.

    Returns:
        ``out``, ``renew`` and, where it is an option, ``samples``.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, default=Path("out") / folder.name)
    if samples is not None:
        parser.add_argument("--samples", type=int, default=samples)
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    return parser.parse_args()


def provenance(folder: Path, source: str, preset: str) -> dict[str, Any]:
    """Say in expected.json where its numbers come from.

    Args:
        folder: Folder of the example.
        source: What the numbers are made from.
        preset: The device.

    Returns:
        The block for the document.
    """
    return {
        "source": source,
        "generated_by": f"python examples/{folder.name}/run.py --renew",
        "device": preset,
    }


def read_expected(folder: Path) -> dict[str, Any]:
    """Read the expected numbers of an example.

    Args:
        folder: Folder of the example.

    Returns:
        What its expected.json holds.
    """
    return json.loads((folder / "expected.json").read_text(encoding="utf-8"))


def write_expected(folder: Path, document: Mapping[str, Any]) -> int:
    """Write the expected numbers of an example, and say so.

    Args:
        folder: Folder of the example.
        document: What its expected.json is to hold.

    Returns:
        Exit code: 0.
    """
    path = folder / "expected.json"
    write_text(path, (json.dumps(document, indent=2), "\n"))
    print(f"{path}: written")
    return 0
