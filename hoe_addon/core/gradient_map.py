# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V over an element, for patterns that a shader cannot evaluate by a formula."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .arrays import BoolArray, FloatArray, as_float
from .errors import SpecError
from .map_filling import distance_from, filled
from .spline import Spline2D

type GradientFunction = Callable[[FloatArray], FloatArray]
"""From points ``(..., 3)`` in metres to grad V, ``(..., 3)``; NaN where nothing is recorded."""

type SagFunction = Callable[[ArrayLike, ArrayLike], FloatArray]
"""From x and y in metres to the height of the element; NaN outside its domain."""

type Progress = Callable[[float], None]
"""Told the share that is done, 0 to 1; it may raise `CancelledError` to stop the work."""

TOLERANCE = 1e-6
"""Interpolation error to reach, absolute in grad V; with float32 directions stay within 1e-5."""

LIMIT = 1e-5
"""Beside unrecorded places, what is worse than this counts as not recorded."""

SMALLEST, LARGEST = 32, 1024
"""Texels along a side."""

RECORDED_SHARE = 0.9999
"""Least weight of recorded texels at a recorded place. It is 1 where all 16 that count are; the
rest is for float32, and lets through no more than a ten-thousandth of the filling."""

_MIXED = 512
"""Least size where a part is not recorded: its border is lost by up to three texels."""

_BORDER = 6
"""Texels from an unrecorded one within which every cell is checked."""

_CHECKS = 48
"""Cells checked along a side elsewhere."""

_CHUNK = 32768
"""Points evaluated at once; between them progress is told."""

_THREADS = min(4, os.cpu_count() or 1)


@dataclass(frozen=True, eq=False)
class GradientMap:
    """Bicubic B-spline coefficients of grad V, and where it is recorded.

    Texel ``[j, i]`` belongs to the place ``origin + (i, j) * pitch``. The element ends one pitch
    inside the outer texels.

    Attributes:
        texels: Coefficients of the three components, then 1 for recorded or 0, shape
            ``(n, n, 4)``; what stands where nothing is recorded only continues the rest smoothly.
        origin: Place of ``texels[0, 0]``, metres.
        pitch: Distances of texels along x and y, metres.
        error: Largest interpolation error that was measured, absolute in grad V.
    """

    texels: FloatArray
    origin: tuple[float, float]
    pitch: tuple[float, float]
    error: float

    @property
    def extent(self) -> tuple[float, float]:
        """Width and height of all texels, each a pitch wide, metres."""
        rows, columns = self.texels.shape[:2]
        return columns * self.pitch[0], rows * self.pitch[1]

    @property
    def corner(self) -> tuple[float, float]:
        """Lower corner of the texel ``[0, 0]``, metres."""
        return self.origin[0] - 0.5 * self.pitch[0], self.origin[1] - 0.5 * self.pitch[1]

    def gradient(self, points: ArrayLike) -> FloatArray:
        """Return grad V by the map.

        Args:
            points: Points on the element, metres, shape ``(..., 3)``; z is not looked at.

        Returns:
            Shape ``(..., 3)``; NaN where nothing is recorded, and off the element.
        """
        places = as_float(points)
        value = Spline2D(self.texels, self.origin, self.pitch).value(places[..., 0], places[..., 1])
        recorded = value[..., 3] >= RECORDED_SHARE
        return np.where(recorded[..., None], value[..., :3], np.nan)


def bake(
    gradient: GradientFunction,
    sag: SagFunction,
    size: tuple[float, float],
    tolerance: float = TOLERANCE,
    largest: int = LARGEST,
    progress: Progress | None = None,
) -> GradientMap:
    """Make a map, with twice the texels each time until it is exact enough.

    The error is measured in the middle of cells, where a spline is worst: in all cells beside an
    unrecorded place, and in a grid of the others. Cells of the first kind above `LIMIT` become
    unrecorded, such as those at a caustic, where grad V bends without bound.

    Args:
        gradient: The pattern.
        sag: Height of the element.
        size: Width and height of its rectangle around the origin, metres, above 0.
        tolerance: Error to reach.
        largest: Texels along a side at which to stop, a power of two times `SMALLEST`.
        progress: Told the share of the work of the largest map.

    Returns:
        The map; `GradientMap.error` tells what was reached.

    Raises:
        SpecError: Nothing is recorded anywhere.
    """
    texels = SMALLEST
    while True:
        samples = _Sampling(gradient, sag, size, texels)
        told = _share_of(texels, largest, progress)
        found = _made(samples, told)
        if found is None and texels >= largest:
            places = f"{texels} x {texels} places"
            raise SpecError(f"recording: nothing is recorded at any of {places} of the element")
        if found is None:
            texels = max(2 * texels, min(_MIXED, largest))
            continue
        made, mixed = found
        if texels >= largest or (made.error <= tolerance and (texels >= _MIXED or not mixed)):
            if progress is not None:
                progress(1.0)
            return made
        texels = max(2 * texels, min(_MIXED, largest)) if mixed else 2 * texels


