# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uniform bicubic B-splines: smooth functions through samples on a grid."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .arrays import BoolArray, FloatArray, IntArray, as_float
from .errors import SpecError

MINIMUM_SAMPLES = 4
"""Fewest samples along an axis; four are needed for a cubic."""


@dataclass(frozen=True, eq=False)
class Spline2D:
    """A uniform bicubic B-spline, of one or more channels.

    The basis function of ``coefficients[j, i]`` is centred at ``origin + (i, j) * pitch``. The
    spline is defined where all 16 coefficients are there: one pitch inside the outer centres.

    Attributes:
        coefficients: Shape ``(ny, nx, *channels)``, at least 4 along each of the two axes.
        origin: Place ``(x, y)`` of ``coefficients[0, 0]``, metres.
        pitch: Distances of the centres along x and y, metres, above 0.

    References:
        Unser (1999), "Splines: a perfect fit for signal and image processing", IEEE Signal
        Process. Mag. 16(6), 22-38, doi:10.1109/79.799930.
    """

    coefficients: FloatArray
    origin: tuple[float, float]
    pitch: tuple[float, float]

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "coefficients", as_float(self.coefficients))
        _check_grid("coefficients", self.coefficients, self.origin, self.pitch)

    @classmethod
    def through(
        cls, samples: ArrayLike, origin: tuple[float, float], pitch: tuple[float, float]
    ) -> "Spline2D":
        """Return the spline that passes through samples; its domain is their rectangle.

        The ends are "not-a-knot": a bicubic polynomial comes back exactly, and the error of a
        smooth function falls with the fourth power of the pitch up to the border.

        Args:
            samples: Finite values, shape ``(ny, nx, *channels)``, at least 4 along each axis.
            origin: Place ``(x, y)`` of ``samples[0, 0]``, metres.
            pitch: Distances of the samples along x and y, metres, above 0.

        Returns:
            The spline, with one more row or column of coefficients on each side.

        Raises:
            SpecError: Too few samples, a value that is not finite, or a pitch of 0 or below.
        """
        values = as_float(samples)
        _check_grid("samples", values, origin, pitch)
        along_y = _prefilter(values)
        both = np.moveaxis(_prefilter(np.moveaxis(along_y, 1, 0)), 0, 1)
        return cls(
            np.ascontiguousarray(both),
            (float(origin[0]) - float(pitch[0]), float(origin[1]) - float(pitch[1])),
            (float(pitch[0]), float(pitch[1])),
        )

    @property
    def lower(self) -> tuple[float, float]:
        """Corner ``(x, y)`` of the domain, metres."""
        return (self.origin[0] + self.pitch[0], self.origin[1] + self.pitch[1])

    @property
    def upper(self) -> tuple[float, float]:
        """Corner ``(x, y)`` of the domain opposite to `lower`, metres."""
        rows, columns = self.coefficients.shape[:2]
        return (
            self.origin[0] + (columns - 2) * self.pitch[0],
            self.origin[1] + (rows - 2) * self.pitch[1],
        )

    def value(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the spline.

        Args:
            x: Metres, shape ``(...)``, broadcasting with `y`.
            y: Metres, shape ``(...)``.

        Returns:
            Shape ``(..., *channels)``; NaN outside the domain.
        """
        place = self._place(x, y)
        return self._sum(place, _weights(place.u), _weights(place.v))

    def derivative(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the derivatives of the spline along x and y.

        Args:
            x: Metres, shape ``(...)``, broadcasting with `y`.
            y: Metres, shape ``(...)``.

        Returns:
            Per metre, shape ``(..., *channels, 2)``; NaN outside the domain.
        """
        place = self._place(x, y)
        along_x = self._sum(place, _slopes(place.u) / self.pitch[0], _weights(place.v))
        along_y = self._sum(place, _weights(place.u), _slopes(place.v) / self.pitch[1])
        return np.stack([along_x, along_y], axis=-1)

    def _place(self, x: ArrayLike, y: ArrayLike) -> "_Place":
        """Return the cells that points lie in, and where in them."""
        rows, columns = self.coefficients.shape[:2]
        across, up = np.broadcast_arrays(as_float(x), as_float(y))
        column, u, in_x = _cell((across - self.origin[0]) / self.pitch[0], columns)
        row, v, in_y = _cell((up - self.origin[1]) / self.pitch[1], rows)
        return _Place(column, row, u, v, in_x & in_y)

    def _sum(self, place: "_Place", across: FloatArray, up: FloatArray) -> FloatArray:
        """Return the sum over the 4 x 4 coefficients around each point."""
        columns = self.coefficients.shape[1]
        channels = self.coefficients.shape[2:]
        flat = self.coefficients.reshape(-1, *channels)
        wide = (..., *(None,) * len(channels))
        total = np.zeros((*place.u.shape, *channels))
        for j in range(4):
            for i in range(4):
                index = (place.row + j) * columns + place.column + i
                total += (across[..., i] * up[..., j])[wide] * flat[index]
        return np.where(place.inside[wide], total, np.nan)


@dataclass(frozen=True, eq=False)
class _Place:
    """Cells and the places in them: first of four coefficients, offsets in 0..1, inside or not."""

    column: IntArray
    row: IntArray
    u: FloatArray
    v: FloatArray
    inside: BoolArray


def _cell(steps: FloatArray, count: int) -> tuple[IntArray, FloatArray, BoolArray]:
    """Return the first of the four coefficients around a place, the offset, and if inside."""
    # Rounding of origin + n * pitch must not put the last sample outside.
    slack = 1e-9
    with np.errstate(invalid="ignore"):
        inside = (steps >= 1.0 - slack) & (steps <= count - 2 + slack)
    within = np.where(inside, steps, 1.0)
    cell = np.clip(np.floor(within), 1, max(count - 3, 1))
    return cell.astype(np.int64) - 1, within - cell, inside


def _weights(t: FloatArray) -> FloatArray:
    """Return the four cubic B-spline weights at offsets t, shape ``(..., 4)``."""
    s = 1.0 - t
    middle = 4.0 - 6.0 * t * t + 3.0 * t**3
    return np.stack([s**3, middle, 4.0 - 6.0 * s * s + 3.0 * s**3, t**3], axis=-1) / 6.0


def _slopes(t: FloatArray) -> FloatArray:
    """Return the derivatives of the four weights, shape ``(..., 4)``."""
    s = 1.0 - t
    rise = 1.5 * t * t - 2.0 * t
    return np.stack([-0.5 * s * s, rise, 2.0 * s - 1.5 * s * s, 0.5 * t * t], axis=-1)


def _prefilter(values: FloatArray) -> FloatArray:
    """Return the coefficients along axis 0: two more than samples, not-a-knot at both ends."""
    count = len(values)
    inner = np.empty_like(values)
    # A third derivative that goes on past the second sample fixes its coefficient outright.
    inner[1] = (8.0 * values[1] - values[0] - values[2]) / 6.0
    inner[-2] = (8.0 * values[-2] - values[-1] - values[-3]) / 6.0
    if count > MINIMUM_SAMPLES:
        right = 6.0 * values[2:-2]
        right[0] -= inner[1]
        right[-1] -= inner[-2]
        inner[2:-2] = _solve_141(right)
    inner[0] = 6.0 * values[1] - 4.0 * inner[1] - inner[2]
    inner[-1] = 6.0 * values[-2] - 4.0 * inner[-2] - inner[-3]
    first = 6.0 * values[0] - 4.0 * inner[0] - inner[1]
    last = 6.0 * values[-1] - 4.0 * inner[-1] - inner[-2]
    return np.concatenate([first[None], inner, last[None]])


def _solve_141(right: FloatArray) -> FloatArray:
    """Solve ``c[i-1] + 4 c[i] + c[i+1] = right[i]`` along axis 0 by elimination."""
    count = len(right)
    ratio = np.empty(count)
    solution = right.copy()
    ratio[0] = 0.25
    solution[0] *= 0.25
    for i in range(1, count):
        ratio[i] = 1.0 / (4.0 - ratio[i - 1])
        solution[i] = (solution[i] - solution[i - 1]) * ratio[i]
    for i in range(count - 2, -1, -1):
        solution[i] -= ratio[i] * solution[i + 1]
    return solution


def _check_grid(
    field: str, values: FloatArray, origin: tuple[float, float], pitch: tuple[float, float]
) -> None:
    """Raise SpecError unless the grid has enough finite values and a usable place."""
    if values.ndim < 2 or min(values.shape[:2]) < MINIMUM_SAMPLES:
        shape = " x ".join(map(str, values.shape))
        raise SpecError(f"{field}: must be at least 4 x 4, got {shape or 'one number'}")
    if not np.all(np.isfinite(values)):
        bad = np.argwhere(~np.isfinite(values))[0].tolist()
        raise SpecError(f"{field}{bad}: must be finite, got {values[tuple(bad)]}")
    if not np.all(np.isfinite(origin)):
        raise SpecError(f"origin: must be finite, got {list(origin)}")
    if not (np.all(np.isfinite(pitch)) and min(pitch) > 0.0):
        raise SpecError(f"pitch: must be above 0, got {list(pitch)}")
