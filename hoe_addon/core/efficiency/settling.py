# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Models that search for the effort each ray needs: a table of them finds it once for all nodes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ..orders import Branch
from .incidence import Incidence
from .model import EfficiencyModel


@dataclass(frozen=True, eq=False)
class Settled:
    """A model that does not search any more.

    Attributes:
        model: The model with a fixed number of harmonics.
        harmonics: That number.
        error: Bound of the error of its shares: how far they were from those of the search where
            that took more harmonics, with the error of the search; NaN where the number was given
            and nothing was searched.
        rays: For how many rays that was looked at.
    """

    model: EfficiencyModel
    harmonics: int
    error: float
    rays: int


@runtime_checkable
class Settling(Protocol):
    """A model that searches at each ray."""

    def settled(self, branches: Sequence[Branch], light: Incidence) -> Settled:
        """Search for some rays, and keep to what serves all of them.

        Args:
            branches: The K ways out.
            light: Rays that stand for all others, shape ``(...)``.

        Returns:
            The model without a search.
        """
        ...
