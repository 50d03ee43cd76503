# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays that are on their way together."""

from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray
from .pieces import NO_PARENT, Pieces

NOTHING = -1
"""In place of the number of a body that a ray has left."""


@dataclass(frozen=True, eq=False)
class Front:
    """Rays on their way, all of the same length n; lengths in the unit of the walk.

    Attributes:
        start: Where they are, shape ``(n, 3)``.
        way: Unit directions, away from the eye, shape ``(n, 3)``.
        nm: Vacuum wavelengths, shape ``(n,)``.
        left: Number of the body that each has just left, or `NOTHING`, shape ``(n,)``.
        piece: Number of the last piece of each, or `NO_PARENT`, shape ``(n,)``.
        root: Number of the ray from the pupil that each belongs to, shape ``(n,)``.
        order: Last diffraction order that was not 0, or 0, shape ``(n,)``.
    """

    start: FloatArray
    way: FloatArray
    nm: FloatArray
    left: IntArray
    piece: IntArray
    root: IntArray
    order: IntArray

    def pick(self, chosen: BoolArray | IntArray | slice) -> "Front":
        """Give some of the rays."""
        return Front(
            self.start[chosen],
            self.way[chosen],
            self.nm[chosen],
            self.left[chosen],
            self.piece[chosen],
            self.root[chosen],
            self.order[chosen],
        )

    @classmethod
    def joined(cls, parts: list["Front"]) -> "Front":
        """Give the rays of several fronts as one."""
        names = cls.__dataclass_fields__
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))

    def moved(self, to: FloatArray, piece: IntArray) -> "Front":
        """Give the same rays farther on."""
        return replace(self, start=to, piece=piece)

    def split(
        self, row: IntArray, points: FloatArray, way: FloatArray, order: IntArray, piece: IntArray
    ) -> "Front":
        """Give the rays that come out where these have met something.

        Args:
            row: Which of these each comes from, shape ``(m,)``.
            points: Where these have met it, shape ``(n, 3)``.
            way: Directions of those that come out, shape ``(m, 3)``.
            order: Diffraction orders that they take, shape ``(m,)``.
            piece: Pieces of these up to there, shape ``(n,)``.
        """
        return Front(
            points[row],
            way,
            self.nm[row],
            self.left[row],
            piece[row],
            self.root[row],
            np.where(order == 0, self.order[row], order),
        )

    def pieces(self, to: FloatArray, to_mm: float = 1.0, *, is_open: bool = False) -> Pieces:
        """Give the pieces from here to somewhere.

        Args:
            to: Other ends, shape ``(n, 3)``.
            to_mm: Millimetres in the unit of the walk.
            is_open: Whether the rays go on beyond them.
        """
        ends = to_mm * np.stack((self.start, to), axis=1)
        opened = np.full(len(self.nm), is_open)
        return Pieces(ends, self.nm, self.piece, self.root, self.order, opened)


def start(places: FloatArray, way: FloatArray, nm: FloatArray) -> Front:
    """Begin a walk.

    Args:
        places: Where rays start, shape ``(n, 3)``.
        way: Unit directions, shape ``(n, 3)``.
        nm: Vacuum wavelengths, shape ``(n,)``.

    Returns:
        The rays.
    """
    count = len(nm)
    nothing = np.full(count, NOTHING, dtype=np.int64)
    none = np.full(count, NO_PARENT, dtype=np.int64)
    zero = np.zeros(count, dtype=np.int64)
    return Front(places, way, nm, nothing, none, np.arange(count), zero)
