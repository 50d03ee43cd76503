# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the making of a relief does to its profile: mask by mask, line by line, wall by wall.

A relief of N = 2^B levels is etched through B binary masks. Mask b has lines and spaces of
2^b / N of the period each, and makes the steps of 2^b / N of the full depth. With a relative depth
error e_b in each, and x_b = 2^b (alpha (1 + e_b) - m) / N,

    |D_m|^2 = sinc(m / N)^2 times the product over b of cos(pi x_b)^2

which for small errors loses the sum of (pi alpha e_b 2^b / N)^2.

References:
    Swanson (1989), Binary optics technology, MIT Lincoln Laboratory technical report 854 (masks).
"""

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, as_float
from .segments import Segments, Steps


def mask_count(levels: int) -> int | None:
    """Return the number of binary masks of a relief, or None where the levels are no power of 2."""
    return levels.bit_length() - 1 if levels >= 2 and levels & (levels - 1) == 0 else None


def mask_depths(levels: int, etch_errors: Sequence[float]) -> FloatArray:
    """Return what each mask removes, in full depths, the deepest first.

    Args:
        levels: Number N of levels, a power of 2.
        etch_errors: Relative depth error of each mask, the deepest first; empty for none.

    Returns:
        Depths ``(1 + e) / 2, (1 + e) / 4, ...``, one a mask.
    """
    count = levels.bit_length() - 1
    errors = np.asarray(etch_errors if len(etch_errors) else np.zeros(count), dtype=np.float64)
    return 0.5 ** np.arange(1, count + 1) * (1.0 + errors)


def mask_steps(levels: int, etch_errors: Sequence[float]) -> Steps:
    """Return the staircase that etching with depth errors leaves.

    Args:
        levels: Number N of levels, a power of 2.
        etch_errors: Relative depth error of each mask, the deepest first.

    Returns:
        The steps; without errors those of the kinoform, sampled at the middle of each step.
    """
    depths = mask_depths(levels, etch_errors)
    step = np.arange(levels)
    heights = np.full(levels, 0.5 / levels)
    for place, depth in enumerate(depths):
        heights += depth * ((step >> (len(depths) - 1 - place)) & 1)
    return Steps(heights)


def mask_segments(levels: int, etch_errors: Sequence[float], duty_error: float) -> Segments:
    """Return the staircase where, besides, every raised line is too wide by the same length.

    Args:
        levels: Number N of levels, a power of 2.
        etch_errors: Relative depth error of each mask, the deepest first; empty for none.
        duty_error: Excess width of each raised line of each mask, half of it at either edge, as a
            share of the period; smaller in size than 1 / N.

    Returns:
        The profile.
    """
    depths = mask_depths(levels, etch_errors)
    raised: list[tuple[float, float]] = []
    for place in range(len(depths)):
        line = 0.5 ** (place + 1)
        starts = np.arange(line, 1.0, 2.0 * line)
        raised += [(start - duty_error / 2.0, start + line + duty_error / 2.0) for start in starts]
    edges = np.array([edge for line in raised for edge in line]) % 1.0
    inner = np.unique(np.concatenate((edges, (0.0,))))
    bounds = np.append(inner, 1.0)
    middle = 0.5 * (bounds[1:] + bounds[:-1])
    heights = np.full(len(middle), 0.5 / levels)
    for place, depth in enumerate(depths):
        line = 0.5 ** (place + 1)
        # The distance to the nearest middle of a raised line of this mask.
        away = np.abs((middle - 1.5 * line + line) % (2.0 * line) - line)
        heights += depth * (away < 0.5 * (line + duty_error))
    return Segments(bounds, heights, heights)


def with_walls(level: Segments, width: float) -> Segments:
    """Spread every wall of a profile of level pieces over a width, as its box average.

    Args:
        level: Level pieces.
        width: Width of each wall, as a share of the period, above 0 and below 1.

    Returns:
        Straight pieces that join without a jump; walls closer than the width flow into each other.
    """
    inner = level.edges[:-1]
    places = np.unique(np.concatenate((inner - width / 2.0, inner + width / 2.0)) % 1.0)
    right = _filled(level, places + width / 2.0)
    heights = (right - _filled(level, places - width / 2.0)) / width
    return Segments(np.append(places, places[0] + 1.0), heights, np.roll(heights, -1))


def _filled(level: Segments, places: FloatArray) -> FloatArray:
    """Integral of the height from the first edge to a place, with the period repeated."""
    filled = np.concatenate(((0.0,), np.cumsum(level.width * level.height)))
    turns = as_float(np.floor(places - level.edges[0]))
    return turns * filled[-1] + as_float(np.interp(places - turns, level.edges, filled))
