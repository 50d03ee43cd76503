# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two independent halves of a picture that grow: what they hold, and what a sample costs."""

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...core.photometry import luminance
from ...core.sampling_error import Halves
from ..kept import changed
from .render import COMBINED

SEQUENCE = 4096
"""Samples of one stratified sequence. Cycles gives every pixel a section of this length of one
long sequence of 2^32 samples; longer sections would be shared by pixels of an ordinary picture."""

_SEED_OF_SECOND = 0x5BD1E995
"""Far from all seeds that users try one after the other."""

_SEED_OF_NEXT_SEQUENCE = 0x632BE5AB
_SEEDS = 2**31

_LEAST_COST = 1e-9
"""Seconds of a sample, should the clock say that it takes none."""


@contextmanager
def one_sequence(cycles: Any) -> Iterator[None]:
    """Let all parts inside take their samples from sequences of one length.

    Args:
        cycles: Cycles' settings of the scene.

    Yields:
        Nothing.
    """
    with changed((cycles, {"samples": SEQUENCE})):
        yield


class RenderPass(Protocol):
    """One term of the sum that is the picture; it can render more samples of itself."""

    @property
    def name(self) -> str:
        """What it shows, in a word."""
        ...

    def render(self, seed: int, first: int, count: int) -> Mapping[str, NDArray[np.floating]]:
        """Mean of some samples by layer, shape ``(height, width, 3)``, top row first."""
        ...


class Cost:
    """Seconds of a part of a render: some for its start, some for every sample."""

    def __init__(self) -> None:
        """Begin without any part."""
        self._parts: list[tuple[int, float]] = []

    def add(self, samples: int, seconds: float) -> None:
        """Take note of a part."""
        self._parts.append((samples, seconds))

    @property
    def line(self) -> tuple[float, float]:
        """Seconds of the start, and seconds of one sample, above 0."""
        # The first part also compiles the shaders.
        parts = self._parts[1:] or self._parts
        samples, seconds = np.transpose(np.asarray(parts, dtype=np.float64))
        spread = samples - samples.mean()
        if not spread.any():
            # Which part is the start cannot be told yet; half is a fair guess.
            half = 0.5 * float(seconds.mean())
            return half, max(half / float(samples[0]), _LEAST_COST)
        slope = float(spread @ seconds / (spread @ spread))
        slope = float(np.clip(slope, _LEAST_COST, (seconds / samples).max()))
        return max(float((seconds - slope * samples).mean()), 0.0), slope

    def seconds(self, samples: int) -> float:
        """Expected seconds of a part."""
        start, one = self.line
        return start + one * samples

    def samples_within(self, seconds: float) -> int:
        """Most samples of a part that ends in time; 0 if there is no time for any."""
        start, one = self.line
        return max(int((seconds - start) / one), 0)


class PassHalves:
    """Both halves of one pass.

    Attributes:
        source: The pass.
        samples: Samples per pixel of each half.
        cost: What a part of it costs.
    """

    def __init__(self, source: RenderPass, seed: int) -> None:
        """Begin without samples.

        Args:
            source: The pass.
            seed: Seed of the picture.
        """
        self.source = source
        self.samples = 0
        self.cost = Cost()
        self._seeds = (seed, seed ^ _SEED_OF_SECOND)
        self._means: tuple[dict[str, NDArray[np.float64]], ...] = ({}, {})

    def grow(self, count: int) -> None:
        """Add samples to both halves; nothing is added if the render is stopped between them.

        Args:
            count: Samples of each half, at least 1, at most to the end of a sequence.
        """
        parts = [self._part(seed, count) for seed in self._seeds]
        whole = self.samples + count
        for mean, part in zip(self._means, parts, strict=True):
            for layer, pixels in part.items():
                kept = mean.get(layer, 0.0)
                mean[layer] = (kept * self.samples + pixels.astype(np.float64) * count) / whole
        self.samples = whole

    def left_in_sequence(self) -> int:
        """Samples that one call of ``grow`` may add."""
        return SEQUENCE - self.samples % SEQUENCE

    def layer(self, name: str, half: int) -> NDArray[np.float64]:
        """One layer of the first (0) or the second (1) half."""
        return self._means[half][name]

    def luminances(self) -> Halves:
        """Luminance of the halves, 1 for white."""
        return Halves(*(luminance(self.layer(COMBINED, half), 1.0) for half in (0, 1)))

    def _part(self, seed: int, count: int) -> Mapping[str, NDArray[np.floating]]:
        sequence, first = divmod(self.samples, SEQUENCE)
        started = time.perf_counter()
        own = (seed + sequence * _SEED_OF_NEXT_SEQUENCE) % _SEEDS
        part = self.source.render(own, first, count)
        self.cost.add(count, time.perf_counter() - started)
        return part
