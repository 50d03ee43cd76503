# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays that split on their way, as straight pieces."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray

NO_PARENT = -1


@dataclass(frozen=True)
class Orders:
    """A range of diffraction orders, both ends included."""

    lowest: int = 0
    highest: int = 1

    def __contains__(self, order: object) -> bool:
        """Tell whether an order is in the range."""
        return isinstance(order, int) and self.lowest <= order <= self.highest


@dataclass(frozen=True, eq=False)
class Pieces:
    """Straight pieces of rays; light runs from the second end of each to the first.

    Attributes:
        ends_mm: Both ends, the one nearer to the eye first, shape ``(n, 2, 3)``.
        nm: Vacuum wavelengths, shape ``(n,)``.
        parent: Which piece goes on toward the eye, `NO_PARENT` at the pupil, shape ``(n,)``.
        root: Number of the ray from the pupil that each belongs to, shape ``(n,)``.
        order: Diffraction order that was last taken, other than 0, on the way from the eye;
            0 where there was none. Shape ``(n,)``.
        is_open: Whether it goes on without end beyond its second end, shape ``(n,)``.
    """

    ends_mm: FloatArray
    nm: FloatArray
    parent: IntArray
    root: IntArray
    order: IntArray
    is_open: BoolArray

    def with_ancestors(self, leaves: BoolArray) -> "Pieces":
        """Keep some pieces and all that lie between them and the eye.

        Args:
            leaves: Which to keep, shape ``(n,)``.

        Returns:
            They, in the same order.
        """
        marks: list[bool] = leaves.tolist()
        before: list[int] = self.parent.tolist()
        for number in range(len(marks) - 1, -1, -1):
            if marks[number] and before[number] != NO_PARENT:
                marks[before[number]] = True
        kept = np.asarray(marks, dtype=np.bool_)
        place = np.cumsum(kept) - 1
        parents = np.where(self.parent == NO_PARENT, NO_PARENT, place[self.parent])
        return Pieces(
            self.ends_mm[kept],
            self.nm[kept],
            parents[kept],
            self.root[kept],
            self.order[kept],
            self.is_open[kept],
        )


class Growing:
    """Pieces that are being collected, level by level."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self._levels: list[Pieces] = []
        self._count = 0

    def add(self, level: Pieces) -> IntArray:
        """Add the pieces of a level.

        Args:
            level: They; their parents were added before.

        Returns:
            The number of each, shape ``(n,)``.
        """
        first = self._count
        self._levels.append(level)
        self._count += len(level.nm)
        return np.arange(first, self._count)

    def all(self) -> Pieces:
        """Give all that was added, in order of the numbers."""
        names = Pieces.__dataclass_fields__
        return Pieces(*(np.concatenate([getattr(p, name) for p in self._levels]) for name in names))
