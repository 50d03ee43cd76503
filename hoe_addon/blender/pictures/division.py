# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a picture is best divided into passes: found out by a small pilot of the same scene.

The same scene and seed give the same division: it looks at variances, never at a clock. A sample
of a pixel is taken to cost the same in all passes, which measured right to a fifth.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...core.colour import LUMINANCE_WEIGHTS
from ...model.device import LightGuideSpec
from ...model.field import field_mask
from ..build.device import DeviceScene
from ..kept import changed
from .passes import FirstOrders, Pass, is_divisible, whole
from .render import COMBINED, Progress, Region
from .render_settings import picture_size, size_settings

_LEAST_PATHS = 1_500_000
"""A shorter render is done before a pilot has paid."""

_PILOT_WIDTH = 64
_LEAST_SIDE = 8
_FEW, _MANY = 4, 12
_PILOT_SEED = 0x5EED

_LEAST_GAIN = 1.15
"""A division that promises less is not worth its set-up."""

_DIFFRACTED_SHARE = 0.1
"""What the diffracted pass counts of light that meets no hologram first. Its samples there are
mostly lost, but never all, and the weights of the others stay below 10."""

_OUTSIDE = 1.0 / 9.0
"""Share of the samples of a divided pass that go to the whole picture, inside its region too."""

_BLOCK = 4
_DIM = 0.02
"""Blocks of the pilot with less of the largest variance than that lie outside a region."""

_LARGEST_REGION = 0.7
_LEAST_SAMPLES = 4


@dataclass(frozen=True, eq=False)
class Division:
    """A picture as a sum of passes.

    Attributes:
        passes: The terms.
        fractions: Samples of each, over those of a picture in one pass that takes as long.
        gain: What the pilot promises: variance of one pass over that of the sum, at equal cost.
    """

    passes: tuple[Pass, ...]
    fractions: tuple[float, ...]
    gain: float

    def counts(self, samples: int) -> tuple[int, ...]:
        """Samples of each pass, for the time that so many of the whole picture take."""
        if len(self.passes) == 1:
            return (samples,)
        return tuple(max(_LEAST_SAMPLES, round(samples * share)) for share in self.fractions)

    def render(
        self, seed: int, samples: int, progress: Progress | None = None
    ) -> tuple[dict[str, NDArray[np.float32]], dict[str, int]]:
        """Render all passes.

        Args:
            seed: Seed of the picture.
            samples: Samples per pixel of the whole picture whose time may be taken.
            progress: Told the share of the work that is done.

        Returns:
            Scene-linear values by layer, shape ``(height, width, 3)``, and the samples by pass.

        Raises:
            RenderError: Blender gave no usable picture.
            CancelledError: The progress function asked to stop.
        """
        counts = self.counts(samples)
        work = [count * each.pixels for each, count in zip(self.passes, counts, strict=True)]
        sums: dict[str, NDArray[np.float64]] = {}
        for place, (each, count) in enumerate(zip(self.passes, counts, strict=True)):
            told = _share_of(progress, sum(work[:place]), work[place], sum(work))
            for layer, pixels in each.render(seed, 0, count, told).items():
                sums[layer] = sums.get(layer, 0.0) + pixels
        layers = {layer: pixels.astype(np.float32) for layer, pixels in sums.items()}
        names = (each.name for each in self.passes)
        return layers, dict(zip(names, counts, strict=True))


def _share_of(progress: Progress | None, before: int, own: int, total: int) -> Progress | None:
    if progress is None:
        return None
    return lambda done: progress((before + own * done) / total)


