# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render until an error is reached or a time is over, and say what was reached.

Two halves of the samples have random numbers of their own; the picture is their mean, and their
difference tells its noise. They grow in ever larger batches, shared among the passes of the
picture so that the noise falls fastest for its cost.
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.errors import CancelledError
from ...core.photometry import luminance
from ...core.sampling_error import (
    Halves,
    SamplingError,
    denoised_error,
    lit_field,
    noise_error,
    relative_variance,
)
from ...core.sampling_plan import next_samples
from ...model.device import LightGuideSpec
from ...model.field import field_mask
from ...model.quality import QualitySpec
from ..build.device import DeviceScene
from .denoiser import denoise
from .division import divided
from .halves import PassHalves, RenderPass, one_sequence
from .passes import DISPLAY_LAYER, whole
from .reached import End, Reached
from .render import COMBINED, Progress
from .view import View

type Stopped = Callable[[], bool]
"""Asked between parts of the work whether to end it now and keep what is done."""

MOST_SAMPLES = 500_000
"""Samples per pixel of each half after which the render ends in any case."""

PILOT = 2
"""Samples of each half that every pass begins with where time is short."""

_LIKELY = 64
"""Samples that a request may well take; a picture whose 64 samples are soon done is not divided."""

_LEAST_DIVIDED_S = 20.0
"""In less time the pilot that divides a picture would take too much of it."""

_LEAST = 8
"""Samples of each half before an error counts as reached, or denoising is judged: rare light."""

_MARGIN = 0.97
"""Aim a little below the request, so that one batch is enough."""

_PART_S = 5.0
"""A part of each half is at most so long, for a stop has to wait for both."""

_LEAST_AIM = 1e-6
"""Stands for an error as small as can be."""

_MIN_PIXELS = 16
"""Side of a picture whose denoising takes no time."""

_TIME_MARGIN = 0.95
_WRITING_S = 1.0
"""Time kept for the files."""


def converge(
    device: DeviceScene,
    request: QualitySpec,
    progress: Progress | None = None,
    *,
    clean: bool = True,
    started: float | None = None,
    stopped: Stopped | None = None,
    passes: Sequence[RenderPass] | None = None,
    noted: Progress | None = None,
) -> tuple[View, Reached]:
    """Render what the eye sees until the request is met.

    Args:
        device: The device in its scene.
        request: Error, time, or both; the first that is reached ends the render.
        progress: Told the estimated share of the work that is done.
        clean: Whether the picture is denoised too, for the PNG.
        started: When the time began, by ``time.perf_counter``; now if None.
        stopped: Asked whether to end early.
        passes: Terms of the sum that is the picture; by default what a pilot finds best.
        noted: Told the error so far, before the progress that goes with it.

    Returns:
        The view, and what it reached. ``scene.cycles.samples`` holds the samples taken.

    Raises:
        RenderError: Blender gave no usable picture.
        CancelledError: It was stopped before there was a picture.
    """
    began = time.perf_counter() if started is None else started
    with one_sequence(device.scene.cycles):
        terms = passes or _terms(device, request)
        work = _Work(
            device,
            request,
            [PassHalves(term, device.spec.render.seed) for term in terms],
            began,
            progress or (lambda _: None),
            stopped or (lambda: False),
            noted or (lambda _: None),
        )
        end = work.run(clean=clean)
    view, png = work.view(clean=clean and work.enough)
    device.scene.cycles.samples = max(view.samples.values())
    seconds, few = time.perf_counter() - began, clean and not work.enough
    return view, Reached(request, work.error(), png, seconds, view.samples, end, work.set_up, few)


def _terms(device: DeviceScene, request: QualitySpec) -> Sequence[RenderPass]:
    if request.time_limit < _LEAST_DIVIDED_S:
        return [whole(device)]
    return divided(device, _LIKELY).passes


