# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through one element: the tables that the numpy and the Cycles engine share."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import BoolArray, FloatArray, IntArray

STATUS_NAMES = ("ok", "evanescent", "miss", "undefined")
"""Names of ``core.ray_law.Status`` in files, by value."""


@dataclass(frozen=True, eq=False)
class RayTable:
    """Rays that meet one element, each with the one branch that is asked for.

    Attributes:
        origin_mm: Start points in the element's frame, mm, shape ``(n, 3)``.
        direction: Unit directions of travel, shape ``(n, 3)``.
        wavelength_nm: Vacuum wavelengths, nm, shape ``(n,)``.
        order: Diffraction orders, shape ``(n,)``.
        reflected: True for a reflected order, shape ``(n,)``.
    """

    origin_mm: FloatArray
    direction: FloatArray
    wavelength_nm: FloatArray
    order: IntArray
    reflected: BoolArray

    def __len__(self) -> int:
        """Number of rays."""
        return len(self.order)

    def part(self, chosen: NDArray[np.bool_] | NDArray[np.int64] | slice) -> "RayTable":
        """Take some of the rays.

        Args:
            chosen: Mask, indices or slice.

        Returns:
            Those rays, in the same order.
        """
        return RayTable(
            self.origin_mm[chosen],
            self.direction[chosen],
            self.wavelength_nm[chosen],
            self.order[chosen],
            self.reflected[chosen],
        )


@dataclass(frozen=True, eq=False)
class TraceResult:
    """What became of each ray of a `RayTable`.

    Attributes:
        hit_mm: Point on the element, mm, shape ``(n, 3)``; NaN for a miss.
        direction: Unit direction behind the element, shape ``(n, 3)``; NaN where there is none.
        status: Values of ``core.ray_law.Status``, shape ``(n,)``.
        efficiency: Share of the power that takes the branch, shape ``(n,)``; exactly 0 where it
            is evanescent, NaN for a miss.
    """

    hit_mm: FloatArray
    direction: FloatArray
    status: IntArray
    efficiency: FloatArray
