# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `accuracy`: its files, what it refuses, and measures with known results."""

import csv
import itertools
import json
import math
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.accuracy.results import Judge
from hoe_addon.blender.accuracy.shots import Shots, division_of
from hoe_addon.blender.accuracy.target import sharpness
from hoe_addon.blender.build.device import build_device
from hoe_addon.cli import main
from hoe_addon.core.picture_error import emitter_field
from hoe_addon.model.document import load_device

pytestmark = pytest.mark.render

ROOT = Path(__file__).resolve().parents[2]
SIGMAS = 4.0
CONTRAST_SLACK = 0.01
"""The pupil is filled a little unevenly, since the guide gives its light in steps."""


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--budget", "0"], "--budget: must be from 5 to 86400, got '0'"),
        (["--budget", "nan"], "--budget: must be from 5 to 86400, got 'nan'"),
        (["--size", "8x8"], "--size: both sides must be at least 16 pixels, got 8x8"),
        (["--size", "big"], "--size: must be two whole numbers"),
        (["--seed", "-1"], "render.seed: must be from 0"),
        (["--set", "render.wavelengths=few"], "render.wavelengths: must be"),
    ],
)
def test_refusals_leave_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    out = tmp_path / "out"
    assert main(["accuracy", "grating_rainbow", "--out", str(out), *options]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert message in said.err
    assert not out.exists()


def test_without_matplotlib_nothing_is_started(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["accuracy", "grating_rainbow", "--out", str(tmp_path / "out")]) == 2
    assert "accuracy: needs matplotlib" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def _bessel_1(x: float) -> float:
    """J1 by its integral; far more exact than it is used."""
    angle = (np.arange(2000) + 0.5) / 2000 * math.pi
    return float(np.mean(np.cos(angle - x * np.sin(angle))))


@pytest.mark.slow
@pytest.mark.parametrize("focus_mm", [None, 3000.0, 2000.0])
def test_contrast_of_an_eye_out_of_focus(focus_mm: float | None, clean_scene: Any) -> None:
    """A disc of blur of angle b leaves 2 J1(x) / x of the contrast, with x = pi b f."""
    focus = json.dumps(focus_mm)
    spec = load_device("two_hologram_ar", [f"eye.focus_mm={focus}", "room.kind=none"])
    found = sharpness(build_device(clean_scene, spec, ROOT), samples=128, seed=1)
    blur_deg = math.degrees(spec.eye.pupil_diameter_mm / focus_mm) if focus_mm else 0.0
    x = math.pi * blur_deg * 5.0
    expected = 2.0 * _bessel_1(x) / x if x else 1.0
    assert abs(found.value - expected) < SIGMAS * found.standard_error + CONTRAST_SLACK
    assert found.standard_error < 0.02


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of a short measurement of a device with a hostile title."""
    folder = tmp_path_factory.mktemp("accuracy")
    arguments = ["accuracy", "grating_rainbow", "--out", str(folder), "--size", "32x24"]
    title = "title=<script>alert(1)</script>"
    assert main([*arguments, "--budget", "30", "--set", title, "--set", 'name="<b>&"']) == 0
    return folder


@pytest.mark.slow
def test_numbers_hang_together(results: Path) -> None:
    report = json.loads((results / "accuracy.json").read_text(encoding="utf-8"))
    assert report["schema"] == 1
    assert report["size"] == [32, 24]
    own = report["reference"]["own_errors"]
    assert 0.0 < own["error"] < 1.0
    points = [point for run in report["runs"] for point in run["points"]]
    assert [run["number"] for run in report["runs"]] == list(range(1, len(report["runs"]) + 1))
    for point in points:
        assert point["seconds"] > 0.0
        limited = point["error"]["value"] < 3.0 * own["error"]
        assert ("error" in point["limited"]) == limited
    front = sorted(
        (point["seconds"], point["shown_error"]) for point in points if point["on_pareto_front"]
    )
    errors = [error for _, error in front]
    assert errors == sorted(errors, reverse=True)
    timed = [run for run in report["runs"] if not run["too_short_to_time"]]
    assert timed
    for point in (point for run in timed for point in run["points"]):
        assert any(s <= point["seconds"] and e <= point["shown_error"] for s, e in front)
    with (results / "accuracy.csv").open(encoding="utf-8", newline="") as file:
        assert len(list(csv.DictReader(file))) == len(points)


def _shots(scene: Any, changes: list[str], counts: tuple[int, ...], seed: int) -> Shots:
    spec = load_device("grating_rainbow", ["render.size=[32, 24]", *changes])
    device = build_device(scene, spec, ROOT)
    shots = Shots(device, itertools.count(seed), division_of(device))
    for count in counts:
        shots.shoot(count)
    return shots


@pytest.mark.slow
def test_published_algorithm_is_judged_to_be_noisy_and_right(clean_scene: Any) -> None:
    """Its noise falls with the root of the samples, and toward the picture of the best sampling."""
    best = _shots(clean_scene, [], (512, 512), seed=1)
    displays = best.displays()
    judge = Judge(best.pictures(), displays, emitter_field(displays.mean()))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    published = ["render.wavelengths=uniform", "render.order_selection=significance"]
    shots = _shots(bpy.context.scene, published, (*[8] * 16, *[128] * 4), seed=100)
    variance = shots.pictures().sample_variance()
    squares: dict[int, list[float]] = {8: [], 128: []}
    for view, count in zip(shots.views, shots.samples, strict=True):
        point = judge.point(count, count, 1.0, view.picture, view.display, variance)
        squares[count].append(point.error.value**2)
    ratio = (np.mean(squares[8]) / np.mean(squares[128])) ** 0.5
    # 16 times the samples; spread evenly they do better than the root, rare bright ones worse.
    assert 2.8 < ratio < 6.5
    lasting = judge.lasting(shots.pictures(), displays)
    assert np.mean(squares[8]) * 8 == pytest.approx(lasting.noise, rel=0.4)
    assert lasting.error.value < SIGMAS * lasting.error.standard_error
    assert lasting.error.value < 0.2


@pytest.mark.slow
def test_page_is_one_file_and_escapes_texts(results: Path) -> None:
    text = (results / "accuracy.html").read_text(encoding="utf-8")
    assert "<script" not in text
    assert "<b>&" not in text
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in text
    report = json.loads((results / "accuracy.json").read_text(encoding="utf-8"))
    sources = re.findall(r'src="([^"]{0,40})', text)
    # The diagram, the reference, and a picture of each run.
    assert len(sources) == 2 + len(report["runs"])
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert "http" not in text
    assert (results / "accuracy.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")


def _ask_by(is_asked: Callable[[], bool], monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the command hear a wish to stop where no signal can be sent."""
    from hoe_addon.cli import accuracy

    @contextmanager
    def interrupts() -> Iterator[Any]:
        yield SimpleNamespace(is_set=is_asked)

    monkeypatch.setattr(accuracy, "first_interrupt_asks", interrupts)


@pytest.mark.slow
def test_stop_keeps_what_is_done(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The user asks to stop as soon as the device as it is has been measured."""
    from hoe_addon.blender.accuracy import runs as accuracy_runs

    wishes: list[str] = []
    measured = accuracy_runs._runs

    def measure_and_stop(*arguments: Any) -> Any:
        wishes.append("stop")
        return measured(*arguments)

    def is_asked() -> bool:
        # The first two renders of the run are still wanted.
        return bool(wishes) and wishes.append("again") is None and len(wishes) > 3

    monkeypatch.setattr(accuracy_runs, "_runs", measure_and_stop)
    _ask_by(is_asked, monkeypatch)
    arguments = ["accuracy", "grating_rainbow", "--out", str(tmp_path), "--size", "32x24"]
    assert main([*arguments, "--budget", "5"]) == 130
    assert "stopped by the user" in capsys.readouterr().out
    report = json.loads((tmp_path / "accuracy.json").read_text(encoding="utf-8"))
    assert report["stopped_by_user"]
    assert [run["knob"] for run in report["runs"]] == ["samples", "denoiser"]
    assert any(each["why"] == "stopped by the user" for each in report["not_measured"])
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "accuracy.csv",
        "accuracy.html",
        "accuracy.json",
        "accuracy.png",
    ]


@pytest.mark.slow
def test_stop_before_there_is_a_result_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _ask_by(lambda: True, monkeypatch)
    arguments = ["accuracy", "grating_rainbow", "--out", str(tmp_path), "--size", "16x16"]
    assert main([*arguments, "--budget", "5"]) == 130
    assert list(tmp_path.iterdir()) == []
