# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a window does beside operators, where there is none: timers, panels, and what is said.

Blender without a window runs no timers, and the add-on asks for that. So while a test runs, `bpy`
says that there is a window, and its timers are those here.
"""

import re
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import bpy
import pytest

from tests.ui.layouts import Call, Layout, draw, own_panels

type Timer = Callable[[], float | None]

_WITHOUT_OSLQUERY = re.compile(
    r"Traceback \(most recent call last\):\n(?: .*\n)*ModuleNotFoundError: .*'oslquery'\n"
)
"""The Python module of Blender cannot ask a shader for its sockets, and says so at length."""

LONGEST_S = 20.0
"""For all timers together, with threads that they look after."""


@dataclass
class Timers:
    """Timers as Blender has them, run when a test says so.

    Attributes:
        waiting: By identity, as in Blender; with whether they outlive the opening of a file.
    """

    waiting: dict[int, tuple[Timer, bool]] = field(default_factory=dict[int, tuple[Timer, bool]])

    def register(
        self, function: Timer, *, first_interval: float = 0.0, persistent: bool = False
    ) -> None:
        """Call a function soon."""
        assert first_interval >= 0.0
        self.waiting[id(function)] = (function, persistent)

    def unregister(self, function: Timer) -> None:
        """Call it no more."""
        if self.waiting.pop(id(function), None) is None:
            raise ValueError("function is not registered")

    def is_registered(self, function: Timer) -> bool:
        """Whether it is going to be called."""
        return id(function) in self.waiting

    def run(self) -> None:
        """Call all timers, in order, until none is left."""
        end = time.monotonic() + LONGEST_S
        while self.waiting:
            assert time.monotonic() < end, f"timers without end: {list(self.waiting.values())}"
            again = [self._call(key) for key in list(self.waiting)]
            if any(again):
                time.sleep(0.005)

    def _call(self, key: int) -> bool:
        if key not in self.waiting:
            return False
        function, persistent = self.waiting.pop(key)
        if function() is None:
            return False
        self.waiting[key] = (function, persistent)
        return True

    def forget_on_load(self) -> None:
        """Blender forgets them when a file is opened, but for those that are to outlive it."""
        self.waiting = {key: held for key, held in self.waiting.items() if held[1]}


class _App:
    """`bpy.app`, with a window."""

    background = False

    def __init__(self, real: Any, timers: Timers) -> None:
        self._real, self.timers = real, timers

    def __getattr__(self, name: str) -> Any:
        return getattr(self._real, name)


class Window:
    """A window that nobody sees.

    Attributes:
        timers: Its timers.
        calls: What its panels have shown last.
    """

    def __init__(self, patch: pytest.MonkeyPatch, said: Callable[[], str]) -> None:
        """Begin.

        Args:
            patch: What lets `bpy` say that there is a window.
            said: Gives all that Blender has printed since it was asked last.
        """
        self.timers = Timers()
        self.calls: list[Call] = []
        self._said = said
        self._panels = list(own_panels())
        patch.setattr(bpy, "app", _App(bpy.app, self.timers))

    def settle(self) -> None:
        """Do what a window does after each event: timers, then panels, which ask for more.

        Blender prints what goes wrong in handlers and callbacks, and goes on; here it fails.
        """
        self._evaluate()
        self.timers.run()
        self.draw()
        self.timers.run()
        self.draw()
        self.listen()

    def listen(self) -> None:
        """Fail where anything of Python went wrong unseen."""
        said = _WITHOUT_OSLQUERY.sub("", self._said())
        assert "Traceback" not in said, said

    def draw(self) -> None:
        """Draw all panels and menus, and ask for the tooltips of all buttons."""
        self.calls = [call for panel in self._panels for call in _drawn(panel)]
        for call in self.calls:
            if call.kind == "operator":
                _tooltip(call)

    def open(self, path: str) -> None:
        """Open a file."""
        self.timers.forget_on_load()
        bpy.ops.wm.open_mainfile(filepath=path)

    def begin(self, *, empty: bool) -> None:
        """Begin a new file: an empty one, or the one that Blender starts with."""
        self.timers.forget_on_load()
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=empty)

    @staticmethod
    def _evaluate() -> None:
        for window in bpy.context.window_manager.windows:
            window.view_layer.update()


def _drawn(panel: Any) -> Iterator[Call]:
    found = draw(panel)
    if found is not None:
        yield from found.calls


def _tooltip(call: Call) -> None:
    group, _, name = call.name.partition(".")
    kind = getattr(bpy.types, f"{group.upper()}_OT_{name}", None)
    if kind is None or not hasattr(kind, "description"):
        return
    properties = {
        prop.identifier: getattr(prop, "default", None) for prop in kind.bl_rna.properties
    }
    told = kind.description(bpy.context, SimpleNamespace(**(properties | call.assigned)))
    assert isinstance(told, str)


def drawn_menu(menu: Any) -> list[Call]:
    """What a menu shows."""
    layout = Layout()
    menu.draw(SimpleNamespace(layout=layout), bpy.context)
    return layout.calls
