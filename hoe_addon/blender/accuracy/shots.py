# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Independent renders of one device, and how long its samples take without scene set-up."""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from ...core.picture_pieces import Pieces
from ..build.device import DeviceScene
from ..pictures.division import Division, divided
from ..pictures.passes import is_divisible, whole
from ..pictures.view import View, render_view
from .timing import FixedTime, SampleTime, sample_time

_PILOT_RENDERS = 6
"""Of the whole picture and of two passes, each with few samples and with some more."""


@dataclass(eq=False)
class Shots:
    """Renders of one device with seeds of their own, the first of which sets the scene up.

    Attributes:
        device: The device in its scene.
        seeds: Where each render takes its seed from.
        division: How its picture is divided into passes.
        fixed: What is known of the processor time that each render takes by itself.
        views: The pictures.
        samples: Samples per pixel of each, as they were asked for.
        work: The same as they were done: all samples of all passes, over the pixels.
        processor: Processor time of each, all threads together, in seconds.
    """

    device: DeviceScene
    seeds: Iterator[int]
    division: Division
    fixed: FixedTime = FixedTime()  # noqa: RUF009 (frozen)
    views: list[View] = field(default_factory=list[View])
    samples: list[int] = field(default_factory=list[int])
    work: list[float] = field(default_factory=list[float])
    processor: list[float] = field(default_factory=list[float])

    def __post_init__(self) -> None:
        """Keep the scene in Cycles between the renders, so that it is set up once."""
        self.device.scene.render.use_persistent_data = True

    def shoot(self, samples: int) -> None:
        """Render once more.

        Args:
            samples: Samples per pixel.

        Raises:
            RenderError: Blender gave no usable picture.
        """
        begun = time.process_time()
        cycles = self.device.scene.cycles
        cycles.samples, cycles.seed = samples, next(self.seeds)
        self.views.append(render_view(self.device, division=self.division))
        self.processor.append(time.process_time() - begun)
        self.samples.append(samples)
        counts = zip(self.division.counts(samples), self.division.passes, strict=True)
        width, height = self.device.spec.render.size
        self.work.append(sum(count * each.pixels for count, each in counts) / (width * height))

    @property
    def clock_time(self) -> SampleTime:
        """Time of a sample by the clock, by all renders but the first, which sets the scene up."""
        return self._time([view.seconds for view in self.views], FixedTime())

    @property
    def processor_time(self) -> SampleTime:
        """The same by the processor, all threads together."""
        return self._time(self.processor, self.fixed)

    def _time(self, seconds: Sequence[float], fixed: FixedTime) -> SampleTime:
        warm = slice(1, None) if len(self.views) > 1 else slice(None)
        return sample_time(self.work[warm], seconds[warm], fixed, len(self.division.passes))

    @property
    def clock(self) -> float:
        """Time of a sample by the clock over that by the processor."""
        return self.clock_time.seconds / self.processor_time.seconds

    @property
    def processor_seconds_per_sample(self) -> float:
        """Processor time of a sample, all threads together."""
        return self.processor_time.seconds

    def pictures(self) -> Pieces:
        """All light, render by render."""
        return Pieces([view.picture for view in self.views], self.work)

    def displays(self) -> Pieces:
        """Light of displays and lamps, render by render."""
        return Pieces([view.display for view in self.views], self.work)


def division_of(
    device: DeviceScene, known: Division | None = None, seconds: float = math.inf
) -> Division:
    """Divide the picture of a device into passes.

    Args:
        device: The device in its scene.
        known: How that of a similar device is divided, which is taken over to save the pilot. The
            sum of the passes is the picture in any case, only its noise might be less.
        seconds: Time that there is for a pilot; the picture stays whole where that is too short.

    Returns:
        The passes of the device.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    one = Division((whole(device),), (1.0,), 1.0)
    if not is_divisible(device):
        return one
    if known is None:
        return divided(device) if _pilot_seconds(device) <= seconds else one
    return replace(known, passes=tuple(replace(each, device=device) for each in known.passes))


def _pilot_seconds(device: DeviceScene) -> float:
    """About how long a pilot takes: next to nothing but the set-up of its renders."""
    begun = time.perf_counter()
    whole(device).render(device.scene.cycles.seed, 0, 1)
    return _PILOT_RENDERS * (time.perf_counter() - begun)
