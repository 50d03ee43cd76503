# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C that is heard at once, also while Blender's C code runs and Python does not.

Python raises KeyboardInterrupt when it next runs its own code in the main thread. During a render
that is in a callback of Cycles, which swallows it. So the signal wakes a thread instead, which
takes unfinished files away and ends the process.
"""

import os
import signal
import threading

from ..files import discard_unfinished

EXIT_INTERRUPTED = 130


def exit_on_interrupt() -> None:
    """From now on, end the process at Ctrl-C; to be called once, in the main thread."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    # Renders redirect the error stream, so the thread keeps one of its own.
    stderr = os.dup(2)
    signal.signal(signal.SIGINT, lambda *_: None)
    signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    threading.Thread(target=_wait, args=(reader, stderr), daemon=True).start()


def _wait(reader: int, stderr: int) -> None:
    while os.read(reader, 1) != bytes((signal.SIGINT,)):
        pass
    discard_unfinished()
    os.write(stderr, b"hoe: error: stopped by the user; no unfinished file is left\n")
    os._exit(EXIT_INTERRUPTED)
