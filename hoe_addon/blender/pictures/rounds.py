# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A number of samples in rounds, so that there is a whole picture whenever the user stops it."""

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...core.errors import CancelledError
from ..build.device import DeviceScene
from .division import Division, divided
from .passes import DISPLAY_LAYER
from .render import COMBINED, Progress
from .render_settings import picture_size
from .view import View

type Layers = dict[str, NDArray[np.float64]]

_ROUNDS = 8
_LEAST_PATHS = 3_000_000
"""With fewer camera paths a picture is done in seconds: rounds would cost more than they keep."""


def render_in_rounds(
    device: DeviceScene, progress: Progress, stopped: Callable[[], bool]
) -> tuple[View, bool]:
    """Render the samples of the scene, all passes a part of theirs in turn.

    The rounds take one stratified sequence after another part of it: together they are the picture
    of one long render, but for rounding.

    Args:
        device: The device in its scene; its samples are then those that were taken.
        progress: Told the share of the work that is done; may raise CancelledError.
        stopped: Asked after each round whether to end with the picture so far.

    Returns:
        The view, and whether it was ended early.

    Raises:
        RenderError: Blender gave no usable picture.
        CancelledError: It was stopped before the first round was done.
    """
    started, cycles = time.perf_counter(), device.scene.cycles
    division = divided(device, cycles.samples)
    counts = division.counts(cycles.samples)
    rounds = _rounds(device, counts)
    sums: list[Layers] = [{} for _ in counts]
    done, early = 0, False
    for number in range(rounds):
        try:
            _add_round(division, counts, (number, rounds), sums, cycles.seed, progress)
        except CancelledError:
            if not done:
                raise
            early = True
            break
        done = number + 1
        early = done < rounds and stopped()
        if early:
            break
    taken = [count * done // rounds for count in counts]
    names = (each.name for each in division.passes)
    layers = {layer: _mean(sums, layer, taken) for layer in (COMBINED, DISPLAY_LAYER)}
    cycles.samples = cycles.samples * done // rounds
    seconds = time.perf_counter() - started
    samples = dict(zip(names, taken, strict=True))
    return View(layers[COMBINED], layers[DISPLAY_LAYER], seconds, samples=samples), early


def _rounds(device: DeviceScene, counts: tuple[int, ...]) -> int:
    width, height = picture_size(device.scene)
    paths = width * height * sum(counts)
    return 1 if paths < _LEAST_PATHS else min(_ROUNDS, *counts)


def _add_round(
    division: Division,
    counts: tuple[int, ...],
    part: tuple[int, int],
    sums: list[Layers],
    seed: int,
    progress: Progress,
) -> None:
    """Render one round of all passes; the sums change only when it is whole."""
    number, rounds = part
    found: list[Layers] = []
    for place, (each, count) in enumerate(zip(division.passes, counts, strict=True)):
        first, end = (count * step // rounds for step in (number, number + 1))
        before = (number + place / len(counts)) / rounds
        own = 1.0 / (rounds * len(counts))
        layers = each.render(
            seed, first, end - first, lambda done, at=before, of=own: progress(at + of * done)
        )
        found.append({layer: pixels * (end - first) for layer, pixels in layers.items()})
    for total, new in zip(sums, found, strict=True):
        for layer, pixels in new.items():
            total[layer] = total.get(layer, 0.0) + pixels


def _mean(sums: list[Layers], layer: str, taken: list[int]) -> NDArray[np.float32]:
    means = [total[layer] / count for total, count in zip(sums, taken, strict=True)]
    return np.sum(means, axis=0).astype(np.float32)
