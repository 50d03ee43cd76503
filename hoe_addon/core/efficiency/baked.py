# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A table that was made of a model, with the error that was measured."""

from dataclasses import dataclass

from ..arrays import FloatArray
from .settling import Settled
from .table import EfficiencyTable


@dataclass(frozen=True, eq=False)
class BakedTable:
    """A table and how good it is; errors are absolute in the share.

    Attributes:
        table: The table.
        tolerance: The error that was asked for.
        quantile: Error that 99 % of the random points keep, away from cut-offs.
        error: Largest error of them, which may be larger at other points.
        rms: Root of the mean square of it.
        cutoff_error: Largest error in cells with a cut-off; 0 where there are none.
        cutoff_part: Part of the random points that lie in such cells.
        landmark_error: Largest error at the landmarks; 0 where there are none.
        landmark: The node of it; None where there are none.
        landmarks: How many landmarks are recorded and propagate.
        checks: How many random points, near cut-offs or not, propagate and are recorded.
        collapsed: Names of the axes that stand for any value.
        spread: Largest difference of s and p at the random points.
        mean_spread: Mean of it.
        evaluated: At how many nodes the model was evaluated.
        excess: By how much shares summed to more than 1 and were scaled down; see `NodeSource`.
        settled: What a model that searches at each ray has settled on; None for others.
    """

    table: EfficiencyTable
    tolerance: float
    quantile: float
    error: float
    rms: float
    landmark_error: float
    landmark: FloatArray | None
    landmarks: int
    cutoff_error: float
    cutoff_part: float
    checks: int
    collapsed: tuple[str, ...]
    spread: float
    mean_spread: float
    evaluated: int
    excess: float
    settled: Settled | None

    @property
    def reached(self) -> bool:
        """Whether 99 % of the random points away from cut-offs, and all landmarks, keep it."""
        return max(self.quantile, self.landmark_error) <= self.tolerance
