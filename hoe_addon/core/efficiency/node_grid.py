# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The grid of a table in the making: its axes, the error inside each interval, and bisection.

An interval in which some order begins or ceases to propagate holds a kink or a jump that no number
of nodes brings out; it is bisected to a small width, and no further.
"""

from dataclasses import dataclass, field

import numpy as np

from ..arrays import BoolArray, FloatArray
from .node_source import NODE, NodeSource

FIRST_NODES = (9, 9, 5, 5, 5)
"""Nodes to begin with on each axis: wavelength, along, across, x, y."""

_CUT_COUNTS = 0.1
"""Part of the error at a cut-off that counts as gain: nodes are better spent elsewhere first."""

_NARROWEST = 1.0 / 64.0
"""Intervals with a cut-off are not bisected below this part of their axis."""


@dataclass(eq=False)
class NodeGrid:
    """Axes that get more nodes where they are needed.

    Attributes:
        source: Where shares come from.
        fronts: 0.0 and 1.0 for the sides back and front that the light comes from.
        ranges: First and last value of each axis; alike for an axis that is not looked at.
        axes: The nodes so far; one, in the middle, on an axis without effect.
    """

    source: NodeSource
    fronts: tuple[float, ...]
    ranges: tuple[tuple[float, float], ...]
    axes: list[FloatArray] = field(default_factory=list["FloatArray"])

    def __post_init__(self) -> None:
        """Begin with one node on each axis."""
        self.axes = [np.array([0.5 * (low + high)]) for low, high in self.ranges]

    def open(self, axis: int) -> None:
        """Give an axis its first nodes."""
        low, high = self.ranges[axis]
        self.axes[axis] = np.linspace(low, high, FIRST_NODES[axis])

    @property
    def size(self) -> int:
        """How many numbers the table has with these axes."""
        counts = [len(self.fronts), *(len(nodes) for nodes in self.axes)]
        return int(np.prod(counts)) * len(self.source.branches)

    def values(self, axes: list[FloatArray] | None = None) -> tuple[FloatArray, BoolArray]:
        """Evaluate the nodes of a grid.

        Args:
            axes: The five axes; None for those of this grid.

        Returns:
            Shares, shape ``(S, W, A, B, X, Y, K)``, and which watched branches propagate, shape
            ``(S, W, A, B, X, Y, V)``.
        """
        parts = [np.asarray(self.fronts), *(self.axes if axes is None else axes)]
        mesh = np.meshgrid(*parts, indexing="ij")
        nodes = np.stack([part.ravel() for part in mesh], axis=-1)
        shares, passing = self.source.at(nodes)
        shape = mesh[0].shape
        return shares.reshape(*shape, -1), passing.reshape(*shape, -1)

    def random(self, rng: np.random.Generator, count: int) -> FloatArray:
        """Draw points of the ranges, directions within the source's radius, shape ``(N, 6)``."""
        points = np.empty((count, NODE))
        points[:, 0] = rng.choice(self.fronts, count)
        for axis, (low, high) in enumerate(self.ranges):
            points[:, 1 + axis] = rng.uniform(low, high, count)
        length = np.hypot(points[:, 2], points[:, 3])
        points[:, 2:4] *= (self.source.radius / np.maximum(length, self.source.radius))[:, None]
        # What was moved in from the corners is kept within the ranges.
        for axis in (1, 2):
            points[:, 1 + axis] = np.clip(points[:, 1 + axis], *self.ranges[axis])
        return points

    def variation(self, rng: np.random.Generator, lines: int, landmarks: FloatArray) -> list[float]:
        """Half of the largest spread along each axis, on lines through random points.

        Args:
            rng: Draws the points.
            lines: How many of them.
            landmarks: Further points, shape ``(N, 6)``.

        Returns:
            A number for each axis, absolute in the share.
        """
        base = np.concatenate((self.random(rng, lines), landmarks))
        found: list[float] = []
        for axis, (low, high) in enumerate(self.ranges):
            steps = np.linspace(low, high, 2 * FIRST_NODES[axis] - 1)
            # The last is the point itself: a narrow peak lies between all steps.
            points = np.repeat(base[:, None, :], len(steps) + 1, axis=1)
            points[:, :-1, 1 + axis] = steps
            shares, passing = self.source.at(points.reshape(-1, NODE))
            count = len(self.source.branches)
            real = np.hypot(points[..., 2], points[..., 3]) <= self.source.radius
            seen = np.where(passing[:, :count] & real.reshape(-1, 1), shares, np.nan)
            seen = seen.reshape(len(base), len(steps) + 1, count)
            found.append(0.5 * _largest(_spread(seen)) if low < high else 0.0)
        return found

    def interval_errors(self, axis: int) -> tuple[FloatArray, FloatArray]:
        """Errors of linear interpolation at the middle of each interval of an axis.

        Args:
            axis: Number of the axis.

        Returns:
            The largest error, without narrow intervals with a cut-off; and the gain of a node,
            which is the sum of squares of the errors that it would take away over the numbers
            that it would add. Both of shape ``(n - 1,)``.
        """
        nodes = self.axes[axis]
        middle = 0.5 * (nodes[1:] + nodes[:-1])
        axes = [middle if place == axis else part for place, part in enumerate(self.axes)]
        shares, passing = self._first(axis, *self.values())
        truth, live = self._first(axis, *self.values(axes))
        error = np.abs(truth - 0.5 * (shares[1:] + shares[:-1]))
        # Where an order lives in part of an interval, the error is there too.
        alive = live | passing[1:] | passing[:-1]
        error = np.where(alive[..., : error.shape[-1]], error, 0.0)
        cut = (passing[1:] != live) | (passing[:-1] != live)
        narrow = np.diff(nodes) <= _NARROWEST * (nodes[-1] - nodes[0])
        cut = cut.any(axis=-1)
        settled = cut & narrow.reshape(-1, *[1] * (cut.ndim - 1))
        error = np.where(settled[..., None], 0.0, np.nan_to_num(error))
        error[:, self._beyond_radius(axes, axis)] = 0.0
        square = (error**2 * np.where(cut, _CUT_COUNTS**2, 1.0)[..., None]).reshape(len(middle), -1)
        width = np.diff(nodes) / (nodes[-1] - nodes[0])
        gain = np.mean(square, axis=1) * width * len(nodes)
        return error.reshape(len(middle), -1).max(axis=1), gain

    @staticmethod
    def _first(axis: int, shares: FloatArray, passing: BoolArray) -> tuple[FloatArray, BoolArray]:
        """Bring an axis of both to the front."""
        return np.moveaxis(shares, 1 + axis, 0), np.moveaxis(passing, 1 + axis, 0)

    def _beyond_radius(self, axes: list[FloatArray], axis: int) -> BoolArray:
        """Corners of the grid that are no directions do not count; over all axes but one."""
        along, across = axes[1], axes[2]
        rest = [np.asarray(self.fronts), *self.axes]
        shape = [len(part) for part in rest]
        if axis in (1, 2):
            # The axis that is looked at counts by its innermost value.
            along = np.min(np.abs(along), keepdims=True) if axis == 1 else along
            across = np.min(np.abs(across), keepdims=True) if axis == 2 else across
        far = np.hypot(along[:, None], across[None, :]) > self.source.radius * (1.0 + 1e-9)
        whole = np.broadcast_to(
            far[None, None, :, :, None, None],
            (shape[0], shape[1], *far.shape, shape[4], shape[5]),
        )
        return np.take(whole, 0, axis=1 + axis)

    def bisect(self, marks: list[tuple[float, int, int]], largest: int) -> bool:
        """Put a node into the middle of intervals, the best first, while there is room.

        Args:
            marks: Gain, axis and number of each interval.
            largest: Most numbers of the table.

        Returns:
            Whether any was bisected.
        """
        added: dict[int, list[float]] = {}
        counts = [len(nodes) for nodes in self.axes]
        fixed = len(self.fronts) * len(self.source.branches)
        for _, axis, interval in sorted(marks, reverse=True):
            counts[axis] += 1
            if fixed * int(np.prod(counts)) > largest:
                counts[axis] -= 1
                continue
            pair = self.axes[axis][interval : interval + 2]
            added.setdefault(axis, []).append(float(np.mean(pair)))
        for axis, more in added.items():
            self.axes[axis] = np.unique([*self.axes[axis].tolist(), *more])
        return bool(added)


def _spread(values: FloatArray) -> FloatArray:
    """Largest less smallest value over the second axis, without NaN."""
    known = ~np.isnan(values)
    high = np.max(values, axis=1, where=known, initial=-np.inf)
    low = np.min(values, axis=1, where=known, initial=np.inf)
    return np.maximum(high - low, 0.0)


def _largest(values: FloatArray) -> float:
    return float(np.max(values, initial=0.0))
