# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave of a source behind optics.

It is not among the names of the package: it builds on ray fitting, which builds on simple waves.
"""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..ray_fitting import OpticalSystem, RayFit, fit_rays


@dataclass(frozen=True)
class SystemWave:
    """A recording wave that comes through lenses or from mirrors.

    Attributes:
        system: The source and the surfaces.
    """

    system: OpticalSystem
    draws = 0

    @property
    def index(self) -> float:
        """Index of the medium after the last surface."""
        return self.system.index

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return the optical path of the ray to each point; see `Wave`."""
        del draws
        return self.fit(points).path

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return n times the direction of the ray to each point; see `Wave`."""
        del draws
        return self.index * self.fit(points).direction

    def fit(self, points: ArrayLike) -> RayFit:
        """Fit the rays, with the reason where there is none.

        Args:
            points: Points in metres, shape ``(..., 3)``.

        Returns:
            The fit.
        """
        return fit_rays(self.system, points)
