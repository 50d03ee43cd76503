# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the interpreter does while foreign data is read: no code, no writing, no network."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RUNS_CODE = ("exec", "compile", "import", "code.__new__", "function.__new__", "marshal.loads")
_STARTS = ("subprocess.Popen", "os.system", "os.exec", "os.fork", "os.forkpty", "os.posix_spawn")
_FORBIDDEN = {
    *_RUNS_CODE,
    *_STARTS,
    *("os.spawn", "os.startfile", "pty.spawn", "pickle.find_class", "ctypes.dlopen"),
    *("os.rename", "os.remove", "os.rmdir", "os.mkdir", "os.link", "os.symlink", "os.truncate"),
    *("os.chmod", "os.chown", "os.utime", "os.putenv", "os.chdir", "tempfile.mkstemp"),
    *("tempfile.mkdtemp", "shutil.copyfile", "shutil.move", "shutil.rmtree", "webbrowser.open"),
}
_FAMILIES = ("socket.", "urllib.", "http.", "ftplib.", "smtplib.", "winreg.")
_WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


class _State:
    """A hook of the interpreter stays for ever, so that it is switched and not taken away."""

    installed = False
    active = False
    seen: list[str]


_state = _State()


def _hook(event: str, arguments: tuple[object, ...]) -> None:
    if not _state.active:
        return
    if event == "open":
        flags = arguments[2]
        if isinstance(flags, int) and flags & _WRITES:
            _state.seen.append(f"open for writing: {arguments[0]!r:.200}")
    elif event in _FORBIDDEN or event.startswith(_FAMILIES):
        _state.seen.append(f"{event}: {arguments!r:.200}")


@contextmanager
def watched() -> Iterator[list[str]]:
    """Note everything that reading must not do.

    Yields:
        What was done; read it after the block.
    """
    if not _state.installed:
        sys.addaudithook(_hook)
        _state.installed = True
    _state.seen = []
    _state.active = True
    try:
        yield _state.seen
    finally:
        _state.active = False
