# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of each variant of a device, and the reference that judges it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import BoolArray, FloatArray
from ...core.errors import SpecError
from ...core.picture_error import (
    ENOUGH,
    Estimate,
    Reference,
    colour_difference,
    luminance_error,
    reference_of,
    worst_region,
)
from ...core.picture_pieces import Pieces
from .knobs import NotMeasured, Variant


@dataclass(frozen=True)
class Point:
    """One picture of a variant.

    Attributes:
        samples: Samples per pixel.
        seconds: Time to render it, without scene set-up; with the denoiser's where it is used.
        error: Relative RMS error of luminance over the field.
        display_error: The same of the light of displays and lamps alone; None where there is none.
        worst_region: Worst-region bias.
        colour: Mean difference in u'v' over the regions.
        limited: Names of those that are not three times larger than the reference's own error.
    """

    samples: int
    seconds: float
    error: Estimate
    display_error: Estimate | None
    worst_region: Estimate
    colour: Estimate
    limited: tuple[str, ...]


@dataclass(frozen=True)
class Lasting:
    """What all samples of a variant say together, told apart: bias, and how fast noise falls.

    Attributes:
        error: Relative RMS error of luminance that more samples would not take away.
        worst_region: Worst-region bias.
        colour: Mean difference in u'v' over the regions.
        noise: Variance of the luminance of one sample, over the squared mean of the field.
        display_noise: The same of the light of displays and lamps alone; None where there is none.
    """

    error: Estimate
    worst_region: Estimate
    colour: Estimate
    noise: float
    display_noise: float | None


@dataclass(frozen=True, eq=False)
class Run:
    """All that is measured of one variant.

    Attributes:
        variant: What was measured.
        build_seconds: Time to build the scene.
        setup_seconds: Time of the first render beyond that of its samples.
        seconds_per_sample: Time of one sample per pixel: processor time, by the ratio of clock to
            processor of the reference, so that other work on the machine tells on all runs alike.
        processor_seconds_per_sample: Processor time of it, all threads together.
        time_error: Relative standard error of these two.
        too_short_to_time: Whether it is so large that they are not to be compared.
        finish_seconds: Time of the denoiser for one picture.
        points: Its pictures, the fewest samples first.
        lasting: What all samples say together; None for denoised pictures, whose errors are not
            those of their samples.
        sharpness: Modulation transfer at 5 cycles per degree; None where it is not measured.
        picture: The picture of the most samples.
    """

    variant: Variant
    build_seconds: float
    setup_seconds: float
    seconds_per_sample: float
    processor_seconds_per_sample: float
    time_error: float
    too_short_to_time: bool
    finish_seconds: float
    points: tuple[Point, ...]
    lasting: Lasting | None
    sharpness: Estimate | None
    picture: NDArray[np.floating]


@dataclass(frozen=True)
class Spent:
    """Time by the clock that a measurement took, set-up of scenes included, in seconds.

    Attributes:
        reference: For the reference.
        first: For the device as it is.
        others: For all other settings.
    """

    reference: float
    first: float
    others: float

    @property
    def total(self) -> float:
        """All together."""
        return self.reference + self.first + self.others


@dataclass(frozen=True, eq=False)
class Accuracy:
    """What accuracy costs on one device.

    Attributes:
        judge: The reference.
        reference_seconds: Time of its samples.
        reference_samples: Samples per pixel of it.
        reference_sharpness: Its modulation transfer at 5 cycles per degree, where measured.
        clock: Time of a sample by the clock over that by the processor, by the reference.
        why_no_sharpness: Why that is not measured; empty where it is.
        runs: Results, the device as it is first.
        not_measured: Settings without a result.
        stopped: Whether the user stopped before all was measured.
        spent: Time that it took.
    """

    judge: "Judge"
    reference_seconds: float
    reference_samples: float
    reference_sharpness: Estimate | None
    clock: float
    why_no_sharpness: str
    runs: tuple[Run, ...]
    not_measured: tuple[NotMeasured, ...]
    stopped: bool
    spent: Spent


class Judge:
    """The reference, for all light and for that of displays and lamps."""

    def __init__(self, pictures: Pieces, displays: Pieces, field: BoolArray) -> None:
        """Make it of independent renders that come in equal pairs.

        Args:
            pictures: All light, render by render.
            displays: Light of displays and lamps, render by render.
            field: Pixels that count.

        Raises:
            SpecError: All is black.
        """
        self.whole = reference_of(pictures, field)
        try:
            self.display: Reference | None = reference_of(displays, self.whole.field)
        except SpecError:
            self.display = None
        self.own_errors = {
            "error": self.whole.own_error(),
            "display_error": self.display.own_error() if self.display else 0.0,
            "worst_region": self.whole.own_region_error(),
            "colour": self.whole.own_colour_error(),
        }

    def point(
        self,
        samples: int,
        work: float,
        seconds: float,
        picture: NDArray[np.floating],
        display: NDArray[np.floating],
        sample_variance: FloatArray,
    ) -> Point:
        """Judge one picture.

        Args:
            samples: Samples per pixel that were asked for.
            work: Samples per pixel of all passes together.
            seconds: Time that it took.
            picture: All light.
            display: Light of displays and lamps.
            sample_variance: Variance of the luminance of one sample in each pixel.

        Returns:
            What is found.
        """
        values: dict[str, Estimate | None] = {
            "error": luminance_error(picture, self.whole),
            "display_error": None,
            "worst_region": worst_region(picture, sample_variance / work, self.whole),
            "colour": colour_difference(picture, self.whole.picture, self.whole),
        }
        if self.display is not None:
            values["display_error"] = luminance_error(display, self.display)
        limited = tuple(
            name
            for name, found in values.items()
            if found is not None and found.value < ENOUGH * self.own_errors[name]
        )
        return Point(samples, seconds, **values, limited=limited)  # type: ignore[arg-type]

    def lasting(self, pictures: Pieces, displays: Pieces) -> Lasting:
        """Tell bias and noise apart.

        Args:
            pictures: All light of a variant, render by render.
            displays: Light of displays and lamps, render by render.

        Returns:
            What is found.
        """
        noise = pictures.sample_variance() / pictures.total
        mean = pictures.mean()
        both = replace(self.whole, variance=self.whole.variance + noise)
        light = relative_noise(displays, self.display) if self.display is not None else None
        return Lasting(
            error=luminance_error(mean, both),
            worst_region=worst_region(mean, noise, self.whole),
            colour=colour_difference(mean, self.whole.picture, self.whole),
            noise=relative_noise(pictures, self.whole),
            display_noise=light,
        )


def relative_noise(pieces: Pieces, reference: Reference) -> float:
    """Variance of the luminance of one sample over the field, relative.

    Args:
        pieces: Renders of a variant.
        reference: Where the field is, and how bright it is on average.

    Returns:
        Mean variance over the squared mean of the reference.
    """
    return float(np.mean(pieces.sample_variance()[reference.field])) / reference.mean**2
