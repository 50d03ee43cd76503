# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C that is heard at once, also while Blender's C code runs and Python does not.

Python raises KeyboardInterrupt when it next runs its own code in the main thread. During a render
that is in a callback of Cycles, which swallows it. So the signal wakes a thread instead, which
takes unfinished files away and ends the process, or only passes the wish on where a command has
something to keep.
"""

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ..files import discard_unfinished

EXIT_INTERRUPTED = 130

_asked: list[threading.Event] = []
"""What the next Ctrl-C sets instead of ending the process."""


def exit_on_interrupt() -> None:
    """From now on, end the process at Ctrl-C; to be called once, in the main thread."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    # Renders redirect the error stream, so the thread keeps one of its own.
    stderr = os.dup(2)
    signal.signal(signal.SIGINT, lambda *_: None)
    signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    threading.Thread(target=_wait, args=(reader, stderr), daemon=True).start()


@contextmanager
def first_interrupt_asks() -> Iterator[threading.Event]:
    """Let the first Ctrl-C inside only set an event; the second one ends the process as ever.

    Yields:
        The event, to be looked at between parts of the work.
    """
    event = threading.Event()
    _asked.append(event)
    try:
        yield event
    finally:
        _asked.clear()


def _wait(reader: int, stderr: int) -> None:
    while not (os.read(reader, 1) == bytes((signal.SIGINT,)) and not _ask(stderr)):
        pass
    discard_unfinished()
    os.write(stderr, b"hoe: error: stopped by the user; no unfinished file is left\n")
    os._exit(EXIT_INTERRUPTED)


def _ask(stderr: int) -> bool:
    """Ask a command that can finish early to do so, once."""
    if not _asked or _asked[-1].is_set():
        return False
    _asked[-1].set()
    os.write(stderr, b"hoe: finishing with what is done; Ctrl-C again stops at once\n")
    return True
