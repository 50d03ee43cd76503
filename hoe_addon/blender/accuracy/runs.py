# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs: a reference, then one knob after the other, within a budget of time.

Half of the budget goes to the reference. The rest is shared evenly over what is left to measure,
the device as it is counting several times. Each variant is built once and rendered with 8, 16, 32
... samples, each with random numbers of its own, so that every point is a picture as `render`
would give it, and all of them together show the noise.
"""

import itertools
import math
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import BoolArray
from ...core.errors import CancelledError, HoeError
from ...core.picture_error import Estimate, emitter_field
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.field import field_mask
from ..build.device import DeviceScene
from ..pictures.denoiser import denoise
from ..pictures.division import Division
from ..pictures.render import Progress
from ..pictures.view import View, clean_picture
from .knobs import NotMeasured, Variant, reference_spec, variants
from .results import Accuracy, Judge, Run, Spent
from .shots import Shots, division_of
from .target import sharpness, why_no_target
from .timing import FixedTime, SampleTime
from .watch import Watch

type Opener = Callable[[DeviceSpec], DeviceScene]
"""Builds a device in a new, empty Blender file."""

_FIRST_SAMPLES = 8
_LEAST_PICTURES = 2
_LONGER, _LONGEST = 4.0, 64
"""While the time of a sample is not known, the next render's samples take that many times what a
render takes by itself; but it has not more than so many times the samples of the last."""

_REFERENCE_SHARE = 0.5
_BASE_WEIGHT = 3.0
"""Shares of the time that go to the device as it is, whose curve is that of the samples."""

_PILOT_SHARE = 1.0 / 6.0
"""A pilot that takes a larger part of the reference's time would not pay."""

_PIECE_SHARE = 1.0 / 6.0
"""Samples of one piece of the reference take this part of its time at most: a stop is heard soon,
and yet pieces are long beside what each costs for its own set-up."""

_PIECE_PATHS = 2_000_000
"""Nor have they more camera paths: Cycles would set the scene up again for longer renders."""

_NOISE_ROOM = 9
"""A variant has not more than this part of the reference's samples: more could not be judged."""

_TARGET_SAMPLES = 2
"""Samples of the sharpness over those of the picture; its picture is much smaller."""


@dataclass(frozen=True, eq=False)
class _Court:
    """The reference, and what it took.

    ``clock`` is the time of a sample by the clock over that by the processor. It makes processor
    time, which other work on the machine disturbs little, into the time that one waits. ``fixed``
    is what a render of the device takes by itself.
    """

    judge: Judge
    seconds: float
    samples: float
    sharpness: Estimate | None
    division: Division
    clock: float
    fixed: FixedTime


def measure_accuracy(
    spec: DeviceSpec,
    build: Opener,
    budget: float,
    stop: Callable[[], bool] = lambda: False,
    progress: Progress | None = None,
) -> Accuracy:
    """Measure error against time for each knob by itself, and for combinations.

    Args:
        spec: The device; its render seed is the first of all that are used.
        build: Builds it.
        budget: About how long all takes together, in seconds, set-up of scenes included.
        stop: Asked between renders whether to stop; what has been measured is kept.
        progress: Told after every render.

    Returns:
        What was found.

    Raises:
        CancelledError: Stopped before there was a result.
        HoeError: The device cannot be built or rendered.
    """
    watch = Watch(budget, stop, progress)
    seeds = itertools.count(spec.render.seed + 1)
    asked, missing = variants(spec)
    court = _reference(spec, build, watch, seeds)
    watch.lap()
    runs: list[Run] = []
    groups = _same_device(asked)
    for place, group in enumerate(groups):
        weight = 1.0 if place else _BASE_WEIGHT
        share = watch.left * weight / (weight + len(groups) - place - 1)
        try:
            if place:
                watch.refuse_when_over()
            runs += _runs(group, build, court, watch, seeds, share)
            watch.lap()
        except HoeError as error:
            if not runs:
                raise
            missing += [NotMeasured(each.knob, each.value, str(error)) for each in group]
    order = {id(each): place for place, each in enumerate(asked)}
    return Accuracy(
        judge=court.judge,
        reference_seconds=court.seconds,
        reference_samples=court.samples,
        reference_sharpness=court.sharpness,
        clock=court.clock,
        why_no_sharpness=why_no_target(spec),
        runs=tuple(sorted(runs, key=lambda run: order[id(run.variant)])),
        not_measured=tuple(missing),
        stopped=stop(),
        spent=Spent(watch.laps[0], watch.laps[1], watch.spent - sum(watch.laps[:2])),
    )


def _same_device(asked: Sequence[Variant]) -> list[list[Variant]]:
    """Put those together that differ in what is done to the picture only."""
    groups: list[list[Variant]] = []
    for variant in asked:
        for group in groups:
            if group[0].spec == variant.spec:
                group.append(variant)
                break
        else:
            groups.append([variant])
    return groups


