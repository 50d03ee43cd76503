# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's window and the process of a job say to each other, in files and lines.

The window writes `DESCRIPTION` into the folder of the job and starts the process. The process
prints lines with the mark of the job, one JSON object each; whatever else Blender prints is only
kept for the case of a crash. A file `STOP` asks it to end and keep what is done; when its standard
input closes, it ends at once. What came of the work stands in `RESULT`.
"""

import json
from dataclasses import asdict, dataclass, field
from enum import StrEnum, unique
from pathlib import Path
from typing import Any, Self

from ..core.errors import HoeError
from ..files import write_text

DESCRIPTION, COPY, STOP, RESULT = "job.json", "scene.blend", "stop", "result.json"
"""Files in the folder of a job."""

_MOST_LETTERS = 2000
"""Of a text in a line: a pipe takes so much as one piece, whoever else writes to it."""


@unique
class JobKind(StrEnum):
    """Kinds of long work."""

    RENDER = "render"
    EYEBOX = "eyebox"
    ACCURACY = "accuracy"
    BAKE = "bake"


@dataclass(frozen=True)
class Description:
    """What a process is to do.

    Attributes:
        kind: Kind of work.
        mark: Begins each line that is meant for the window; nobody can guess it.
        scene: Name of the scene in the copy of the file.
        out: Folder for the results, which exists; empty where there is nothing to keep.
        scripts: Whether scripts in the file may run by themselves.
        settings: What the kind of work needs besides.
    """

    kind: JobKind
    mark: str
    scene: str = ""
    out: str = ""
    scripts: bool = False
    settings: dict[str, Any] = field(default_factory=dict)

    def write(self, folder: Path) -> None:
        """Write it into the folder of the job."""
        write_text(folder / DESCRIPTION, (json.dumps(asdict(self)),))

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Read it in the process."""
        document = json.loads((folder / DESCRIPTION).read_text(encoding="utf-8"))
        return cls(**{**document, "kind": JobKind(document["kind"])})


@dataclass(frozen=True)
class Message:
    """One line of a process.

    Attributes:
        share: Share of the work that is done; None where the line says nothing about it.
        words: What it is at; empty where that stays as it was.
        error: Why it cannot go on; one line for the user.
        stopped: Whether it ended early because it was asked to, with nothing to keep.
    """

    share: float | None = None
    words: str = ""
    error: str = ""
    stopped: bool = False

    def line(self, mark: str) -> bytes:
        """The line to print, alone on its line even if Blender left one unfinished."""
        short = {**asdict(self), "words": self.words[:_MOST_LETTERS]}
        short["error"] = self.error[:_MOST_LETTERS]
        return f"\n{mark} {json.dumps(short)}\n".encode()

    @classmethod
    def found_in(cls, line: str, mark: str) -> Self | None:
        """The message in a line, or None where Blender itself has printed it."""
        _, found, text = line.partition(f"{mark} ")
        if not found:
            return None
        try:
            return cls(**json.loads(text))
        except ValueError:
            return None  # cut in two by what Blender printed


def write_result(folder: Path, result: dict[str, Any]) -> None:
    """Write what came of the work.

    Args:
        folder: Folder of the job.
        result: Plain data.
    """
    write_text(folder / RESULT, (json.dumps(result),))


def read_result(folder: Path) -> dict[str, Any] | None:
    """Read what came of the work.

    Args:
        folder: Folder of the job.

    Returns:
        Plain data; None where the process ended without any.

    Raises:
        HoeError: The file cannot be read.
    """
    try:
        return json.loads((folder / RESULT).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise HoeError(f"{folder / RESULT}: cannot be read: {error.strerror or error}") from error