def divided(device: DeviceScene, samples: int | None = None) -> Division:
    """Divide a picture into passes.

    Args:
        device: The device in its scene.
        samples: Samples per pixel that are wanted; with few the picture stays whole. None is many.

    Returns:
        The passes; one where nothing is to be gained.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    one = Division((whole(device),), (1.0,), 1.0)
    width, height = picture_size(device.scene)
    short = samples is not None and width * height * samples < _LEAST_PATHS
    if short or not is_divisible(device):
        return one
    straight = Pass(device, "straight", FirstOrders.STRAIGHT, 1, 1.0 - _DIFFRACTED_SHARE, stream=1)
    diffracted = Pass(device, "diffracted", FirstOrders.DIFFRACTED, 2, _DIFFRACTED_SHARE, stream=2)
    with changed((device.scene.render, size_settings(*_pilot_size((width, height))))):
        undivided, first, second = (
            _variance(each) for each in (whole(device), straight, diffracted)
        )
        counted = _counted(device, first.shape)
    region = _region(device, second * counted)
    passes, terms = _terms(straight, diffracted, region, (first, second), counted)
    return _chosen(one, passes, terms, float(np.mean(undivided[counted])))


def _terms(
    straight: Pass,
    diffracted: Pass,
    region: Region | None,
    variance: tuple[NDArray[np.float64], NDArray[np.float64]],
    counted: NDArray[np.bool_],
) -> tuple[tuple[Pass, ...], list[tuple[float, float]]]:
    """The passes, and variance and relative cost of a sample of each."""
    first, second = (float(np.mean(each[counted])) for each in variance)
    if region is None:
        return (straight, diffracted), [(first, 1.0), (second, 1.0)]
    all_over = replace(diffracted, weight=_OUTSIDE, inside=region)
    inside = replace(
        diffracted,
        name="diffracted, region",
        region=region,
        weight=1.0 - _OUTSIDE,
        inside=region,
        stream=3,
    )
    cost = region.pixels / straight.pixels
    return (straight, all_over, inside), [
        (first, 1.0),
        (second * _OUTSIDE**2, 1.0),
        (second * (1.0 - _OUTSIDE) ** 2, cost),
    ]


def _chosen(
    one: Division,
    passes: tuple[Pass, ...],
    terms: Sequence[tuple[float, float]],
    undivided: float,
) -> Division:
    """The division, with Neyman's samples for each term, or the whole where it gains too little."""
    effort = sum(math.sqrt(variance * cost) for variance, cost in terms) ** 2
    if not undivided > _LEAST_GAIN * effort > 0.0:
        return one
    rates = [math.sqrt(variance / cost) for variance, cost in terms]
    scale = sum(rate * cost for rate, (_, cost) in zip(rates, terms, strict=True))
    return Division(passes, tuple(rate / scale for rate in rates), undivided / effort)


def _variance(this: Pass) -> NDArray[np.float64]:
    """Variance of the luminance of one sample, by pixel."""
    pictures = [
        this.render(_PILOT_SEED + number, 0, count)[COMBINED] @ LUMINANCE_WEIGHTS
        for number, count in enumerate((_FEW, _MANY))
    ]
    return (pictures[0] - pictures[1]) ** 2 / (1.0 / _FEW + 1.0 / _MANY)


def _pilot_size(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height of the pilot of a picture."""
    scale = min(1.0, _PILOT_WIDTH / size[0])
    width, height = (max(_LEAST_SIDE, round(side * scale)) for side in size)
    return width, height


def _counted(device: DeviceScene, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Pixels whose error counts: the display's field, or all where there is none."""
    height, width = shape
    if isinstance(device.spec, LightGuideSpec):
        mask = field_mask(device.spec, width, height)
        if mask.any():
            return mask
    return np.ones((height, width), dtype=np.bool_)


def _region(device: DeviceScene, variance: NDArray[np.float64]) -> Region | None:
    """Where a pass has its noise, in pixels of the full picture; None is all over."""
    height, width = variance.shape
    rows, columns = -(-height // _BLOCK), -(-width // _BLOCK)
    padded = np.zeros((rows * _BLOCK, columns * _BLOCK))
    padded[:height, :width] = variance
    blocks = padded.reshape(rows, _BLOCK, columns, _BLOCK).mean(axis=(1, 3))
    if not blocks.max() > 0.0:
        return None
    bright = np.argwhere(blocks > _DIM * blocks.max())
    # One block more on each side: the pilot is coarse and noisy.
    top, left = np.maximum(bright.min(axis=0) - 1, 0) * _BLOCK
    bottom, right = np.minimum((bright.max(axis=0) + 2) * _BLOCK, (height, width))
    full_width, full_height = picture_size(device.scene)
    x, y = full_width / width, full_height / height
    region = Region(
        math.floor(left * x),
        math.floor(top * y),
        min(full_width, math.ceil(right * x)),
        min(full_height, math.ceil(bottom * y)),
    )
    small = region.pixels < _LARGEST_REGION * full_width * full_height
    return region if small else None
