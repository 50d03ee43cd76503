# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Output files that are whole or not there, and that are known to be writable before the work."""

import secrets
import shutil
import tempfile
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from pathlib import Path

from .core.errors import HoeError

VIEW_FILES = ("view.exr", "view.png", "view.blend", "metrics.json")
"""What a view writes into its folder."""

_unfinished: set[Path] = set()
"""Files and folders that only last while something is being made."""


class OutputError(HoeError):
    """A file or folder cannot be written."""


@contextmanager
def replacing(path: str | Path) -> Generator[Path]:
    """Write a file under another name beside it, and give it its name at the very end.

    The other file is made at once, so that a folder that cannot be written is found before any
    work. If the work fails or is stopped, an older file of that name stays as it was.

    Args:
        path: The file to be.

    Yields:
        The file to write meanwhile; it exists and is empty.

    Raises:
        OutputError: ``FILE: cannot be written: why``.
    """
    target = Path(path).resolve()
    check_target(path)
    # The suffix stays last, because writers of pictures and archives go by it.
    temporary = target.with_name(f".{target.stem}.{secrets.token_hex(4)}.part{target.suffix}")
    try:
        temporary.open("xb").close()
    except OSError as error:
        raise _refusal(path, error) from error
    _unfinished.add(temporary)
    try:
        yield temporary
        try:
            temporary.replace(target)
        except OSError as error:
            raise _refusal(path, error) from error
    finally:
        temporary.unlink(missing_ok=True)
        _unfinished.discard(temporary)


def check_target(path: str | Path) -> None:
    """Refuse a file that is going to be written, before any work, where that cannot be.

    Args:
        path: The file to be; its folder need not exist yet.

    Raises:
        OutputError: ``FILE: cannot be written: why``.
    """
    try:
        target = Path(path).resolve()
        taken = target.exists() and not target.is_file()
    except OSError as error:
        raise _refusal(path, error) from error
    if taken:
        raise OutputError(f"{path}: cannot be written: not a regular file")


def refuse_own_input(path: str | Path, *inputs: str | Path) -> None:
    """Refuse to write over a file that is being read.

    Args:
        path: The file to be.
        inputs: Files that the work reads.

    Raises:
        OutputError: It is one of them.
    """
    if Path(path).resolve() in {Path(name).resolve() for name in inputs}:
        raise OutputError(f"{path}: cannot be written: it is an input of the same command")


@contextmanager
def scratch_folder() -> Generator[Path]:
    """A folder for files between two programs, gone at the end and after Ctrl-C.

    Yields:
        The folder, in the system's place for such things.
    """
    with tempfile.TemporaryDirectory(prefix="hoe_") as name:
        folder = Path(name)
        _unfinished.add(folder)
        try:
            yield folder
        finally:
            _unfinished.discard(folder)


def discard_unfinished() -> None:
    """Take away what `replacing` and `scratch_folder` have open: the process is about to end."""
    for path in list(_unfinished):
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)


def write_text(path: str | Path, pieces: Iterable[str]) -> None:
    """Write a text file as a whole or not at all.

    Args:
        path: The file.
        pieces: Its text in pieces; made while it is written.

    Raises:
        OutputError: ``FILE: cannot be written: why``.
    """
    with replacing(path) as temporary:
        write_pieces(path, temporary, pieces)


def write_pieces(path: str | Path, temporary: Path, pieces: Iterable[str]) -> None:
    """Write the text of a file that is being replaced.

    Args:
        path: The file to be, for the message.
        temporary: The file that `replacing` gave.
        pieces: The text in pieces; made while it is written.

    Raises:
        OutputError: ``FILE: cannot be written: why``.
    """
    try:
        with temporary.open("w", encoding="utf-8", newline="\n") as file:
            file.writelines(pieces)
    except OSError as error:
        raise _refusal(path, error) from error


def writable_folder(path: str | Path, targets: Iterable[str] = ()) -> Path:
    """Make sure of a folder for results before any work.

    Args:
        path: The folder; made with its parents where it does not exist.
        targets: Names of the files that are going to be written in it.

    Returns:
        The folder.

    Raises:
        OutputError: ``FOLDER: cannot be written: why``.
    """
    if not str(path):
        raise OutputError("--out: must name a folder")
    folder = Path(path)
    for name in targets:
        check_target(folder / name)
    probe = folder / f".{secrets.token_hex(4)}.part"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.open("xb").close()
        probe.unlink()
    except OSError as error:
        raise _refusal(path, error) from error
    return folder


def _refusal(path: str | Path, error: OSError) -> OutputError:
    return OutputError(f"{path}: cannot be written: {error.strerror or error}")
