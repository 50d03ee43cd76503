# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording of a hologram by two waves, and the characteristic function that it leaves."""

import math
from dataclasses import dataclass

from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float
from .errors import SpecError
from .waves import Wave


@dataclass(frozen=True)
class Recording:
    """Two waves and the wavelength that record a hologram; a `Pattern`.

    Attributes:
        object: Object wave, the one that order +1 gives back.
        reference: Reference wave, the one that reads out.
        wavelength: Vacuum wavelength of the recording, metres, above 0.
    """

    object: Wave
    reference: Wave
    wavelength: float

    def __post_init__(self) -> None:
        """Check the fields."""
        if not (math.isfinite(self.wavelength) and self.wavelength > 0.0):
            raise SpecError(f"wavelength: must be above 0, got {self.wavelength}")

    @property
    def draws(self) -> int:
        """Uniform numbers per point: those of the object wave, then those of the reference."""
        return self.object.draws + self.reference.draws

    def function(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return V = V_O - V_R, metres, up to a constant; see `Pattern`."""
        first, second = self._split(draws)
        return self.object.eikonal(points, first) - self.reference.eikonal(points, second)

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``n_O s_O - n_R s_R``; see `Pattern`.

        References:
            Welford (1975), "A vector raytracing equation for hologram lenses of arbitrary shape",
            Opt. Commun. 14(3), 322-323.
        """
        first, second = self.waves(points, draws)
        return first - second

    def waves(
        self, points: ArrayLike, draws: ArrayLike | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return ``n_O s_O`` and ``n_R s_R``.

        Args:
            points: Points on the surface, in the hologram's frame, metres, shape ``(..., 3)``.
            draws: Uniform numbers in [0, 1), shape ``(..., self.draws)``; None for one half each.

        Returns:
            Of the object and of the reference wave, each broadcastable to ``(..., 3)``.
        """
        first, second = self._split(draws)
        return self.object.gradient(points, first), self.reference.gradient(points, second)

    def _split(self, draws: ArrayLike | None) -> tuple[FloatArray | None, FloatArray | None]:
        if draws is None:
            return None, None
        numbers = as_float(draws)
        return numbers[..., : self.object.draws], numbers[..., self.object.draws :]
