# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What reading must not do is seen, by one bad reader each."""

import os
import subprocess
import sys
import time
import warnings
from pathlib import Path

import pytest

from hoe_addon.core.errors import HoeError, SpecError
from tests.strangers import judging
from tests.strangers.judging import Case, judge, unclear


def wrong_type() -> None:
    raise TypeError("text")


def no_place() -> None:
    raise SpecError("something is wrong")


def warned() -> None:
    warnings.warn("overflow", RuntimeWarning, stacklevel=1)


def code() -> None:
    compile("1 + 1", "text", "eval")


def foreign_module() -> None:
    import this  # noqa: F401


def process() -> None:
    subprocess.run([sys.executable, "-c", ""], check=True)


def network() -> None:
    import socket

    socket.socket().close()


BAD = (wrong_type, no_place, warned, code, foreign_module, process, network)


@pytest.mark.parametrize("read", BAD, ids=lambda read: read.__name__)
def test_a_bad_reader_is_seen(read: object, capsys: pytest.CaptureFixture[str]) -> None:
    assert judge([Case("bad", read, "x")]).faults  # type: ignore[arg-type]
    del capsys


def test_writing_is_seen(tmp_path: Path) -> None:
    path = tmp_path / "x.txt"
    path.write_text("a", encoding="utf-8")
    for read in (
        lambda: path.write_text("b", encoding="utf-8"),
        lambda: path.open("ab").close(),
        lambda: os.close(os.open(path, os.O_RDWR)),
        lambda: path.rename(tmp_path / "y.txt"),
        lambda: (tmp_path / "z").mkdir(),
    ):
        assert judge([Case("bad", read, "x")]).faults
    assert not judge([Case("good", (tmp_path / "y.txt").read_bytes, "x")]).faults


def test_what_takes_long_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judging, "SLOWEST_S", 0.05)

    def busy() -> None:
        end = time.thread_time() + 0.1
        while time.thread_time() < end:
            pass

    assert "took" in judge([Case("slow", busy, "x")]).faults[0]
    assert not judge([Case("waiting", lambda: time.sleep(0.1), "x")]).faults


@pytest.mark.parametrize("message", ["a", "a: ", ": b", "a: b\nc", "a: \x1b[31m", "a: b" * 999])
def test_unclear_messages(message: str) -> None:
    assert unclear(message)
    assert not unclear("a.b[0]: must be a number, got null")


def test_an_error_is_one_printable_line() -> None:
    assert str(HoeError("a:  b")) == "a:  b"
    assert str(SpecError("a\nb\x1b: \u202ec  d")) == "a b\\x1b: \\u202ec d"
