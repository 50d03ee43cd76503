# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every efficiency model is: shares of the light by branch."""

from collections.abc import Sequence
from typing import Protocol

from ..arrays import FloatArray
from ..orders import Branch
from .incidence import Incidence, Polarization


class EfficiencyModel(Protocol):
    """Power of each branch over the incident power.

    An order that does not propagate may have any share: `core.orders.order_weights` looks at
    directions. What the propagating shares lack from 1 is absorbed.
    """

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches.

        Args:
            branches: The ways out to look at; any order.
            light: The light, shape ``(...)``.
            polarization: Of the light; a scalar model gives the same for all.

        Returns:
            Shares in [0, 1], shape ``(..., K)``.
        """
        ...
