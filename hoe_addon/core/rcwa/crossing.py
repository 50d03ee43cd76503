# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an outline that is repeated along x crosses itself."""

import math
from itertools import pairwise

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import SpecError

_TOUCH = 1e-12
"""Corners closer to another edge than this, of the size of the outline, touch it."""
_ROWS = 256
"""Edges that are compared with all others at a time."""


def check_simple(points: FloatArray) -> None:
    """Raise SpecError if an outline crosses itself or overlaps its repetition; it may touch both.

    Args:
        points: Corners, x in periods and z in metres, shape ``(V, 2)``.

    Raises:
        SpecError: With the two edges, counted from 0, and their ends.
    """
    height = np.ptp(points[:, 1])
    scaled = points / (1.0, height if height > 0.0 else 1.0)
    begin, end = scaled, np.roll(scaled, -1, axis=0)
    for period in range(math.ceil(float(np.ptp(points[:, 0]))) + 1):
        moved = np.array([float(period), 0.0])
        for start in range(0, len(points), _ROWS):
            rows = slice(start, start + _ROWS)
            crossing = _crossing(begin[rows], end[rows], begin + moved, end + moved)
            if np.any(crossing):
                first, second = (int(k) for k in np.argwhere(crossing)[0])
                raise SpecError(_message(points, start + first, second, period))
    heights = np.unique(points[:, 1])
    for low, high in pairwise(heights):
        _check_filling(points, float(0.5 * (low + high)))


def _check_filling(points: FloatArray, height: float) -> None:
    """Raise SpecError unless the walls at a height alternate between inside and outside.

    This finds crossings that go through a corner, too.
    """
    begin, end = points, np.roll(points, -1, axis=0)
    cut = np.flatnonzero((begin[:, 1] < height) != (end[:, 1] < height))
    low, high = begin[cut], end[cut]
    share = (height - low[:, 1]) / (high[:, 1] - low[:, 1])
    places = low[:, 0] + share * (high[:, 0] - low[:, 0])
    upward = high[:, 1] > low[:, 1]
    # The wall that the sense of rotation puts first comes first, also where two touch.
    first = upward[np.argmin(places)] if len(places) else False
    order = np.lexsort((upward != first, np.round(places / _TOUCH) * _TOUCH))
    places, alternate = places[order], (upward[order] != first) == (np.arange(len(cut)) % 2 == 1)
    if not np.all(alternate):
        wrong = int(np.argmin(alternate))
        raise SpecError(_message(points, int(cut[order[wrong - 1]]), int(cut[order[wrong]]), 0))
    inside = places.reshape(-1, 2)
    starts = np.mod(inside[:, 0], 1.0)
    sorted_starts = np.argsort(starts)
    ends = (starts + np.diff(inside, axis=1)[:, 0])[sorted_starts]
    following = np.append(starts[sorted_starts][1:], starts[sorted_starts][:1] + 1.0)
    if np.any(ends > following + _TOUCH * max(1.0, float(np.max(np.abs(places))))):
        widest = float(np.max(ends - starts[sorted_starts]))
        rule = "points: must not overlap their own repetition"
        raise SpecError(f"{rule}, got a stretch of {widest:g} periods at z = {height:g}")


def _crossing(p: FloatArray, q: FloatArray, r: FloatArray, s: FloatArray) -> BoolArray:
    """Whether the edges p q, shape (A, 2), properly cross the edges r s, shape (B, 2)."""
    p, q = p[:, None], q[:, None]
    size = max(1.0, float(np.ptp(r[:, 0])))

    def side(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        area = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1])
        area = area - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
        return np.where(np.abs(area) <= _TOUCH * size, 0.0, np.sign(area))

    return (side(p, q, r) * side(p, q, s) < 0.0) & (side(r, s, p) * side(r, s, q) < 0.0)


def _message(points: FloatArray, first: int, second: int, period: int) -> str:
    where = f" of the repetition {period} to the right" if period else ""
    return (
        f"points: edges must not cross, got edge {first} {_edge(points, first)} across"
        f" edge {second} {_edge(points, second)}{where}"
    )


def _edge(points: FloatArray, index: int) -> str:
    (x1, z1), (x2, z2) = points[index], points[(index + 1) % len(points)]
    return f"({x1:g}, {z1:g})-({x2:g}, {z2:g})"
