# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One foreign input after the other: a valid result or one clear line, soon, and nothing else."""

import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from hoe_addon.core.errors import HoeError
from tests.strangers.watching import watched

SLOWEST_S = 1.0
"""For one input, by both clocks: that on the wall alone would blame a busy machine."""

LONGEST_LINE = 2000
_LOGGED = 12
_SHOWN = 300


@dataclass(frozen=True)
class Case:
    """One input.

    Attributes:
        name: What was done to it.
        read: Reads it, and does with it what a program does first.
        show: The input, for the message of a failed test.
    """

    name: str
    read: Callable[[], Any]
    show: object


@dataclass
class Verdict:
    """What became of many inputs.

    Attributes:
        valid: How many were read.
        refused: How many were refused, by the beginning of the name.
        faults: What must not happen, with the input.
        slowest: Seconds and names of the slowest inputs, the slowest first.
    """

    valid: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)
    slowest: list[tuple[float, str]] = field(default_factory=list)

    @property
    def count(self) -> int:
        """All inputs."""
        return self.valid + self.refused.total() + len(self.faults)


def judge(cases: Iterable[Case]) -> Verdict:
    """Read inputs.

    Args:
        cases: The inputs.

    Returns:
        What became of them.
    """
    verdict = Verdict()
    for case in cases:
        _judge(case, verdict)
    return verdict


def _judge(case: Case, verdict: Verdict) -> None:
    fault = ""
    wall, work = time.perf_counter(), time.thread_time()
    refused = False
    with watched() as seen, warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            case.read()
        except HoeError as error:
            refused = True
            fault = unclear(str(error))
        except Exception:  # noqa: BLE001  (any other is what this looks for)
            fault = traceback.format_exc(limit=-4)
    took = time.perf_counter() - wall
    if took > SLOWEST_S:
        took = min(took, time.thread_time() - work)
    if took > SLOWEST_S:
        fault = fault or f"took {took:.2f} s"
    if seen:
        fault = fault or f"did what reading must not do: {seen[0]}"
    verdict.slowest = sorted([*verdict.slowest, (took, case.name)], reverse=True)[:_LOGGED]
    if fault:
        verdict.faults.append(f"{case.name}: {fault}\n  of {case.show!r:.{_SHOWN}}")
    elif refused:
        verdict.refused[case.name.partition(":")[0]] += 1
    else:
        verdict.valid += 1


def unclear(message: str) -> str:
    """Tell what is wrong with the message of a refusal.

    Args:
        message: The message.

    Returns:
        What is wrong; empty for one printable line ``FIELD: what is wrong``.
    """
    if not message.isprintable():
        return f"message is no printable line: {message!r:.{_SHOWN}}"
    if len(message) > LONGEST_LINE:
        return f"message of {len(message)} letters: {message:.{_SHOWN}}"
    place, colon, rule = message.partition(": ")
    if "Traceback" in message or not (place and colon and rule.strip()):
        return f"message names no place and rule: {message:.{_SHOWN}}"
    return ""


def assert_faultless(verdict: Verdict, count: int, least_valid: float = 0.02) -> None:
    """Check a verdict.

    Args:
        verdict: The verdict.
        count: How many inputs there should be.
        least_valid: Share that has to be valid, so that not all is refused at the door, and share
            that has to be refused.
    """
    report = "\n".join(verdict.faults[:_LOGGED])
    assert not verdict.faults, f"{len(verdict.faults)} of {verdict.count} inputs:\n{report}"
    assert verdict.count == count
    assert verdict.valid >= least_valid * count
    assert verdict.refused.total() >= least_valid * count
