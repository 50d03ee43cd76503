# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A job as the window sees it: what it says, and what came of it."""

import shutil
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...blender.job_files import JobKind, read_result
from ...core.errors import HoeError
from .places import Place
from .worker import WorkerProcess

_KEEPS = frozenset((JobKind.RENDER, JobKind.EYEBOX, JobKind.ACCURACY))
"""Kinds that keep what is done when they are stopped."""


class JobError(HoeError):
    """A job came to nothing; the message says why and what to do."""


class JobStoppedError(HoeError):
    """A job was stopped before there was something to keep."""


@dataclass(eq=False)
class Job:
    """A job that is at work, or has just ended.

    Attributes:
        kind: Kind of work.
        label: Its name for people.
        folder: Folder of the job.
        place: Where the results go, or None.
        scene: Session id of the scene that it is about.
        digest: Hash of the device that it is about.
        process: Its process.
        began: When it began, by ``time.monotonic``.
        asked: Whether it has been asked to end.
        ended: Whether it has been ended at once.
    """

    kind: JobKind
    label: str
    folder: Path
    place: Place | None
    scene: int
    digest: str = ""
    process: WorkerProcess | None = None
    began: float = field(default_factory=time.monotonic)
    asked: bool = False
    ended: bool = False

    @property
    def is_running(self) -> bool:
        """Whether it is at work."""
        return self.process is not None and self.process.is_running

    @property
    def share(self) -> float:
        """Share of the work that is done, 0 to 1."""
        return 0.0 if self.process is None else self.process.share

    @property
    def words(self) -> str:
        """What it is at, and what Esc does, beside its name and its share."""
        if self.ended:
            return "ending"
        if self.asked:
            return "ending with what is done; Esc again ends at once"
        at = self.process.words if self.process is not None else ""
        keeps = "Esc ends and keeps what is done" if self.kind in _KEEPS else "Esc ends it"
        return f"{f'{at}, ' if at else ''}{_spell(time.monotonic() - self.began)}; {keeps}"

    def cancel(self) -> None:
        """End it and keep what is done; the second time, end it at once."""
        if self.process is None:
            return
        if self.asked or self.kind not in _KEEPS:
            self.ended = True
            self.process.let_go()
        else:
            self.process.stop()
        self.asked = True

    def result(self) -> dict[str, Any]:
        """What came of it, once it has ended.

        Returns:
            Plain data; ``words`` is one line, ``stopped`` says whether it ended early.

        Raises:
            JobStoppedError: It was stopped, and nothing is kept.
            JobError: It failed; one line for the user.
        """
        assert self.process is not None, "it has been started"
        found = read_result(self.folder)
        if self.process.error:
            raise JobError(f"{self.label}: {self.process.error}")
        if found is not None:
            return found
        if self.ended or self.process.stopped:
            raise JobStoppedError(f"{self.label}: stopped; there was nothing to keep yet")
        advice = "try a smaller picture, or save the file and start Blender again"
        raise JobError(f"{self.label}: {self.process.unexpected_end()}; {advice}")

    def discard(self) -> None:
        """End it if it is at work, and take away its folder, and those for results left empty."""
        if self.process is not None:
            self.process.end()
        shutil.rmtree(self.folder, ignore_errors=True)
        if self.place is not None:
            for made in self.place.made:
                with suppress(OSError):  # there is something in it
                    made.rmdir()


def _spell(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    return f"{minutes} min {rest:02} s" if minutes else f"{rest} s"
