# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same shares at every wavelength, direction and place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..orders import Branch
from .incidence import Incidence, Polarization


@dataclass(frozen=True)
class ConstantShares:
    """Shares of the light that are given as numbers.

    Attributes:
        by_branch: Share in [0, 1] of each branch; one that is not named gets none.
    """

    by_branch: Mapping[Branch, float]

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches, shape ``(..., K)``; see `EfficiencyModel`."""
        del polarization
        listed = np.asarray([self.by_branch.get(way, 0.0) for way in branches], dtype=np.float64)
        return np.broadcast_to(listed, (*light.shape, len(branches)))
