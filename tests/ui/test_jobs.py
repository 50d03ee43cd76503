# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs beside the window: what a process says, and each way in which it can end."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.blender.job_files import (
    RESULT,
    Description,
    JobKind,
    Message,
    read_result,
    write_result,
)
from hoe_addon.ui.jobs.job import Job, JobError, JobStoppedError
from hoe_addon.ui.jobs.worker import WorkerProcess

ROOT = Path(__file__).resolve().parents[2]
MARK = "hoe-test"
LONG_S = 30.0

HEAD = """\
import os, sys, time
from pathlib import Path
sys.path.insert(0, {root!r})
from hoe_addon.cli.worker.session import run_job
from hoe_addon.core.errors import CancelledError, HoeError
def run(work):
"""
TAIL = """
run_job(sys.argv[1], lambda kind: run)
"""

type Start = Callable[..., Job]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Start a process that does what a text says, as a job of some kind."""
    started: list[Job] = []

    def begin(body: str, kind: JobKind = JobKind.RENDER) -> Job:
        folder = tmp_path / f"job{len(started)}"
        folder.mkdir()
        Description(kind, MARK).write(folder)
        text = HEAD.format(root=str(ROOT)) + "".join(f"    {line}\n" for line in body.splitlines())
        job = Job(kind, "Render", folder, None, 0)
        job.process = WorkerProcess([sys.executable, "-c", text + TAIL, str(folder)], folder, MARK)
        started.append(job)
        return job

    yield begin
    for job in started:
        job.discard()
        assert not job.folder.exists()
        assert job.process is not None
        assert not exists(job.process.pid)


def exists(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def until(found: Callable[[], Any], seconds: float = LONG_S) -> None:
    end = time.monotonic() + seconds
    while not found():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.01)


def ended(job: Job) -> Job:
    until(lambda: not job.is_running)
    return job


WAITING = """\
while not work.leash.stopped():
    work.teller.progress(0.5, "at it")
    time.sleep(0.01)
"""


def test_progress_words_and_result(start: Start) -> None:
    job = start(
        """\
print("Blender says something")
work.note("error 0.2 so far")
work.told(0.25)
print("half a line", end="", flush=True)
time.sleep(0.3)
work.told(0.75)
time.sleep(0.3)
return {"words": "done", "more": [1, 2]}
"""
    )
    assert job.process is not None
    seen: set[float] = set()
    while job.is_running:
        seen.add(job.share)
    assert 0.75 in seen
    assert job.share == 1.0
    assert job.process.words == "error 0.2 so far"
    assert job.result() == {"words": "done", "more": [1, 2]}
    assert job.process.log().splitlines() == ["Blender says something", "half a line"]


def test_words_tell_progress_and_what_esc_does(start: Start) -> None:
    job = start(WAITING)
    until(lambda: job.share)
    assert job.words == "at it, 0 s; Esc ends and keeps what is done"
    job.cancel()
    assert job.words == "ending with what is done; Esc again ends at once"
    ended(job)


def test_error_of_the_user_is_told_in_one_line(start: Start) -> None:
    job = ended(start('raise HoeError("eye.pupil_diameter_mm: must be at most 20, got 30")'))
    with pytest.raises(JobError) as told:
        job.result()
    assert str(told.value) == "Render: eye.pupil_diameter_mm: must be at most 20, got 30"


def test_crash_is_told_with_the_last_words(start: Start) -> None:
    job = ended(start('print("Error: out of memory", flush=True)\nos.kill(os.getpid(), 11)'))
    with pytest.raises(JobError) as told:
        job.result()
    assert str(told.value).startswith(
        "Render: the process ended unexpectedly (signal 11, Segmentation fault); "
        "its last words: Error: out of memory; try "
    )


def test_fault_of_the_program_keeps_its_traceback(start: Start) -> None:
    job = ended(start("return {}['missing']"))
    with pytest.raises(JobError, match=r"exit code 1\).*KeyError: 'missing'"):
        job.result()
    assert job.process is not None
    assert "Traceback" in job.process.log()


def test_stop_keeps_what_is_done(start: Start) -> None:
    job = start(WAITING + 'return {"words": "half of it", "stopped": True}')
    until(lambda: job.share)
    job.cancel()
    assert ended(job).result()["words"] == "half of it"


def test_stop_with_nothing_to_keep(start: Start) -> None:
    job = start("while True:\n    work.progress(0.1)\n    time.sleep(0.01)")
    until(lambda: job.share)
    job.cancel()
    with pytest.raises(JobStoppedError, match="nothing to keep"):
        ended(job).result()


@pytest.mark.parametrize("kind", [JobKind.RENDER, JobKind.BAKE])
def test_cancel_ends_at_once_where_nothing_can_be_kept(start: Start, kind: JobKind) -> None:
    job = start("work.told(0.5)\ntime.sleep(1000)", kind)
    until(lambda: job.share)
    job.cancel()
    if kind == JobKind.RENDER:
        assert job.is_running
        job.cancel()
    with pytest.raises(JobStoppedError):
        ended(job).result()


def test_process_that_does_not_listen_is_killed(start: Start) -> None:
    job = start("work.told(0.5)\ntime.sleep(1000)")
    until(lambda: job.share)
    assert job.process is not None
    job.process._process.send_signal(signal.SIGSTOP)  # as deaf as can be
    job.cancel()
    job.cancel()
    with pytest.raises(JobStoppedError):
        ended(job).result()


def test_unfinished_files_go_when_it_is_ended_at_once(start: Start, tmp_path: Path) -> None:
    target = tmp_path / "out" / "view.exr"
    target.parent.mkdir()
    job = start(
        f"from hoe_addon.files import replacing\nwith replacing({str(target)!r}) as part:\n"
        "    work.told(0.5)\n    time.sleep(1000)"
    )
    until(lambda: list(target.parent.iterdir()))
    job.cancel()
    job.cancel()
    ended(job)
    assert list(target.parent.iterdir()) == []


def test_orphan_ends_and_takes_its_folder_away(tmp_path: Path) -> None:
    """The window is killed, so that nothing of it can tidy up."""
    folder = tmp_path / "job"
    folder.mkdir()
    Description(JobKind.RENDER, MARK).write(folder)
    body = "    work.told(0.5)\n    Path(sys.argv[1], 'pid').write_text(str(os.getpid()))\n"
    text = HEAD.format(root=str(ROOT)) + body + "    time.sleep(1000)\n" + TAIL
    window = f"""\
