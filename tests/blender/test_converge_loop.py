# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The loop that renders until a request is met, with passes whose noise is known: no Cycles."""

import time
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.pictures import convergence as loop
from hoe_addon.blender.pictures.convergence import converge
from hoe_addon.blender.pictures.halves import SEQUENCE, Cost
from hoe_addon.blender.pictures.render import COMBINED
from hoe_addon.blender.pictures.view import DISPLAY_LAYER, View
from hoe_addon.core.errors import CancelledError
from hoe_addon.core.sampling_error import lit_field
from hoe_addon.model.quality import QualitySpec

SHAPE = (40, 60, 3)
SAMPLES_BEFORE = 77


class Noise:
    """A pass of even light whose samples scatter by ``sigma`` and take ``seconds`` each."""

    def __init__(
        self, name: str = "noise", light: float = 1.0, sigma: float = 1.0, seconds: float = 0.0
    ) -> None:
        self.name = name
        self.light, self.sigma, self.seconds = light, sigma, seconds
        self.calls: list[tuple[int, int, int]] = []

    def render(self, seed: int, first: int, count: int) -> Mapping[str, NDArray[np.float64]]:
        self.calls.append((seed, first, count))
        time.sleep(self.seconds * count)
        rng = np.random.default_rng((seed, first))
        grey = self.light + self.sigma / np.sqrt(count) * rng.normal(size=(*SHAPE[:2], 1))
        picture = np.broadcast_to(grey, SHAPE)
        return {COMBINED: picture, DISPLAY_LAYER: 0.5 * picture}


def _device(seed: int = 3) -> Any:
    """What the loop asks of a device: its seed, and where Cycles keeps the samples."""
    return SimpleNamespace(
        spec=SimpleNamespace(render=SimpleNamespace(seed=seed)),
        scene=SimpleNamespace(cycles=SimpleNamespace(samples=SAMPLES_BEFORE)),
    )


def _converge(passes: Sequence[Noise], **more: Any) -> tuple[View, loop.Reached]:
    request = QualitySpec(error=more.pop("error", None), seconds=more.pop("seconds", None))
    device = more.pop("device", None) or _device()
    return converge(device, request, clean=False, passes=passes, **more)


def test_an_error_is_reached_with_few_samples_more_than_needed() -> None:
    """Noise 1 per sample of light 1: error e needs 1 / e^2 samples of both halves together."""
    noise = Noise()
    view, reached = _converge([noise], error=0.05)
    assert reached.end == "reached"
    assert reached.picture.upper <= 0.05
    true = np.sqrt(((view.picture[..., 0] - 1.0) ** 2).mean())
    # 2400 pixels know a root mean square to 1.4 %.
    assert reached.picture.error == pytest.approx(true, rel=0.06)
    assert 400 <= reached.samples["noise"] <= 1.4 * 400
    assert view.clean is None
    assert reached.png is None


def test_halves_never_share_random_numbers() -> None:
    noise = Noise()
    _converge([noise], error=0.05)
    first = [call for call in noise.calls if call[0] == 3]
    second = [call for call in noise.calls if call[0] != 3]
    assert [call[1:] for call in first] == [call[1:] for call in second]
    assert len(set(noise.calls)) == len(noise.calls)
    begins = [first_sample for _, first_sample, _ in first]
    ends = [first_sample + count for _, first_sample, count in first]
    assert begins == [0, *ends[:-1]]


def test_long_renders_go_on_with_new_sequences(monkeypatch: pytest.MonkeyPatch) -> None:
    """No part crosses the end of a sequence, and no seed and sample occur twice."""
    monkeypatch.setattr(loop, "MOST_SAMPLES", 2 * SEQUENCE + 10)
    noise = Noise()
    device = _device()
    _, reached = _converge([noise], error=1e-4, device=device)
    assert reached.end == "samples"
    assert reached.samples == {"noise": 2 * (2 * SEQUENCE + 10)}
    assert device.scene.cycles.samples == reached.samples["noise"]
    assert all(first + count <= SEQUENCE for _, first, count in noise.calls)
    taken = [(seed, first + k) for seed, first, count in noise.calls for k in range(count)]
    assert len(set(taken)) == len(taken) == reached.samples["noise"]


def test_samples_go_where_noise_is_cheap_to_remove() -> None:
    """By the root of variance over cost; here 4 times the noise at 4 times the cost: 2 to 1."""
    loud, quiet = Noise("loud", 0.5, 4.0, 4e-4), Noise("quiet", 0.5, 1.0, 1e-4)
    _, reached = _converge([loud, quiet], error=0.1)
    assert reached.end == "reached"
    assert reached.samples["loud"] / reached.samples["quiet"] == pytest.approx(2.0, rel=0.4)


def test_picture_is_the_sum_of_its_passes() -> None:
    view, _ = _converge([Noise("a", 0.25, 0.1), Noise("b", 0.5, 0.1)], error=0.05)
    assert view.picture.mean() == pytest.approx(0.75, abs=0.005)
    assert view.display.mean() == pytest.approx(0.375, abs=0.005)


