# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""As many harmonics as the result needs: raised until its error is below what is asked for."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ConvergenceError, SpecError
from .light import PlaneWaves, Solution
from .solve import MAX_HARMONICS, Progress, solve
from .stack import Stack

type Structure = Callable[[int], Stack]
"""The stack to solve with a number of harmonics: more harmonics, more slices."""

DEFAULT_MAXIMUM = 401
"""Harmonics at which a search gives up unless told otherwise."""

_GROWTH = 1.5
"""Factor from one number to the next."""
_LEAST = 4
"""Highest order of the first try, at least."""
_BEYOND = 2
"""Evanescent orders on either side of the propagating ones in the first try."""
_HOPED_ORDER = 3.0
"""Power of the number of harmonics that an error may still come to fall with. What falls more
slowly by then is not expected to get there; what has fallen faster is taken at its word."""
_ADVICE = "give harmonics as a number"


@dataclass(frozen=True, eq=False)
class Converged:
    """A solution and how far it can be trusted.

    Attributes:
        solution: Orders -M .. M of all waves.
        error: Bound of the error of any efficiency, from the last two steps, shape ``(B,)``; see
            `converge`.
        harmonics: Number of harmonics of each wave's result, shape ``(B,)``.
    """

    solution: Solution
    error: FloatArray
    harmonics: IntArray


def converge(
    structure: Structure,
    light: PlaneWaves,
    highest: int,
    tolerance: float,
    *,
    maximum: int = DEFAULT_MAXIMUM,
    accept: bool = False,
    progress: Progress | None = None,
) -> Converged:
    """Solve with more and more harmonics until no efficiency is off by more than the tolerance.

    Slanted walls in p light, and metals, converge as slowly as 1 / n. Then the error that is left
    after a step from m to n harmonics is m / (n - m) times the step, twice it or a little more:
    this is what is compared with the tolerance. Faster convergence leaves less. Two steps in
    succession have to stay below the tolerance, since one may by chance. A wave that has got there
    is not solved again. The search ends early if a wave will not get there by the maximum.

    Args:
        structure: The stack for a number of harmonics.
        light: The waves.
        highest: Highest order M that the result holds.
        tolerance: Error of any efficiency that is allowed, above 0.
        maximum: Most harmonics to try.
        accept: Return what has been reached at the maximum, with its error, instead of raising.
        progress: Told how far the work is.

    Returns:
        The solution.

    Raises:
        ConvergenceError: If the tolerance is not met at the maximum, or will not be.
        SpecError: If an argument is out of range.
    """
    if not 0.0 < tolerance < 1.0:
        raise SpecError(f"tolerance: must be above 0 and below 1, got {tolerance}")
    sizes = _sizes(structure(1), light, maximum)
    search = _Search(light, highest, tolerance)
    for size in sizes:
        search.step(structure(2 * size + 1), size, progress)
        if search.is_done or (not accept and search.is_hopeless(2 * sizes[-1] + 1)):
            break
    if not search.is_done and not accept:
        raise ConvergenceError(search.message(maximum))
    return Converged(search.solution, search.error, search.harmonics)


def _sizes(stack: Stack, light: PlaneWaves, maximum: int) -> list[int]:
    """Highest orders to try, ascending."""
    if not 1 <= maximum <= MAX_HARMONICS:
        raise SpecError(f"maximum: must be from 1 to {MAX_HARMONICS}, got {maximum}")
    last = (maximum - 1) // 2
    ends = light.permittivity[:, [stack.back, stack.front]]
    reach = np.sqrt(np.abs(ends)).max(axis=1)
    with np.errstate(divide="ignore"):
        needed = float(np.max(np.where(light.step > 0.0, reach / light.step, 0.0)))
    if needed > last:
        raise ConvergenceError(
            f"harmonics: {2 * math.ceil(needed) + 1} orders propagate, more than the"
            f" maximum {maximum} of auto; {_ADVICE}"
        )
    size = max(_LEAST, math.floor(needed) + _BEYOND)
    sizes: list[int] = []
    while size < last:
        sizes.append(size)
        size = math.ceil(size * _GROWTH)
    # Less than three tries would show nothing: then they are taken from below.
    tries = [*sizes, last] if len(sizes) > 1 else [round(last / _GROWTH**k) for k in (2, 1, 0)]
    return sorted(set(tries))


class _Search:
    """State of the waves between the steps."""

    def __init__(self, light: PlaneWaves, highest: int, tolerance: float) -> None:
        self._light = light
        self._tolerance = tolerance
        count = len(light)
        self._last: Solution | None = None
        self._open = np.arange(count)
        self._left = np.full(count, np.inf)
        self._fallen = np.zeros(count)
        self._count = 0
        self.error = np.full(count, np.inf)
        self.harmonics = np.zeros(count, dtype=np.int64)
        self.solution = Solution.empty(count, -highest, highest)

    @property
    def is_done(self) -> bool:
        """Whether no wave is left."""
        return len(self._open) == 0

    def is_hopeless(self, most: int) -> bool:
        """Whether a wave that is left will not get there with the most harmonics, as it seems."""
        order = np.maximum(self._fallen[self._open], _HOPED_ORDER)
        expected = self._left[self._open] * (self._count / most) ** order
        several = np.isfinite(self.error[self._open])
        return bool(np.any(several & (expected > self._tolerance)))

    def message(self, maximum: int) -> str:
        """What is wrong with the waves that are left."""
        worst = float(np.max(self.error[self._open]))
        return (
            f"harmonics: must bring the result to {self._tolerance:g}, but it may be off by"
            f" {worst:.2g} at {self._count} harmonics, and auto takes {maximum} at most; {_ADVICE},"
            " or a larger tolerance"
        )

    def step(self, stack: Stack, size: int, progress: Progress | None) -> None:
        """Solve what is left with one number of harmonics."""
        count = len(self._light)

        def tell(share: float) -> None:
            del share
            if progress is not None:
                progress(1.0 - len(self._open) / count)

        found = solve(stack, self._light.only(self._open), 2 * size + 1, tell)
        left = np.full(len(self._open), np.inf)
        if self._last:
            left = _moved(self._last, found) * self._count / (2 * size + 1 - self._count)
        self._store(found, left, 2 * size + 1)
        settled = self.error[self._open] < self._tolerance
        self._open = self._open[~settled]
        self._last = found.only(~settled)
        tell(1.0)

    def _store(self, found: Solution, left: FloatArray, harmonics: int) -> None:
        index, before = self._open, self._left[self._open]
        self.error[index] = np.maximum(left, before)
        known = np.isfinite(before) & np.isfinite(left) & (before > 0.0) & (left > 0.0)
        ratio = np.divide(before, left, where=known, out=np.ones(len(index)))
        if self._count:
            self._fallen[index] = np.log(ratio) / np.log(harmonics / self._count)
        self._left[index] = left
        self.harmonics[index] = harmonics
        self._count = harmonics
        ends = (int(self.solution.orders[0]), int(self.solution.orders[-1]))
        for target, values in zip(self.solution.arrays, found.span(*ends).arrays, strict=True):
            target[index] = values


def _moved(before: Solution, after: Solution) -> FloatArray:
    """Largest change of an efficiency of each wave."""
    first = min(int(before.orders[0]), int(after.orders[0]))
    last = max(int(before.orders[-1]), int(after.orders[-1]))
    old, new = before.span(first, last), after.span(first, last)
    change = np.maximum(
        np.abs(new.reflected - old.reflected), np.abs(new.transmitted - old.transmitted)
    )
    return change.max(axis=(1, 2))
