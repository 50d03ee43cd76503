# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep what Blender's C code prints away from the user, or catch it to find the error in it."""

import contextlib
import os
import sys
import tempfile
from collections.abc import Iterator

_STREAMS = (1, 2)


@contextlib.contextmanager
def captured_output() -> Iterator[list[str]]:
    """Collect all that the process writes to stdout and stderr; the list is filled at the end."""
    lines: list[str] = []
    with (
        tempfile.TemporaryFile(mode="w+", errors="replace") as catcher,
        contextlib.ExitStack() as s,
    ):
        for stream in _STREAMS:
            s.enter_context(_redirected(stream, catcher.fileno()))
        try:
            yield lines
        finally:
            s.close()
            catcher.seek(0)
            lines.extend(catcher.read().splitlines())


def forget_removed_engines() -> None:
    """Say nothing when Python clears away a render engine that Blender has removed already.

    Cycles' own ``__del__`` then raises a ReferenceError, which Python would print after the
    results of a command. All other such errors are still shown.
    """
    shown = sys.unraisablehook

    def hook(unraisable: "sys.UnraisableHookArgs") -> None:
        if not (isinstance(unraisable.exc_value, ReferenceError) and _is_engine(unraisable)):
            shown(unraisable)

    sys.unraisablehook = hook


def _is_engine(unraisable: "sys.UnraisableHookArgs") -> bool:
    return "CyclesRender" in str(unraisable.exc_value)


@contextlib.contextmanager
def _redirected(stream: int, target: int) -> Iterator[None]:
    sys.stdout.flush()
    sys.stderr.flush()
    kept = os.dup(stream)
    os.dup2(target, stream)
    try:
        yield
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os.dup2(kept, stream)
        os.close(kept)
