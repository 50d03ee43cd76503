# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything simulated, and only what the plan finds needful: same picture, and how soon.

Every device is built twice, and rendered small, with several seeds. The time to a given error goes
as the time of a sample times its variance; the ratio of that is what the plan gains. The variance
is that of the luminance, by the scatter of pictures of different seeds. Times are processor time,
the slope between few and many samples, so that set-up is left out.

The two mean pictures are compared in squares of pixels, by the scatter of the same seeds.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from ...core.colour import LUMINANCE_WEIGHTS
from ...model.device import DeviceSpec
from ...model.document import find_device, load_device
from ...model.effects import EffectPlan
from ...resources import preset_paths
from ..build.device import DeviceScene, build_device
from ..pictures.render import COMBINED, Progress, render_layers
from ..temporary import temporary_scene

EVERYTHING = ("all",)
"""The setting of ``render.effects`` that leaves nothing out."""

_SIZE = (64, 48)
_BLOCK = 8
"""Pixels of a side of the squares whose means are compared."""

_NOISIEST = 0.003
"""Share of the pixels whose variance does not count."""

_SAMPLES, _SEEDS = 16, 6
_FEW, _MANY, _TIMED = 4, 36, 3


@dataclass(frozen=True, eq=False)
class Series:
    """Some pictures that differ by their seed alone.

    Attributes:
        rgb: Scene-linear, shape ``(seeds, height, width, 3)``.
        samples: Samples of a pixel of each.
        plan: What was simulated.
    """

    rgb: NDArray[np.float64]
    samples: int
    plan: EffectPlan

    @property
    def luminance(self) -> NDArray[np.float64]:
        """Luminance, shape ``(seeds, height, width)``."""
        return self.rgb @ LUMINANCE_WEIGHTS

    @property
    def mean(self) -> float:
        """Mean over all pixels and pictures."""
        return float(self.luminance.mean())

    @property
    def variance(self) -> float:
        """Variance of one sample of a pixel, on average, in units of the mean squared.

        The noisiest pixels are left out: a rare path to a small bright light, which all renders
        have alike, would else decide.
        """
        scatter = np.sort(np.var(self.luminance, axis=0, ddof=1).ravel())
        kept = scatter[: round(scatter.size * (1.0 - _NOISIEST))]
        return float(kept.mean()) * self.samples / self.mean**2

    def blocks(self) -> NDArray[np.float64]:
        """Means of squares of pixels, shape ``(seeds, rows, columns, 3)``."""
        seeds, height, width, channels = self.rgb.shape
        cells = (seeds, height // _BLOCK, _BLOCK, width // _BLOCK, _BLOCK, channels)
        return self.rgb.reshape(cells).mean(axis=(2, 4))


@dataclass(frozen=True)
class Likeness:
    """How far two series are from each other.

    Attributes:
        sigmas: Difference of the means of both, by its own standard deviation.
        blocks: Root mean square of the differences of squares, each by the standard deviation of
            all; about 1 where the pictures are alike.
        colours: The same for red, green and blue.
        error: Relative RMS difference of squares beyond their noise; 0 where there is none.
        error_noise: Relative RMS difference that the noise alone would give.
    """

    sigmas: float
    blocks: float
    colours: float
    error: float
    error_noise: float


@dataclass(frozen=True)
class EffectSpeed:
    """What the plan of one device gains.

    Attributes:
        device: Its name.
        microseconds: Processor time of a sample with everything, and with the plan.
        variance: Variance of a sample's luminance over the mean squared, likewise.
        speed_up: Time to a given error with everything over that with the plan.
        sigmas: Difference of the mean luminance by its standard deviation.
        blocks: The same for squares of pixels, root mean square; about 1 where both are alike.
        left_out: Effects that the plan leaves out, each with the name of its hologram.
        promise: Relative error that the plan promises to stay below.
    """

    device: str
    microseconds: tuple[float, float]
    variance: tuple[float, float]
    speed_up: float
    sigmas: float
    blocks: float
    left_out: tuple[str, ...]
    promise: float


def measure_effects(
    names: Sequence[str] = (), progress: Progress | None = None
) -> tuple[EffectSpeed, ...]:
    """Measure what the plan gains.

    Args:
        names: Presets or files; by default all presets.
        progress: Told the share that is done.

    Returns:
        One result for each.

    Raises:
        HoeError: A device cannot be built or rendered.
    """
    listed = tuple(names) or tuple(preset_paths())
    results: list[EffectSpeed] = []
    for name in listed:
        results.append(_measured(name))
        if progress is not None:
            progress(len(results) / len(listed))
    return tuple(results)


def compare(first: Series, second: Series) -> Likeness:
    """Compare two series of independent seeds.

    Args:
        first: The one that is right.
        second: The other.

    Returns:
        Their difference, and what of it is noise.
    """
    colours = [each.blocks() for each in (first, second)]
    one, other = (each @ LUMINANCE_WEIGHTS for each in colours)
    whole = [each.mean(axis=(1, 2)) for each in (one, other)]
    apart = float(whole[1].mean() - whole[0].mean())
    spread = math.sqrt(sum(float(np.var(each, ddof=1)) / len(each) for each in whole))
    difference, noise = _apart(one, other)
    channels = [_apart(*(each[..., channel] for each in colours)) for channel in range(3)]
    return Likeness(
        sigmas=apart / spread,
        blocks=math.sqrt(difference / noise),
        colours=math.sqrt(float(np.mean([found / chance for found, chance in channels]))),
        error=math.sqrt(max(difference - noise, 0.0)) / first.mean,
        error_noise=math.sqrt(noise) / first.mean,
    )


def _apart(one: NDArray[np.float64], other: NDArray[np.float64]) -> tuple[float, float]:
    """Mean squared difference of the mean squares, and what of it noise alone would give."""
    difference = float(np.mean((other.mean(axis=0) - one.mean(axis=0)) ** 2))
    # One scatter for all squares: that of single ones is known from a few seeds only.
    noise = sum(float(np.mean(np.var(each, axis=0, ddof=1))) / len(each) for each in (one, other))
    return difference, noise


def series(
    spec: DeviceSpec,
    folder: Path,
    seeds: Sequence[int],
    samples: int = _SAMPLES,
    plan: EffectPlan | None = None,
) -> Series:
    """Render one device with several seeds.

    Args:
        spec: The device; width and height of its picture are multiples of 8 pixels.
        folder: Folder that image files are relative to.
        seeds: Seeds, at least two.
        samples: Samples per pixel.
        plan: Which effects are built; by default what ``plan_effects`` finds.

    Returns:
        The pictures.
    """
    with temporary_scene("hoe effects") as scene:
        return _pictures(build_device(scene, spec, folder, plan), seeds, samples)


def with_everything(spec: DeviceSpec) -> DeviceSpec:
    """The same document, with a plan that leaves nothing out."""
    return structs.replace(spec, render=structs.replace(spec.render, effects=EVERYTHING))


def _measured(name: str) -> EffectSpeed:
    spec, folder = _small(load_device(name)), find_device(name).parent
    times: list[float] = []
    found: list[Series] = []
    for place, each in enumerate((with_everything(spec), spec)):
        with temporary_scene("hoe effects") as scene:
            device = build_device(scene, each, folder)
            seeds = range(1 + place * _SEEDS, 1 + (1 + place) * _SEEDS)
            found.append(_pictures(device, seeds, _SAMPLES))
            times.append(1e6 * _seconds_per_sample(device))
    everything, planned = found
    alike = compare(everything, planned)
    gain = times[0] * everything.variance / (times[1] * planned.variance)
    return EffectSpeed(
        device=spec.name,
        microseconds=(times[0], times[1]),
        variance=(everything.variance, planned.variance),
        speed_up=gain,
        sigmas=alike.sigmas,
        blocks=alike.blocks,
        left_out=tuple(
            f"{each.hologram}:{each.effect}" if each.hologram else str(each.effect)
            for each in planned.plan.left_out
            if each.present
        ),
        promise=planned.plan.promise,
    )


def _small(spec: DeviceSpec) -> DeviceSpec:
    return structs.replace(spec, render=structs.replace(spec.render, size=_SIZE))


def _pictures(device: DeviceScene, seeds: Sequence[int], samples: int) -> Series:
    # Only seed and samples change between the renders: the scene is prepared once.
    device.scene.render.use_persistent_data = True
    pictures = [_picture(device.scene, seed, samples) for seed in seeds]
    return Series(np.stack(pictures), samples, device.plan)


def _picture(scene: bpy.types.Scene, seed: int, samples: int) -> NDArray[np.float64]:
    scene.cycles.seed, scene.cycles.samples = seed, samples
    return render_layers(scene, (COMBINED,))[COMBINED].astype(np.float64)


def _seconds_per_sample(device: DeviceScene) -> float:
    """Processor time of one sample, the median of several slopes."""
    slopes: list[float] = []
    for _ in range(_TIMED):
        spent: list[float] = []
        for samples in (_FEW, _MANY):
            start = time.process_time()
            _picture(device.scene, 0, samples)
            spent.append(time.process_time() - start)
        slopes.append(spent[1] - spent[0])
    # Below a hundredth of a second set-up varies more than the renders do.
    return max(float(np.median(slopes)), 1e-2) / (_SIZE[0] * _SIZE[1] * (_MANY - _FEW))