@dataclass(eq=False)
class _Work:
    """A render under way."""

    device: DeviceScene
    request: QualitySpec
    passes: list[PassHalves]
    began: float
    progress: Progress
    stopped: Stopped
    noted: Progress
    reserve: float = _WRITING_S
    told: float = 0.0
    set_up: float = 0.0

    @property
    def enough(self) -> bool:
        """Whether rare light had its chance in every pass."""
        return min(each.samples for each in self.passes) >= _LEAST

    def run(self, *, clean: bool) -> End:
        """Grow the halves until there is a reason to end, and tell it."""
        pilot = _LEAST if self.request.seconds is None else PILOT
        for each in self.passes:
            self._check()
            each.grow(pilot)
        self.set_up = time.perf_counter() - self.began
        if clean and self.request.seconds is not None and self._left() > 0.0:
            self.reserve += self._denoising_seconds()
        while True:
            error = self.error()
            if end := self._end(error):
                return end
            try:
                self._advance(self._plan(error))
            except CancelledError:
                return "stopped"

    def error(self) -> SamplingError:
        """Error of the picture so far."""
        halves = self._halves()
        return noise_error(halves, self._field(halves))

    def view(self, *, clean: bool) -> tuple[View, SamplingError | None]:
        """The picture so far, its denoised form if wanted, and the error of that."""
        pictures, displays = self._layer(COMBINED), self._layer(DISPLAY_LAYER)
        shown, png = None, None
        if clean:
            apart = [
                _denoised(picture, display)
                for picture, display in zip(pictures, displays, strict=True)
            ]
            shown = _mean(apart)
            halves = self._halves()
            clean_halves = Halves(*(luminance(each, 1.0) for each in apart))
            png = denoised_error(halves, clean_halves, self._field(halves))
        seconds = time.perf_counter() - self.began
        samples = {each.source.name: 2 * each.samples for each in self.passes}
        return View(_mean(pictures), _mean(displays), seconds, shown, samples), png

    def _layer(self, name: str) -> list[NDArray[np.float64]]:
        """One layer of both halves, all passes together."""
        return [np.sum([each.layer(name, half) for each in self.passes], axis=0) for half in (0, 1)]

    def _halves(self) -> Halves:
        parts = [each.luminances() for each in self.passes]
        return Halves(
            np.sum([part.first for part in parts], axis=0),
            np.sum([part.second for part in parts], axis=0),
        )

    def _field(self, halves: Halves) -> NDArray[np.bool_]:
        """Pixels that count."""
        spec = self.device.spec
        if isinstance(spec, LightGuideSpec):
            return field_mask(spec, *reversed(halves.first.shape))
        return lit_field(halves.mean)

    def _left(self) -> float:
        """Seconds left for rendering."""
        past = time.perf_counter() - self.began
        return _TIME_MARGIN * (self.request.time_limit - self.reserve - past)

    def _end(self, error: SamplingError) -> End | None:
        """Why the render ends now; None if it goes on."""
        if self.stopped():
            return "stopped"
        if self.request.error is not None and self.enough:
            if error.upper <= self.request.error:
                return "reached"
            if not math.isfinite(error.error):
                return "black"
        if max(each.samples for each in self.passes) >= MOST_SAMPLES:
            return "samples"
        one = 2.0 * sum(each.cost.seconds(1) for each in self.passes)
        return "time" if self._left() < one else None

    def _plan(self, error: SamplingError) -> list[int]:
        """Samples of each half of every pass after the next batch."""
        halves = self._halves()
        field = self._field(halves)
        now = [each.samples for each in self.passes]
        noise = [
            each.samples * relative_variance(each.luminances(), halves.mean, field)
            for each in self.passes
        ]
        costs = [each.cost.line[1] for each in self.passes]
        aim = self._aim(error) ** 2
        wanted = next_samples(now, noise, costs, variance=aim, least=_LEAST)
        added = [more - had for had, more in zip(now, wanted, strict=True)]
        seconds = 2.0 * sum(
            each.cost.seconds(more) for each, more in zip(self.passes, added, strict=True) if more
        )
        share = min(1.0, max(self._left(), 0.0) / seconds)
        return [
            min(had + math.ceil(share * more), MOST_SAMPLES)
            for had, more in zip(now, added, strict=True)
        ]

    def _aim(self, error: SamplingError) -> float:
        """Error to aim at so that its upper bound meets the request."""
        if self.request.error is None or not 0.0 < error.error < math.inf:
            return _LEAST_AIM
        return _MARGIN * self.request.error * error.error / error.upper

    def _advance(self, wanted: Sequence[int]) -> None:
        """Render up to the planned samples, or until the time is over or it is stopped."""
        for each, samples in zip(self.passes, wanted, strict=True):
            while each.samples < samples:
                self._check()
                count = min(
                    samples - each.samples,
                    each.left_in_sequence(),
                    max(each.cost.samples_within(_PART_S), 1),
                )
                if (in_time := each.cost.samples_within(self._left() / 2.0)) < 1:
                    return
                each.grow(min(count, in_time))
                self._tell()

    def _check(self) -> None:
        if self.stopped():
            raise CancelledError("stopped")

    def _tell(self) -> None:
        """Tell the share of the time, or of the noise to be removed, whichever is farther."""
        past = (time.perf_counter() - self.began) / self.request.time_limit
        found, done = self.error(), 0.0
        if self.request.error is not None:
            done = min((self.request.error / found.upper) ** 2, 1.0) if found.upper > 0.0 else 1.0
        if math.isfinite(found.error):
            self.noted(found.error)
        self.told = min(max(self.told, past, done), 1.0)
        self.progress(self.told)

    def _denoising_seconds(self) -> float:
        """How long the denoising will take at the end, by a part of it done now."""
        denoise(np.zeros((_MIN_PIXELS, _MIN_PIXELS, 3), dtype=np.float32))  # loads its weights
        started = time.perf_counter()
        denoise(self.passes[0].layer(COMBINED, 0).astype(np.float32))
        return 4.0 * (time.perf_counter() - started)


def _mean(halves: Sequence[NDArray[np.floating]]) -> NDArray[np.float32]:
    return np.mean(halves, axis=0).astype(np.float32)


def _denoised(picture: NDArray[np.float64], display: NDArray[np.float64]) -> NDArray[np.float32]:
    """A half without noise; display and room apart, for their noise differs."""
    return denoise(display.astype(np.float32)) + denoise((picture - display).astype(np.float32))
