# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is recorded in a hologram: the characteristic function V, however it is given."""

from typing import Protocol

from numpy.typing import ArrayLike

from .arrays import FloatArray


class Pattern(Protocol):
    """The characteristic function V of a hologram and the wavelength lambda_0 it is stated for.

    The grating vector is ``Q = grad V / lambda_0``.
    """

    @property
    def wavelength(self) -> float:
        """Vacuum wavelength lambda_0, metres."""
        ...

    @property
    def draws(self) -> int:
        """How many uniform numbers an evaluation takes per point; 0 unless a source is extended."""
        ...

    def function(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return V up to a constant.

        Args:
            points: Points on the surface, in the hologram's frame, metres, shape ``(..., 3)``.
            draws: Uniform numbers in [0, 1), shape ``(..., self.draws)``; None for one half each.

        Returns:
            Metres, shape ``(...)``. NaN where nothing is recorded.
        """
        ...

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return grad V. Only its part in the tangent plane of the surface acts.

        Args:
            points: Points on the surface, in the hologram's frame, metres, shape ``(..., 3)``.
            draws: Uniform numbers in [0, 1), shape ``(..., self.draws)``; None for one half each.

        Returns:
            Without dimension, broadcastable to ``(..., 3)``. NaN where nothing is recorded: there
            is no grating, and the light passes in order 0.
        """
        ...