def _reference(spec: DeviceSpec, build: Opener, watch: Watch, seeds: Iterator[int]) -> _Court:
    """Render pairs of pictures while there is time."""
    best = reference_spec(spec)
    device = build(best)
    until = _REFERENCE_SHARE * watch.budget
    shots = Shots(device, seeds, division_of(device, seconds=_PILOT_SHARE * until))
    width, height = spec.render.size
    most = max(_FIRST_SAMPLES, _PIECE_PATHS // (width * height))
    samples, stopped = _FIRST_SAMPLES, False
    while not stopped:
        for _ in range(2):
            shots.shoot(samples)
            watch.tell()
        each = shots.clock_time.seconds
        samples = max(samples, min(2 * samples, most, int(_PIECE_SHARE * until / each)))
        longer = shots.views[-1].seconds + (samples - shots.samples[-1]) * each
        stopped = watch.stop() or watch.spent + 2 * longer > until
        if watch.stop() and len(shots.views) <= 2:
            raise CancelledError("stopped before there was a reference")
    displays = shots.displays()
    judge = Judge(shots.pictures(), displays, _field(spec, displays.mean()))
    contrast = None
    if not why_no_target(spec):
        contrast = sharpness(shots.device, _TARGET_SAMPLES * shots.samples[-1], next(seeds))
    work, clock, sample = sum(shots.work), shots.clock, shots.processor_time
    seconds, fixed = work * clock * sample.seconds, sample.for_other_settings()
    return _Court(judge, seconds, work, contrast, shots.division, clock, fixed)


def _field(spec: DeviceSpec, light: np.ndarray) -> BoolArray:
    """Pixels that count: the display's field, or where displays and lamps are seen."""
    if isinstance(spec, LightGuideSpec):
        return field_mask(spec, *spec.render.size)
    return emitter_field(light)


def _runs(
    group: Sequence[Variant],
    build: Opener,
    court: _Court,
    watch: Watch,
    seeds: Iterator[int],
    share: float,
) -> list[Run]:
    """Measure variants that are the same device."""
    started = time.perf_counter()
    device = build(group[0].spec)
    shots = Shots(device, seeds, division_of(device, court.division), court.fixed)
    built = time.perf_counter() - started
    shots.shoot(_FIRST_SAMPLES)
    most = max(2 * _FIRST_SAMPLES, court.samples / _NOISE_ROOM)
    samples = _FIRST_SAMPLES
    while not watch.stop():
        shots.shoot(samples)
        watch.tell()
        samples *= 2
        if len(shots.views) <= _LEAST_PICTURES:
            continue
        sample = shots.processor_time
        until = time.perf_counter() - started + samples * court.clock * sample.seconds
        if samples > most or until > share:
            samples = 0 if sample.is_known else _telling(shots, sample)
            until = samples * court.clock * sample.seconds
            if samples <= shots.samples[-1] or until > watch.left:
                break
    if len(shots.views) <= 1:
        raise CancelledError("stopped by the user")
    return [_run(variant, shots, built, court, next(seeds)) for variant in group]


def _telling(shots: Shots, sample: SampleTime) -> int:
    """Samples of a render that is long enough to tell the time of a sample."""
    fixed = sample.fixed.seconds * len(shots.division.passes)
    share = shots.work[-1] / shots.samples[-1]
    wanted = math.ceil(_LONGER * fixed / (share * (sample.seconds + sample.error)))
    return min(wanted, _LONGEST * shots.samples[-1])


def _finished(variant: Variant, views: Sequence[View]) -> tuple[list[View], float]:
    """What is done to the pictures, and the processor time that it takes for one."""
    if not variant.denoised:
        return list(views), 0.0
    shown: list[View] = []
    times: list[float] = []
    for view in views:
        started = time.process_time()
        shown.append(replace(view, picture=clean_picture(view), display=denoise(view.display)))
        times.append(time.process_time() - started)
    # The denoiser takes the same time for all; the median leaves the first, slow one out.
    return shown, statistics.median(times)


def _run(variant: Variant, shots: Shots, built: float, court: _Court, seed: int) -> Run:
    """Judge the renders of one variant."""
    judge = court.judge
    sample = shots.processor_time
    each = court.clock * sample.seconds
    pieces = shots.pictures()
    variance = pieces.sample_variance()
    # The first render set the scene up, so it is no measure of time.
    shown, finish = _finished(variant, shots.views[1:])
    finish *= court.clock
    points = tuple(
        judge.point(samples, work, work * each + finish, view.picture, view.display, variance)
        for view, samples, work in zip(shown, shots.samples[1:], shots.work[1:], strict=True)
    )
    contrast = None
    if court.sharpness is not None:
        count = _TARGET_SAMPLES * shots.samples[-1]
        contrast = sharpness(shots.device, count, seed, clean=variant.denoised)
    return Run(
        variant=variant,
        build_seconds=built,
        setup_seconds=max(0.0, shots.views[0].seconds - shots.work[0] * each),
        seconds_per_sample=each,
        processor_seconds_per_sample=sample.seconds,
        time_error=sample.relative_error,
        too_short_to_time=not sample.is_known,
        finish_seconds=finish,
        points=points,
        lasting=None if variant.denoised else judge.lasting(pieces, shots.displays()),
        sharpness=contrast,
        picture=shown[-1].picture,
    )
