# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The budget of ``accuracy``: what is not begun because there is no time for it."""

import math
from types import SimpleNamespace
from typing import Any

import pytest

from hoe_addon.blender.accuracy import shots, watch
from hoe_addon.core.errors import CancelledError


def test_setting_without_time_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 20 s the reference takes 5 s and each setting 6 s; 3 s are left for the third."""
    now = [0.0]
    monkeypatch.setattr(watch, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    measured = watch.Watch(20.0, lambda: False, None)
    for seconds in (5.0, 6.0, 5.9):
        now[0] += seconds
        measured.lap()
    assert measured.laps == pytest.approx([5.0, 6.0, 5.9])
    measured.refuse_when_over()
    now[0] += 0.5
    with pytest.raises(CancelledError, match=r"the budget of 20 s was used up"):
        measured.refuse_when_over()


@pytest.mark.parametrize(("seconds", "pilots"), [(1.0, 0), (100.0, 1), (math.inf, 1)])
def test_pilot_that_takes_too_long_is_left_out(
    monkeypatch: pytest.MonkeyPatch, seconds: float, pilots: int
) -> None:
    made: list[Any] = []
    monkeypatch.setattr(shots, "is_divisible", lambda _: True)
    monkeypatch.setattr(shots, "_pilot_seconds", lambda _: 30.0)
    monkeypatch.setattr(shots, "divided", lambda device: made.append(device) or "pilot")
    division = shots.division_of(SimpleNamespace(), seconds=seconds)  # type: ignore[arg-type]
    assert len(made) == pilots
    assert (division == "pilot") == bool(pilots)


def test_one_pass_that_is_known_is_taken_over_without_a_pilot(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(shots, "is_divisible", lambda _: True)
    monkeypatch.setattr(shots, "divided", lambda _: pytest.fail("a pilot was made"))
    first, second = SimpleNamespace(), SimpleNamespace()
    known = shots.Division((shots.whole(first),), (1.0,), 1.0)  # type: ignore[arg-type]
    found = shots.division_of(second, known)  # type: ignore[arg-type]
    assert [each.device for each in found.passes] == [second]
