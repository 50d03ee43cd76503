# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render that was asked for an error or a time has reached."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ...core.sampling_error import SamplingError
from ...model.quality import QualitySpec

type End = Literal["reached", "time", "samples", "stopped", "black"]
"""Why a render ended: the error is reached, the time is over, the most samples are taken, the user
stopped it, or the picture is black and has no relative error."""

END_WORDS: Mapping[End, str] = {
    "reached": "reached",
    "time": "the time is over",
    "samples": "the most samples are taken",
    "stopped": "stopped by the user",
    "black": "the picture is black",
}
"""The same in words."""


@dataclass(frozen=True)
class Reached:
    """What a render reached.

    Attributes:
        request: What was asked for.
        picture: Error of the picture, which is never denoised.
        png: Error of its denoised form; None where nothing was denoised.
        seconds: All the time taken, denoising counted.
        samples: Samples per pixel by pass.
        end: Why it ended.
        set_up: Seconds until the first samples of every pass were there, before which nothing ends.
        too_few: Whether the picture was to be denoised but had too few samples to judge that by.
    """

    request: QualitySpec
    picture: SamplingError
    png: SamplingError | None
    seconds: float
    samples: Mapping[str, int]
    end: End
    set_up: float = 0.0
    too_few: bool = False

    @property
    def denoising_helps(self) -> bool:
        """Whether the denoised picture is nearer to the truth than the picture itself."""
        return self.png is not None and self.png.error < self.picture.error

    def report(self) -> dict[str, Any]:
        """Give it for metrics.json.

        Returns:
            Plain data; null for an error that a black picture does not have.
        """
        shown = self.png if self.png is not None and self.denoising_helps else self.picture
        return {
            **_plain(self.picture),
            "confidence": self.picture.confidence,
            "seconds": round(self.seconds, 3),
            "set_up_seconds": round(self.set_up, 3),
            "samples": sum(self.samples.values()),
            "end": self.end,
            "png": {**_plain(shown), "denoised": self.denoising_helps},
        }


def _plain(error: SamplingError) -> dict[str, float | None]:
    """Numbers for JSON, which knows no infinity."""
    values = {"error": error.error, "upper": error.upper}
    return {name: value if math.isfinite(value) else None for name, value in values.items()}
