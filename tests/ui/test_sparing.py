# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that follows the scene rests ten times as long as it took."""

from types import SimpleNamespace

import pytest

from hoe_addon.ui import sparing


class Timers:
    """Timers that only note when they are asked for."""

    def __init__(self) -> None:
        self.waiting: dict[object, float] = {}

    def register(self, function: object, *, first_interval: float) -> None:
        """Note a timer."""
        self.waiting[function] = first_interval

    def unregister(self, function: object) -> None:
        """Forget it."""
        del self.waiting[function]

    def is_registered(self, function: object) -> bool:
        """Whether it is noted."""
        return function in self.waiting


@pytest.fixture
def timers(monkeypatch: pytest.MonkeyPatch) -> Timers:
    """A window's timers, and a clock on which each look takes two seconds."""
    made, clock = Timers(), iter(range(0, 1000, 2))
    app = SimpleNamespace(background=False, timers=made)
    monkeypatch.setattr(sparing, "bpy", SimpleNamespace(app=app))
    monkeypatch.setattr(sparing, "time", SimpleNamespace(perf_counter=lambda: float(next(clock))))
    return made


def test_it_rests_after_work(timers: Timers) -> None:
    done: list[int] = []
    soon = sparing.Sparing(lambda: done.append(1))
    soon.ask()
    soon.ask()
    assert list(timers.waiting.values()) == [0.0]
    (timer,) = timers.waiting
    timers.waiting.clear()
    timer()
    assert done == [1]
    soon.ask()
    assert list(timers.waiting.values()) == [20.0]
    soon.stop()
    assert not soon.is_waiting()


def test_it_rests_after_a_fault_too(timers: Timers) -> None:
    def fail() -> None:
        raise ValueError

    soon = sparing.Sparing(fail)
    with pytest.raises(ValueError):
        soon._run()
    soon.ask()
    assert list(timers.waiting.values()) == [20.0]


def test_nothing_runs_without_a_window(timers: Timers) -> None:
    sparing.bpy.app.background = True
    sparing.Sparing(list).ask()
    assert not timers.waiting
