# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The time of a measurement: what is left of it, and who wants to stop."""

import time
from collections.abc import Callable

from ...core.errors import CancelledError
from ..pictures.render import Progress

_NEEDED = 0.5
"""Of the shortest time of a setting so far, for the next; the shares of time vary somewhat."""


class Watch:
    """The time that is left, and who wants to stop.

    Attributes:
        budget: Seconds that there are.
        stop: Asked whether the user wants to stop.
        laps: Seconds of each step so far: first the reference, then one setting after the other.
    """

    def __init__(self, budget: float, stop: Callable[[], bool], progress: Progress | None) -> None:
        """Begin.

        Args:
            budget: Seconds that there are.
            stop: Asked whether the user wants to stop.
            progress: Told the share of the budget that is spent.
        """
        self._started = time.perf_counter()
        self.budget, self.stop, self._progress = budget, stop, progress
        self.laps: list[float] = []

    @property
    def spent(self) -> float:
        """Seconds since the beginning."""
        return time.perf_counter() - self._started

    @property
    def left(self) -> float:
        """Seconds that are left; below 0 where the budget is passed."""
        return self.budget - self.spent

    def lap(self) -> None:
        """Note that a step has ended."""
        self.laps.append(self.spent - sum(self.laps))

    def tell(self) -> None:
        """Tell how far it is."""
        if self._progress is not None:
            self._progress(min(1.0, self.spent / self.budget))

    def refuse_when_over(self) -> None:
        """Refuse one more setting where it would pass the budget, going by the settings so far.

        Raises:
            CancelledError: There is no time for it, or the user wants to stop.
        """
        if self.stop():
            raise CancelledError("stopped by the user")
        if self.left < _NEEDED * min(self.laps[1:]):
            raise CancelledError(f"the budget of {self.budget:g} s was used up")
