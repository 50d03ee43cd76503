# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Independent renders of one device, and how long its samples take without scene set-up."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..core.picture_pieces import Pieces
from .device import DeviceScene
from .division import Division, divided
from .passes import is_divisible
from .view import View, render_view


@dataclass(eq=False)
class Shots:
    """Renders of one device with seeds of their own, the first of which sets the scene up.

    Attributes:
        device: The device in its scene.
        seeds: Where each render takes its seed from.
        division: How its picture is divided into passes.
        views: The pictures.
        samples: Samples per pixel of each, as they were asked for.
        work: The same as they were done: all samples of all passes, over the pixels.
        processor: Processor time of each, all threads together, in seconds.
    """

    device: DeviceScene
    seeds: Iterator[int]
    division: Division
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
    def seconds_per_sample(self) -> float:
        """Time of one sample per pixel by the clock, by the first render where it stands alone."""
        return self._warm_slope([view.seconds for view in self.views])

    @property
    def processor_seconds_per_sample(self) -> float:
        """The same by the processor."""
        return self._warm_slope(self.processor)

    def _warm_slope(self, seconds: Sequence[float]) -> float:
        warm = slice(1, None) if len(self.views) > 1 else slice(None)
        return slope(self.work[warm], seconds[warm])

    @property
    def clock(self) -> float:
        """Time by the clock over that by the processor, over all renders but the first."""
        return sum(view.seconds for view in self.views[1:]) / sum(self.processor[1:])

    @property
    def setup_seconds(self) -> float:
        """What the first render took beyond its samples."""
        return max(0.0, self.views[0].seconds - self.work[0] * self.seconds_per_sample)

    def pictures(self) -> Pieces:
        """All light, render by render."""
        return Pieces([view.picture for view in self.views], self.work)

    def displays(self) -> Pieces:
        """Light of displays and lamps, render by render."""
        return Pieces([view.display for view in self.views], self.work)


def division_of(device: DeviceScene, known: Division | None = None) -> Division:
    """Divide the picture of a device into passes.

    Args:
        device: The device in its scene.
        known: How that of a similar device is divided, which is taken over to save the pilot. The
            sum of the passes is the picture in any case, only its noise might be less.

    Returns:
        The passes of the device.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    if known is None or len(known.passes) == 1 or not is_divisible(device):
        return divided(device)
    return replace(known, passes=tuple(replace(each, device=device) for each in known.passes))


def slope(samples: Sequence[float], seconds: Sequence[float]) -> float:
    """Time of a sample: the slope of time over samples, where what is the same for all is left out.

    Args:
        samples: Samples per pixel of each render, at least one.
        seconds: Time of each.

    Returns:
        Slope of the straight line whose relative deviations are least, in seconds per sample. It
        starts at zero or above, and rises.
    """
    count = np.array(samples, dtype=np.float64)
    spent = np.array(seconds, dtype=np.float64)
    through_zero = float(np.sum(count / spent) / np.sum((count / spent) ** 2))
    if np.unique(count).size < 2:
        return through_zero
    rows: NDArray[np.float64] = np.stack([1.0 / spent, count / spent], axis=1)
    fixed, each = np.linalg.lstsq(rows, np.ones_like(spent))[0].tolist()
    return each if fixed >= 0.0 and each > 0.0 else through_zero
