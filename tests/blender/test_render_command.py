# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What ``render`` says and leaves behind, with scenes and renders that take no time."""

import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any, Never

import pytest

from hoe_addon.blender.pictures import convergence as loop
from hoe_addon.blender.pictures import view as views
from hoe_addon.blender.pictures.reached import Reached
from hoe_addon.cli import main, render
from hoe_addon.cli.interrupt import EXIT_INTERRUPTED
from hoe_addon.core.errors import CancelledError
from hoe_addon.core.sampling_error import SamplingError
from hoe_addon.model import effects
from hoe_addon.model.field_error import FieldError
from hoe_addon.model.quality import QualitySpec

PRESET = "grating_rainbow"

METRICS = {
    "picture": {"mean_cd_m2": 1.0, "mean_standard_error_at_most_cd_m2": 0.04},
    "emitters": {
        "mean_cd_m2": 1.0,
        "peak_cd_m2": 2.0,
        "mean_standard_error_at_most_cd_m2": None,
    },
    "samples": 4,
    "seconds": 0.5,
}
"""As much of a view's metrics as the terminal shows."""


def _raise(error: Exception) -> Callable[..., Never]:
    def act(*args: object, **more: object) -> Never:
        raise error

    return act


def _reached(wanted: float, set_up: float, *, too_few: bool) -> Reached:
    error = SamplingError(0.5, 0.6)
    seconds = set_up + 0.1
    return Reached(
        QualitySpec(seconds=wanted), error, None, seconds, {"whole": 4}, "time", set_up, too_few
    )


@pytest.fixture
def rendered(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[[Reached], int]:
    """Run ``render --seconds`` with what it is said to have reached."""

    def run(reached: Reached) -> int:
        def save_view(device: object, view: object, folder: Path, **more: Any) -> Any:
            assert folder.is_dir()
            return METRICS

        monkeypatch.setattr(render, "open_device", lambda *_: None)
        monkeypatch.setattr(loop, "converge", lambda *_, **__: (None, reached))
        monkeypatch.setattr(views, "save_view", save_view)
        wanted = str(reached.request.seconds)
        return main(["render", PRESET, "--seconds", wanted, "--out", str(tmp_path / "out")])

    return run


def test_time_that_set_up_took_is_told(
    rendered: Callable[[Reached], int],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(render.time, "perf_counter", itertools.count(0.0, 5.0).__next__)
    assert rendered(_reached(1.0, 9.3, too_few=False)) == 0
    said = capsys.readouterr().out
    assert "1 s was passed: set-up alone, with the first samples, took 9.3 s" in said


def test_means_are_told_with_their_errors(
    rendered: Callable[[Reached], int], capsys: pytest.CaptureFixture[str]
) -> None:
    assert rendered(_reached(5.0, 4.8, too_few=False)) == 0
    said = capsys.readouterr().out
    assert "picture: mean 1.0 +- 0.04 cd/m2; light of displays and lamps: mean 1.0, peak" in said


def test_time_that_was_kept_is_not_told(
    rendered: Callable[[Reached], int], capsys: pytest.CaptureFixture[str]
) -> None:
    assert rendered(_reached(60.0, 9.3, too_few=False)) == 0
    assert "passed" not in capsys.readouterr().out


@pytest.mark.parametrize("few", [True, False])
def test_denoising_that_few_samples_cannot_judge_is_told(
    rendered: Callable[[Reached], int], capsys: pytest.CaptureFixture[str], *, few: bool
) -> None:
    assert rendered(_reached(60.0, 9.3, too_few=few)) == 0
    told = "denoised: too few samples to tell its error; view.png is not denoised"
    assert (told in capsys.readouterr().out) is few


def test_a_stop_before_the_first_samples_leaves_no_folder(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    out = tmp_path / "new" / "deep"

    def open_device(*_: object) -> None:
        # Ctrl-C in the set-up ends the process without a word to anybody.
        assert not out.parent.exists()

    monkeypatch.setattr(render, "open_device", open_device)
    monkeypatch.setattr(loop, "converge", _raise(CancelledError("stopped")))
    assert main(["render", PRESET, "--seconds", "60", "--out", str(out)]) == EXIT_INTERRUPTED
    assert not out.parent.exists()


def test_folder_that_was_there_stays(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(render, "open_device", lambda *_: None)
    monkeypatch.setattr(loop, "converge", _raise(CancelledError("stopped")))
    assert main(["render", PRESET, "--seconds", "60", "--out", str(tmp_path)]) == EXIT_INTERRUPTED
    assert tmp_path.is_dir()


def test_unknown_effect_is_told_with_the_document_before_any_work(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(render, "open_device", _raise(AssertionError("a scene was built")))
    out = tmp_path / "out"
    assert main(["render", PRESET, "--effects", "foo", "--out", str(out)]) == 2
    assert capsys.readouterr().err.startswith(f"hoe: error: {PRESET}: render.effects[0]: must be")
    assert not out.exists()


def test_effect_that_must_stay_is_told_with_the_document(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = FieldError("render.effects", "must not leave this out", "-orders")
    monkeypatch.setattr(effects, "plan_effects", _raise(wrong))
    assert main(["render", PRESET, "--out", str(tmp_path)]) == 2
    assert capsys.readouterr().err.startswith(f"hoe: error: {PRESET}: render.effects: must not")