import sys, time
from pathlib import Path
sys.path.insert(0, {str(ROOT)!r})
from hoe_addon.ui.jobs.worker import WorkerProcess
folder = Path({str(folder)!r})
WorkerProcess([sys.executable, "-c", {text!r}, str(folder)], folder, {MARK!r})
time.sleep(1000)
"""
    with subprocess.Popen([sys.executable, "-c", window]) as parent:
        until(lambda: (folder / "pid").exists() and (folder / "pid").read_text())
        pid = int((folder / "pid").read_text())
        parent.kill()
    until(lambda: not exists(pid) or is_zombie(pid), 5.0)
    assert not folder.exists()


def is_zombie(pid: int) -> bool:
    """Whether it has ended and only waits for a parent that nobody is here."""
    stat = Path(f"/proc/{pid}/stat")
    return stat.exists() and stat.read_text().rpartition(")")[2].split()[0] == "Z"


def test_lines_of_others_are_no_messages() -> None:
    line = Message(0.5, "words").line(MARK).decode()
    assert line.startswith("\n")
    assert line.endswith("\n")
    assert Message.found_in(line.strip(), MARK) == Message(0.5, "words")
    assert Message.found_in(f"Fra:1 {line.strip()}", MARK) == Message(0.5, "words")
    assert Message.found_in(line.strip(), "hoe-other") is None
    assert Message.found_in(line.strip()[:-4], MARK) is None
    assert Message.found_in('{"share": 0.5}', MARK) is None


def test_long_words_stay_one_piece_of_a_pipe() -> None:
    assert len(Message(words="x" * 10_000, error="y" * 10_000).line(MARK)) < 4200


def test_description_and_result_come_back(tmp_path: Path) -> None:
    description = Description(JobKind.BAKE, MARK, "Scene.001", "/out", True, {"material": "M"})
    description.write(tmp_path)
    assert Description.read(tmp_path) == description
    assert read_result(tmp_path) is None
    write_result(tmp_path, {"words": "\u00e4", "stopped": False})
    assert read_result(tmp_path) == {"words": "\u00e4", "stopped": False}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["job.json", RESULT]
