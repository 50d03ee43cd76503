# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A tree of boxes around many items, walked by many queries at once."""

from collections.abc import Callable

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray

_LEAF = 4
"""Items in a leaf: fewer make the tree deeper, more make the exact tests longer."""

_CELLS = 1024
"""Steps of each coordinate in the sorting key."""

type Touches = Callable[[IntArray, FloatArray, FloatArray], BoolArray]
"""(queries (P,), lows (P, 3), highs (P, 3)) -> which of the P pairs touch, shape (P,)."""


class BoxTree:
    """A binary tree over axis-aligned boxes; items that are near each other share a branch."""

    def __init__(self, low: FloatArray, high: FloatArray) -> None:
        """Sort the boxes along a space-filling curve and join neighbours, up to the root.

        Args:
            low: Lowest corner of each item, shape ``(n, 3)``, n at least 1.
            high: Highest corner, shape ``(n, 3)``.
        """
        count = len(low)
        order = np.argsort(_morton(0.5 * (low + high)), kind="stable")
        leaves = 1 << max(0, int(np.ceil(np.log2(count / _LEAF))))
        self._items = np.full(leaves * _LEAF, -1, dtype=np.int64)
        self._items[:count] = order
        lows, highs = np.full((leaves * _LEAF, 3), np.inf), np.full((leaves * _LEAF, 3), -np.inf)
        lows[:count], highs[:count] = low[order], high[order]
        lows = lows.reshape(leaves, _LEAF, 3).min(axis=1)
        highs = highs.reshape(leaves, _LEAF, 3).max(axis=1)
        self._levels = [(lows, highs)]
        while len(lows) > 1:
            lows = lows.reshape(-1, 2, 3).min(axis=1)
            highs = highs.reshape(-1, 2, 3).max(axis=1)
            self._levels.append((lows, highs))
        self._levels.reverse()

    def pairs(self, count: int, touches: Touches) -> tuple[IntArray, IntArray]:
        """Find all pairs of a query and an item whose leaf it touches.

        Args:
            count: Number of queries.
            touches: The test of a query against a box.

        Returns:
            Numbers of queries and of items, shapes ``(P,)``; in no order.
        """
        queries = np.arange(count, dtype=np.int64)
        nodes = np.zeros(count, dtype=np.int64)
        for depth, (lows, highs) in enumerate(self._levels):
            if depth > 0:
                queries = np.repeat(queries, 2)
                nodes = np.repeat(2 * nodes, 2)
                nodes[1::2] += 1
            # The last leaves hold nothing; a ray would touch a box turned inside out.
            filled = lows[nodes, 0] <= highs[nodes, 0]
            queries, nodes = queries[filled], nodes[filled]
            kept = touches(queries, lows[nodes], highs[nodes])
            queries, nodes = queries[kept], nodes[kept]
        items = self._items.reshape(-1, _LEAF)[nodes].ravel()
        queries = np.repeat(queries, _LEAF)
        return queries[items >= 0], items[items >= 0]


def _morton(places: FloatArray) -> IntArray:
    """Return the place of each point on a curve that fills space, by mixing coordinate bits."""
    low, high = places.min(axis=0), places.max(axis=0)
    extent = np.where(high > low, high - low, 1.0)
    cells = np.minimum((places - low) / extent * _CELLS, _CELLS - 1).astype(np.int64)
    key = np.zeros(len(places), dtype=np.int64)
    for bit in range(_CELLS.bit_length() - 1):
        for axis in range(3):
            key |= ((cells[:, axis] >> bit) & 1) << (3 * bit + axis)
    return key
