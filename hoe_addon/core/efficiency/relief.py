# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A thin phase relief as an efficiency model."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, ComplexArray, FloatArray, IntArray
from ..errors import SpecError
from ..media import Medium
from ..orders import Branch
from . import kinoform
from .incidence import Incidence, Polarization
from .profiles import Profile


@dataclass(frozen=True)
class Kinoform:
    """A phase relief in scalar theory, which knows transmitted orders alone.

    Attributes:
        profile: One period of the relief.
        design_wavelength: Wavelength that the depth is stated for, metres.
        relief: Material of the relief, in air.
        depth: Phase depth at the design wavelength along the normal, in periods of 2 pi.
        angle_dependent: Whether the phase depth follows the direction of the light; otherwise it
            is that along the normal.
    """

    profile: Profile
    design_wavelength: float
    relief: Medium
    depth: float = 1.0
    angle_dependent: bool = True

    def phase_depth(self, light: Incidence) -> FloatArray:
        """Return the phase depth alpha for each ray, in periods of 2 pi, shape ``(...)``.

        Raises:
            SpecError: The relief has no index at one of the wavelengths.
        """
        tangential = light.tangential if self.angle_dependent else None
        try:
            return self.depth * kinoform.phase_depth(
                light.wavelength, self.design_wavelength, self.relief, tangential
            )
        except SpecError as error:
            raise SpecError(f"efficiency.relief: {error}") from error

    def amplitudes(self, branches: Sequence[Branch], light: Incidence) -> ComplexArray:
        """Return the complex amplitudes D_m of K branches.

        Args:
            branches: The ways out; a reflected one has the amplitude 0.
            light: The light, shape ``(...)``.

        Returns:
            Amplitudes, shape ``(..., K)``.

        Raises:
            SpecError: The relief has no index at one of the wavelengths.
        """
        orders, transmitted = _orders(branches)
        found = self.profile.amplitude(orders, self.phase_depth(light)[..., None])
        return np.where(transmitted, found, 0.0)

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
        orders, transmitted = _orders(branches)
        found = self.profile.efficiency(orders, self.phase_depth(light)[..., None])
        return np.where(transmitted, found, 0.0)


def _orders(branches: Sequence[Branch]) -> tuple[IntArray, BoolArray]:
    """Orders of the branches, and which of them are transmitted."""
    orders = np.asarray([way.order for way in branches], dtype=np.int64)
    return orders, np.asarray([not way.reflected for way in branches], dtype=np.bool_)
