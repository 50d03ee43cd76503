# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A process beside the window: a thread hears what it says, and it never outlives its pipe."""

import os
import signal
import subprocess
import threading
import time
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...blender.job_files import STOP, Message

_LAST_WORDS = 30
"""Lines that are kept of what Blender prints."""

_SHOWN_LETTERS = 300
_PATIENCE_S = 2.0
"""How long a process may take to leave by itself."""


class WorkerProcess:
    """A process that does one job.

    Attributes:
        share: Share of the work that is done.
        words: What it is at.
        error: Why it cannot go on; empty while it can.
        stopped: Whether it ended early with nothing to keep.
        heard: Whether it has said anything yet.
    """

    def __init__(
        self, command: Sequence[str], folder: Path, mark: str, more: Mapping[str, str] | None = None
    ) -> None:
        """Start it.

        Args:
            command: Program and arguments.
            folder: Folder of the job, where its temporary files go too.
            mark: Begins each line that is meant for the window.
            more: Further variables of its environment.

        Raises:
            OSError: It cannot be started.
        """
        self.share, self.words, self.error = 0.0, "", ""
        self.stopped = self.heard = False
        self._folder, self._mark = folder, mark
        self._said: deque[str] = deque(maxlen=_LAST_WORDS)
        self._killing: float | None = None
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder))
        self._process = subprocess.Popen(
            list(command),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, **temporary, **(more or {})},
            # Ctrl-C in the terminal is for the window alone.
            start_new_session=os.name == "posix",
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0)
            | getattr(subprocess, "BELOW_NORMAL_PRIORITY_CLASS", 0),
        )
        self._ear = threading.Thread(target=self._hear, daemon=True)
        self._ear.start()

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether it is at work; where it has been let go, it is killed when its time is over."""
        if self._process.poll() is None:
            if self._killing is not None and time.monotonic() > self._killing:
                self._process.kill()
            return True
        # All that it has said counts, however late the thread is.
        self._ear.join(_PATIENCE_S)
        return False

    def stop(self) -> None:
        """Ask it to end now and keep what is done."""
        (self._folder / STOP).touch()

    def let_go(self) -> None:
        """End it at once: it takes unfinished files away, and is killed if it does not listen."""
        if self._killing is None:
            self._killing = time.monotonic() + _PATIENCE_S
            self._close()

    def end(self) -> None:
        """End it at once, and wait until it is gone."""
        self.let_go()
        try:
            self._process.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def unexpected_end(self) -> str:
        """Say how it ended, if it said nothing itself."""
        last = "; ".join(self._said)[-_SHOWN_LETTERS:]
        said = f"; its last words: {last}" if last else ""
        return f"the process ended unexpectedly ({self._how()}){said}"

    def log(self) -> str:
        """The last that Blender printed in it."""
        return "\n".join(self._said)

    def _how(self) -> str:
        code = self._process.returncode
        if code is None or code >= 0:
            return f"exit code {code}"
        try:
            return f"signal {-code}, {signal.strsignal(-code) or 'unknown'}"
        except ValueError:
            return f"signal {-code}"

    def _close(self) -> None:
        try:
            assert self._process.stdin is not None
            self._process.stdin.close()
        except OSError:
            pass  # it has gone already

    def _hear(self) -> None:
        """Take what it says; Blender's own lines are kept for the case of a crash."""
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            for raw in stream:
                line = raw.decode("utf-8", "replace").strip()
                message = Message.found_in(line, self._mark)
                if message is not None:
                    self._take(message)
                elif line:
                    self._said.append(line)

    def _take(self, message: Message) -> None:
        self.heard = True
        if message.share is not None:
            self.share = min(max(message.share, 0.0), 1.0)
        self.words = message.words or self.words
        self.error = message.error or self.error
        self.stopped = self.stopped or message.stopped
