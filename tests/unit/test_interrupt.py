# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C in commands that keep what is done: the first is a wish, the second ends the process."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

CODE = """
import time
from hoe_addon.cli.interrupt import exit_on_interrupt, first_interrupt_asks

exit_on_interrupt()
with first_interrupt_asks() as asked:
    print("ready", flush=True)
    while not asked.is_set():
        time.sleep(0.01)
    print("asked", flush=True)
    if {kept}:
        raise SystemExit(7)
    time.sleep(20.0)
"""


@pytest.mark.parametrize(("kept", "code"), [(True, 7), (False, 130)])
def test_first_and_second_ctrl_c(kept: bool, code: int) -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", CODE.format(kept=kept)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    for word in ("ready", "asked"):
        assert process.stdout.readline() == f"{word}\n"
        if word == "ready" or not kept:
            process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == code
    first, *rest = err.splitlines()
    assert first == "hoe: finishing with what is done; Ctrl-C again stops at once"
    assert rest == ([] if kept else ["hoe: error: stopped by the user; no unfinished file is left"])