@dataclass(frozen=True)
class _Sampling:
    """The pattern over an element, and the grid to sample it on."""

    gradient: GradientFunction
    sag: SagFunction
    size: tuple[float, float]
    texels: int

    @property
    def nodes(self) -> int:
        """Samples along a side; the spline has one more coefficient beyond each end."""
        return self.texels - 2

    @property
    def origin(self) -> tuple[float, float]:
        return -0.5 * self.size[0], -0.5 * self.size[1]

    @property
    def pitch(self) -> tuple[float, float]:
        return self.size[0] / (self.nodes - 1), self.size[1] / (self.nodes - 1)

    def at(self, rows: FloatArray, columns: FloatArray, progress: Progress | None) -> FloatArray:
        """Return grad V at places counted in nodes, shape ``(N,)`` each."""
        x = self.origin[0] + columns * self.pitch[0]
        y = self.origin[1] + rows * self.pitch[1]
        points = np.stack((x, y, self.sag(x, y)), axis=-1)
        parts = [points[first : first + _CHUNK] for first in range(0, len(points), _CHUNK)]
        done: list[FloatArray] = [np.empty((0, 3))]
        # Numpy lets other threads run while it computes.
        with ThreadPoolExecutor(_THREADS) as pool:
            try:
                for part in pool.map(self._gradient, parts):
                    done.append(part)
                    if progress is not None:
                        progress((len(done) - 1) / len(parts))
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        return np.concatenate(done)

    def _gradient(self, points: FloatArray) -> FloatArray:
        on_element = np.isfinite(points).all(axis=-1, keepdims=True)
        return np.where(on_element, self.gradient(points), np.nan)


def _made(samples: _Sampling, progress: Progress | None) -> tuple[GradientMap, bool] | None:
    """Return the map of one size, and whether a part of it is not recorded; None if all is not."""
    count = samples.nodes
    row, column = (index.ravel().astype(np.float64) for index in np.indices((count, count)))
    values = samples.at(row, column, progress).reshape(count, count, 3)
    recorded = np.isfinite(values).all(axis=-1)
    if not recorded.any():
        return None
    spline = Spline2D.through(filled(values, recorded), samples.origin, samples.pitch)
    unchecked = _with_mask(spline, recorded)
    checked, error = _checked(samples, unchecked, recorded)
    made = _with_mask(spline, checked)
    return replace(made, error=error), not bool(recorded.all())


def _with_mask(spline: Spline2D, recorded: BoolArray) -> GradientMap:
    alpha = np.pad(recorded, 1, mode="edge").astype(np.float64)
    texels = np.concatenate((spline.coefficients, alpha[..., None]), axis=-1)
    return GradientMap(texels, spline.origin, spline.pitch, 0.0)


def _checked(samples: _Sampling, made: GradientMap, recorded: BoolArray) -> tuple[BoolArray, float]:
    """Return the mask without what is wrong beside its border, and the largest error elsewhere."""
    cells = len(recorded) - 1
    near = distance_from(~recorded, _BORDER) < _BORDER
    near = near[:-1, :-1] | near[1:, :-1] | near[:-1, 1:] | near[1:, 1:]
    stride = max(1, cells // _CHECKS)
    wanted = near.copy()
    wanted[stride // 2 :: stride, stride // 2 :: stride] = True
    row, column = (as_float(index) for index in np.nonzero(wanted))
    x = samples.origin[0] + (column + 0.5) * samples.pitch[0]
    y = samples.origin[1] + (row + 0.5) * samples.pitch[1]
    by_map = made.gradient(np.stack((x, y, np.zeros_like(x)), axis=-1))
    counts = np.isfinite(by_map).all(axis=-1)
    row, column, by_map = row[counts], column[counts], by_map[counts]
    exact = samples.at(row + 0.5, column + 0.5, None)
    # A place that is recorded in the map alone is as wrong as can be.
    error = np.nan_to_num(np.abs(by_map - exact).max(axis=-1), nan=np.inf)
    cell = row.astype(np.int64), column.astype(np.int64)
    bad = near[cell] & (error > LIMIT)
    checked = recorded.copy()
    for j in (0, 1):
        for i in (0, 1):
            checked[cell[0][bad] + j, cell[1][bad] + i] = False
    return checked, float(error[~bad].max(initial=0.0))


def _share_of(texels: int, largest: int, progress: Progress | None) -> Progress | None:
    """Return a progress of one size, from that of all sizes up to the largest."""
    if progress is None:
        return None
    # The sizes before this one have a third of its texels.
    whole, own = 4.0 / 3.0 * largest**2, float(texels**2)
    return lambda share: progress(min(1.0, (own / 3.0 + share * own) / whole))
