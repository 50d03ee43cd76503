# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light that a stack is lit with, and what comes out of it.

Jones amplitudes. Each order has two unit vectors in the tangent plane: t along its tangential wave
vector (along x where that is 0) and s = z cross t. Polarisation s has its electric field along s.
Polarisation p has a unit electric field in the plane of t and z whose tangential part points along
+t, whichever way the order goes. So at normal incidence a mirror has r_s = r_p.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import BoolArray, ComplexArray, FloatArray, IntArray, as_float
from ..errors import SpecError


@dataclass(frozen=True, eq=False)
class PlaneWaves:
    """B plane waves that light a stack, each on its own.

    Attributes:
        wavelength: Vacuum wavelengths, metres, shape ``(B,)``.
        along: x component of n s, index times unit direction of travel, shape ``(B,)``.
        across: Its y component, along the grooves, shape ``(B,)``.
        step: Wavelength over period, at least 0, shape ``(B,)``.
        from_front: Whether the light comes from the front half space, shape ``(B,)``.
        permittivity: Relative permittivity of each material, shape ``(B, M)``; with an imaginary
            part above 0 where the material absorbs.
    """

    wavelength: FloatArray
    along: FloatArray
    across: FloatArray
    step: FloatArray
    from_front: BoolArray
    permittivity: ComplexArray

    @classmethod
    def of(
        cls,
        wavelength: ArrayLike,
        tangential: tuple[ArrayLike, ArrayLike],
        period: ArrayLike,
        permittivity: ArrayLike,
        *,
        from_front: ArrayLike = False,
    ) -> "PlaneWaves":
        """Make waves from numbers or arrays that are broadcast together.

        Args:
            wavelength: Vacuum wavelengths, metres.
            tangential: Components of n s along x and y.
            period: Period, metres; infinite where there is none.
            permittivity: Permittivities, shape ``(M,)`` or ``(B, M)``.
            from_front: Whether the light comes from the front.

        Returns:
            The waves.

        Raises:
            SpecError: If a value is not finite, or not above 0 where it has to be.
        """
        values = [as_float(value) for value in (wavelength, *tangential, period)]
        table = np.atleast_2d(np.asarray(permittivity, dtype=np.complex128))
        side = np.asarray(from_front, dtype=np.bool_)
        shape = np.broadcast_shapes(*(v.shape for v in values), side.shape, table.shape[:1])
        colour, along, across, length = (np.broadcast_to(v, shape).copy() for v in values)
        if not (np.all(colour > 0.0) and np.all(length > 0.0)):
            raise SpecError("wavelength and period: must be above 0")
        if not all(np.all(np.isfinite(v)) for v in (colour, along, across, table)):
            raise SpecError("wavelength, direction and permittivity: must be finite")
        return cls(
            colour,
            along,
            across,
            colour / length,
            np.broadcast_to(side, shape).copy(),
            np.broadcast_to(table, (*shape, table.shape[1])).copy(),
        )

    def __len__(self) -> int:
        """How many waves."""
        return len(self.wavelength)

    def only(self, chosen: IntArray | BoolArray) -> "PlaneWaves":
        """The chosen waves."""
        return PlaneWaves(
            self.wavelength[chosen],
            self.along[chosen],
            self.across[chosen],
            self.step[chosen],
            self.from_front[chosen],
            self.permittivity[chosen],
        )


@dataclass(frozen=True, eq=False)
class Solution:
    """Amplitudes and efficiencies of successive orders; 0 where an order was not solved for.

    The last two axes of an amplitude are (polarisation of the order, polarisation of the light),
    the last axis of an efficiency is the polarisation of the light; 0 is s and 1 is p.

    Attributes:
        orders: Diffraction orders, ascending one by one, shape ``(K,)``.
        reflected_jones: Amplitudes of the reflected orders, shape ``(B, K, 2, 2)``.
        transmitted_jones: Amplitudes of the transmitted orders, shape ``(B, K, 2, 2)``.
        reflected: Power over incident power, shape ``(B, K, 2)``; 0 for evanescent orders.
        transmitted: The same, transmitted.
    """

    orders: IntArray
    reflected_jones: ComplexArray
    transmitted_jones: ComplexArray
    reflected: FloatArray
    transmitted: FloatArray

    @classmethod
    def empty(cls, count: int, first: int, last: int) -> "Solution":
        """Return zeros for all orders from the first to the last."""
        shape = (count, last - first + 1, 2)
        return cls(
            np.arange(first, last + 1),
            np.zeros((*shape, 2), dtype=np.complex128),
            np.zeros((*shape, 2), dtype=np.complex128),
            np.zeros(shape),
            np.zeros(shape),
        )

    @property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        """Amplitudes, then efficiencies, reflected before transmitted."""
        return (self.reflected_jones, self.transmitted_jones, self.reflected, self.transmitted)

    def place(self, order: int) -> int:
        """Place of an order on the second axis; SpecError if it is not there."""
        place = order - int(self.orders[0])
        if not 0 <= place < len(self.orders):
            ends = f"from {self.orders[0]} to {self.orders[-1]}"
            raise SpecError(f"order: must be {ends}, got {order}")
        return place

    def span(self, first: int, last: int) -> "Solution":
        """The orders from the first to the last, zeros for those that are not there."""
        result = Solution.empty(len(self.reflected), first, last)
        low, high = max(first, int(self.orders[0])), min(last, int(self.orders[-1]))
        if low <= high:
            for target, values in zip(result.arrays, self.arrays, strict=True):
                target[:, low - first : high - first + 1] = values[
                    :, self.place(low) : self.place(high) + 1
                ]
        return result

    def only(self, chosen: IntArray | BoolArray) -> "Solution":
        """The chosen waves."""
        return Solution(self.orders, *(values[chosen] for values in self.arrays))
