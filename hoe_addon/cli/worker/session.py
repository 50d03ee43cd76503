# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of a job: open the copy of the file, do the work, tell the window."""

import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...blender.job_files import COPY, Description, JobKind, Message, write_result
from ...core.errors import CancelledError, HoeError
from .leash import Leash

if TYPE_CHECKING:
    import bpy

_OFTEN_S = 0.2
"""Progress is not told more often."""

_NICENESS = 5
"""The window comes first."""


class Teller:
    """Tells the window, on a stream that renders do not redirect."""

    def __init__(self, mark: str) -> None:
        """Keep the stream as it is now.

        Args:
            mark: Mark of the job.
        """
        self._mark = mark
        self._stream = os.dup(1)
        self._told = 0.0

    def say(self, message: Message) -> None:
        """Tell at once."""
        # Where the window has gone nobody listens, and the leash ends the process.
        with suppress(OSError):
            os.write(self._stream, message.line(self._mark))

    def progress(self, share: float, words: str = "") -> None:
        """Tell how far it is, but not too often.

        Args:
            share: Share that is done, 0 to 1.
            words: More about it.
        """
        now = time.monotonic()
        if now - self._told > _OFTEN_S:
            self._told = now
            self.say(Message(share, words))


@dataclass(frozen=True)
class Work:
    """What a kind of work gets.

    Attributes:
        started: When the process began, by ``time.perf_counter``.
        description: What is to be done.
        leash: Asked whether to end.
        teller: Told how it goes.
        noted: Words that go with the next news of progress.
    """

    started: float
    description: Description
    leash: Leash
    teller: Teller
    noted: list[str] = field(default_factory=list[str])

    @property
    def out(self) -> Path:
        """Folder for the results."""
        return Path(self.description.out)

    @property
    def settings(self) -> dict[str, Any]:
        """What the kind of work needs besides."""
        return self.description.settings

    @property
    def scene(self) -> "bpy.types.Scene":
        """The scene of the job in the open file."""
        import bpy

        return bpy.data.scenes[self.description.scene]

    def note(self, words: str) -> None:
        """Keep words for the next news of progress."""
        self.noted[:] = [words]

    def told(self, share: float) -> None:
        """Tell how far it is.

        Args:
            share: Share that is done, 0 to 1.
        """
        self.teller.progress(share, *self.noted)

    def progress(self, share: float) -> None:
        """Tell how far it is, and leave the work if it is to end now.

        Args:
            share: Share that is done, 0 to 1.

        Raises:
            CancelledError: It is.
        """
        self.told(share)
        self.leash.check()


type Run = Callable[[Work], dict[str, Any]]


def run_job(folder: str, runner: Callable[[JobKind], Run]) -> None:
    """Do the job of a folder, and tell how it goes.

    Args:
        folder: Folder of the job.
        runner: Gives the function of a kind of work.
    """
    started = time.perf_counter()
    place = Path(folder)
    description = Description.read(place)
    teller = Teller(description.mark)
    leash = Leash(place)
    if hasattr(os, "nice"):
        os.nice(_NICENESS)
    try:
        teller.say(Message(0.0, "setting up"))
        if description.scene:
            _open(place / COPY, description)
        result = runner(description.kind)(Work(started, description, leash, teller))
        write_result(place, result)
        teller.say(Message(1.0))
    except CancelledError:
        teller.say(Message(stopped=True))
    except HoeError as error:
        teller.say(Message(error=str(error)))
    sys.stdout.flush()


def _open(path: Path, description: Description) -> None:
    """Open the copy of the user's file, with the scene of the job in the window."""
    import bpy

    from ...blender.quiet import forget_removed_engines

    forget_removed_engines()
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=description.scripts)
    except RuntimeError as error:
        raise HoeError(f"the copy of the file cannot be opened: {error}") from error
    scene = bpy.data.scenes.get(description.scene)
    if scene is None:
        raise HoeError(f"scene {description.scene}: is not in the copy of the file")
    if bpy.context.window is not None:
        bpy.context.window.scene = scene