def test_time_ends_the_render() -> None:
    started = time.perf_counter()
    _, reached = _converge([Noise(seconds=1e-3)], error=1e-4, seconds=2.5)
    taken = time.perf_counter() - started
    assert reached.end == "time"
    assert reached.seconds == pytest.approx(taken, abs=0.1)
    assert 0.8 <= taken <= 2.5
    # Half of the time that is not kept for the files was spent on samples, at the least.
    assert reached.samples["noise"] >= 0.5 * 1.4 / 1e-3


def test_set_up_counts_as_time() -> None:
    past = time.perf_counter() - 100.0
    _, reached = _converge([Noise()], seconds=60.0, started=past)
    assert reached.end == "time"
    assert reached.seconds >= reached.set_up >= 100.0
    assert reached.report()["set_up_seconds"] >= 100.0
    assert reached.samples == {"noise": 2 * loop.PILOT}


def test_few_samples_do_not_judge_denoising(monkeypatch: pytest.MonkeyPatch) -> None:
    """A denoiser without any noise looks better than the truth where few samples judge it."""
    monkeypatch.setattr(loop, "denoise", lambda pixels: np.full_like(pixels, pixels.mean()))
    view, reached = converge(
        _device(),
        QualitySpec(seconds=60.0),
        passes=[Noise()],
        started=time.perf_counter() - 100.0,
    )
    assert reached.too_few
    assert view.clean is reached.png is None
    assert not reached.denoising_helps
    assert reached.report()["png"] == {
        "error": reached.picture.error,
        "upper": reached.picture.upper,
        "denoised": False,
    }


def test_enough_samples_judge_denoising(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loop, "denoise", lambda pixels: np.full_like(pixels, pixels.mean()))
    view, reached = converge(_device(), QualitySpec(error=1.0), passes=[Noise()])
    assert reached.samples == {"noise": 16}
    assert not reached.too_few
    assert view.clean is not None
    assert reached.png is not None
    assert reached.report()["png"]["denoised"] is True
    assert reached.report()["png"]["error"] == reached.png.error < reached.picture.error


def test_a_stop_keeps_what_is_done() -> None:
    noise = Noise()
    view, reached = _converge([noise], error=1e-3, stopped=lambda: len(noise.calls) >= 6)
    assert reached.end == "stopped"
    assert len(noise.calls) == 6
    assert view.picture.mean() == pytest.approx(1.0, abs=0.05)


def test_progress_that_stops_keeps_what_is_done() -> None:
    def stop(share: float) -> None:
        raise CancelledError(str(share))

    _, reached = _converge([Noise()], error=1e-3, progress=stop)
    assert reached.end == "stopped"


def test_a_stop_before_there_is_a_picture_gives_none() -> None:
    with pytest.raises(CancelledError):
        _converge([Noise()], error=0.1, stopped=lambda: True)


def test_progress_only_grows_toward_the_end() -> None:
    heard: list[float] = []
    _converge([Noise()], error=0.02, progress=heard.append)
    assert len(heard) > 3
    assert heard == sorted(heard)
    assert heard[0] > 0.0
    assert heard[-1] == 1.0


def test_black_has_no_error_to_wait_for() -> None:
    _, reached = _converge([Noise(light=0.0, sigma=0.0)], error=0.1)
    assert reached.end == "black"
    report = reached.report()
    assert report["error"] is report["upper"] is report["png"]["error"] is None


def test_a_picture_without_noise_is_done_at_once() -> None:
    _, reached = _converge([Noise(sigma=0.0)], error=1e-4)
    assert reached.end == "reached"
    assert reached.picture.upper == 0.0


def test_report_is_what_was_reached() -> None:
    _, reached = _converge([Noise("a"), Noise("b")], error=0.2)
    report = reached.report()
    assert set(reached.samples) == {"a", "b"}
    assert report["samples"] == sum(reached.samples.values())
    assert report["error"] == report["png"]["error"] == reached.picture.error
    assert report["confidence"] == 0.95


def test_lit_field_is_what_counts_in_a_scene() -> None:
    """Darkness around a picture changes nothing."""

    class Window(Noise):
        def render(self, seed: int, first: int, count: int) -> Mapping[str, NDArray[np.float64]]:
            found = super().render(seed, first, count)
            mask = np.zeros(SHAPE)
            mask[10:30, 20:50] = 1.0
            return {name: pixels * mask for name, pixels in found.items()}

    view, reached = _converge([Window()], error=0.05)
    assert lit_field(view.picture[..., 0].astype(np.float64)).sum() == 20 * 30
    assert 400 <= reached.samples["noise"] <= 1.6 * 400


def test_cost_tells_the_start_from_the_samples() -> None:
    cost = Cost()
    cost.add(2, 9.0)  # left out: it compiles the shaders
    for samples in (2, 8, 40):
        cost.add(samples, 1.5 + 0.1 * samples)
    assert cost.line == pytest.approx((1.5, 0.1))
    assert cost.seconds(100) == pytest.approx(11.5)
    assert cost.samples_within(11.5) in (99, 100)
    assert cost.samples_within(1.0) == 0
