# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinoform as an efficiency model."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..errors import SpecError
from ..media import Medium
from ..orders import Branch
from . import kinoform
from .incidence import Incidence, Polarization


@dataclass(frozen=True)
class Kinoform:
    """A blazed phase relief in scalar theory, which knows transmitted orders alone.

    Attributes:
        levels: Number of levels, or 0 for a continuous relief.
        design_wavelength: Wavelength at which the relief is one wave deep, metres.
        relief: Material of the relief, in air.
    """

    levels: int
    design_wavelength: float
    relief: Medium

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches, shape ``(..., K)``; see `EfficiencyModel`.

        Raises:
            SpecError: The relief has no index at one of the wavelengths.
        """
        del polarization
        try:
            alpha = kinoform.phase_depth(light.wavelength, self.design_wavelength, self.relief)
        except SpecError as error:
            raise SpecError(f"efficiency.relief: {error}") from error
        orders = np.asarray([way.order for way in branches], dtype=np.int64)
        transmitted = np.asarray([not way.reflected for way in branches], dtype=np.bool_)
        found = kinoform.efficiency(orders, alpha[..., None], self.levels)
        return np.where(transmitted, found, 0.0)
