# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiencies of layered gratings by rigorous coupled-wave analysis."""

import math
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..arrays import BoolArray, ComplexArray, FloatArray, IntArray
from ..errors import ConvergenceError
from ..orders import Branch
from ..rcwa import PlaneWaves, Progress, SingularError, Solution, Stack, converge, solve
from ..rcwa.blas import one_thread
from ..rcwa.convergence import DEFAULT_MAXIMUM
from ..rcwa.solve import THREADS_FROM
from .incidence import Incidence, Polarization
from .settling import Settled

type StackOf = Callable[[float, int], Stack]
"""The stack for a grating frequency (cycles per metre) and a number of harmonics."""
type Permittivity = Callable[[FloatArray], ComplexArray]
"""Relative permittivity at vacuum wavelengths in metres, shape to shape."""

_LEAST_PART = 1.0 / 2.25
"""A search takes two steps by 1.5: what it began with has every order that propagates."""
_GROWTH = 1.2
"""Factor between the numbers of harmonics that are tried for all rays."""

_PART_WAVES = 256
"""Waves of one thread at a time."""


@dataclass(frozen=True, eq=False)
class RigorousShares:
    """Shares and what they rest on.

    Attributes:
        shares: Power of each branch over the incident power for s and for p light, shape
            ``(..., K, 2)``; 0 for orders that do not propagate.
        error: Bound of the error of any efficiency, from the last two steps of the harmonics,
            shape ``(...)``; 0 where there is no grating, NaN where the harmonics were given.
        harmonics: Number of harmonics, shape ``(...)``.
    """

    shares: FloatArray
    error: FloatArray
    harmonics: IntArray


@dataclass(frozen=True, eq=False)
class RigorousGrating:
    """A stack of layers along the grating vector.

    It is reciprocal, and the same seen in a mirror across the grooves: the shares of unpolarised
    light are those of the reversed pair, and those of any light do not depend on the sign of y.

    Attributes:
        stack: The layers. Material 0 is the medium at the back and material 1 that at the front,
            as the light finds them; the others are those of `materials`.
        materials: Permittivities of the materials 2, 3, ..., which may absorb.
        fixed: Whether `stack` is the same for all frequencies, since lengths along x are counted
            in periods; if not, it is asked once for each frequency that differs.
        harmonics: Number of harmonics, odd; None to raise it until the tolerance is met.
        tolerance: Error of any efficiency at which the search stops.
        maximum: Most harmonics of a search.
        accept: Take what a search has reached at its maximum instead of raising.
        path: Where the grating stands, put before what is wrong with the harmonics.
    """

    stack: StackOf
    materials: Sequence[Permittivity] = ()
    fixed: bool = True
    harmonics: int | None = None
    tolerance: float = 1e-3
    maximum: int = DEFAULT_MAXIMUM
    accept: bool = False
    path: str = ""

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches, shape ``(..., K)``; see `EfficiencyModel`."""
        both = self.solve(branches, light).shares
        if polarization is Polarization.UNPOLARISED:
            return both.mean(axis=-1)
        return both[..., 0 if polarization is Polarization.S else 1]

    def settled(self, branches: Sequence[Branch], light: Incidence) -> Settled:
        """Find the fewest harmonics that serve some rays as well as a search; see `Settling`.

        Raises:
            ConvergenceError: If the search does not meet the tolerance.
            SpecError: If a number of the structure is out of its range.
        """
        rays = light.wavelength.size
        if self.harmonics is not None:
            return Settled(self, self.harmonics, math.nan, rays)
        searched = self.solve(branches, light)
        most = int(np.max(searched.harmonics, initial=1))
        count = _odd(most * _LEAST_PART)
        while True:
            fixed = replace(self, harmonics=min(count, most))
            moved = np.abs(fixed.solve(branches, light).shares - searched.shares)
            # The search is off itself, and with no fewer harmonics a ray is no farther off.
            fewer = min(count, most) < searched.harmonics
            off = np.where(fewer, moved.max(axis=(-2, -1), initial=0.0), 0.0) + searched.error
            error = float(np.max(off, initial=0.0))
            if error <= self.tolerance or count >= most:
                return Settled(fixed, min(count, most), error, rays)
            count = _odd(count * _GROWTH)

    def solve(
        self, branches: Sequence[Branch], light: Incidence, progress: Progress | None = None
    ) -> RigorousShares:
        """Return the shares for s and p light with the error reached.

        Where the frequency is 0 or nothing is recorded, layers that vary along x are left out and
        the others are a plain stack. Light that does not propagate in its own medium, and
        branches of another grating in the same film, have the shares 0.

        Args:
            branches: The K ways out.
            light: The light, shape ``(...)``.
            progress: Told how far the work is.

        Returns:
            The shares.

        Raises:
            ConvergenceError: If a search does not meet the tolerance.
            SpecError: If a number of the structure is out of its range.
        """
        waves, frequency = self._waves(light)
        count = len(waves)
        result = RigorousShares(
            np.zeros((count, len(branches), 2)),
            np.zeros(count),
            np.ones(count, dtype=np.int64),
        )
        real = np.hypot(waves.along, waves.across) <= light.index_in.ravel()
        total, done = max(int(np.count_nonzero(real)), 1), 0
        for value, chosen in [(0.0, real & (frequency == 0.0)), *self._groups(frequency, real)]:
            size = int(np.count_nonzero(chosen))
            if size == 0:
                continue
            tell = partial(_tell, progress, done / total, size / total) if progress else None
            try:
                self._solve_group(branches, value, waves, chosen, result, tell)
            except (ConvergenceError, SingularError) as error:
                raise type(error)(f"{self.path}{error}") from error
            done += size
        shape = light.shape
        return RigorousShares(
            result.shares.reshape(*shape, len(branches), 2),
            result.error.reshape(shape),
            result.harmonics.reshape(shape),
        )

    def _waves(self, light: Incidence) -> tuple[PlaneWaves, FloatArray]:
        """All rays in one row, and their frequencies with 0 where nothing is recorded."""
        wavelength = light.wavelength.ravel()
        tangential = light.tangential.reshape(-1, 2)
        frequency = np.nan_to_num(light.frequency.ravel(), nan=0.0)
        back, front = light.index_back.ravel(), light.index_front.ravel()
        table = [back**2, front**2, *(of(wavelength) for of in self.materials)]
        waves = PlaneWaves(
            wavelength,
            tangential[:, 0],
            tangential[:, 1],
            wavelength * frequency,
            light.from_front.ravel(),
            np.stack([np.broadcast_to(x, wavelength.shape) for x in table], axis=1).astype(
                np.complex128
            ),
        )
        return waves, frequency

    def _groups(self, frequency: FloatArray, real: BoolArray) -> list[tuple[float, BoolArray]]:
        """Rays that share a stack, and its frequency."""
        grated = real & (frequency > 0.0)
        if self.fixed:
            return [(float(frequency[grated][0]), grated)] if np.any(grated) else []
        return [(float(f), grated & (frequency == f)) for f in np.unique(frequency[grated])]

    def _solve_group(
        self,
        branches: Sequence[Branch],
        frequency: float,
        waves: PlaneWaves,
        chosen: BoolArray,
        result: RigorousShares,
        progress: Progress | None,
    ) -> None:
        """Fill in the results of the chosen rays."""
        light = waves.only(chosen)
        highest = max((abs(way.order) for way in branches), default=0)
        if frequency == 0.0:
            found = solve(self.stack(0.0, 1).plane_part(), light, 1, progress)
        elif self.harmonics is not None:
            count = self.harmonics
            found = _in_threads(self.stack(frequency, count), light, count, highest, progress)
            result.error[chosen], result.harmonics[chosen] = np.nan, count
        else:
            best = converge(
                lambda count: self.stack(frequency, count),
                light,
                highest,
                self.tolerance,
                maximum=self.maximum,
                accept=self.accept,
                progress=progress,
            )
            found = best.solution
            result.error[chosen], result.harmonics[chosen] = best.error, best.harmonics
        powers = found.span(-highest, highest)
        for place, way in enumerate(branches):
            if way.order == 0 or way.frequency == 1.0:
                side = powers.reflected if way.reflected else powers.transmitted
                result.shares[chosen, place] = side[:, highest + way.order]


def _in_threads(
    stack: Stack, light: PlaneWaves, harmonics: int, highest: int, progress: Progress | None
) -> Solution:
    """Solve many waves by parts, in one thread for each processor; orders -M .. M."""
    count = len(light)
    if count < 2 * _PART_WAVES or harmonics >= THREADS_FROM:
        return solve(stack, light, harmonics, progress).span(-highest, highest)

    def answer(part: IntArray) -> Solution:
        return solve(stack, light.only(part), harmonics).span(-highest, highest)

    result = Solution.empty(count, -highest, highest)
    parts: list[IntArray] = np.array_split(np.arange(count), count // _PART_WAVES)
    # The limit around all parts stays while single parts set it and take it back.
    pool = ThreadPoolExecutor(os.cpu_count() or 1)
    try:
        with one_thread():
            for part, found in zip(parts, pool.map(answer, parts), strict=True):
                for target, values in zip(result.arrays, found.arrays, strict=True):
                    target[part] = values
                if progress is not None:
                    progress((int(part[-1]) + 1) / count)
    finally:
        # What stops the work does not wait for the parts that have not begun.
        pool.shutdown(cancel_futures=True)
    return result


def _odd(count: float) -> int:
    """Round up to an odd number."""
    return 2 * math.ceil(0.5 * (count - 1.0)) + 1


def _tell(progress: Progress, done: float, share: float, part: float) -> None:
    """Tell of a part of a group as a part of the whole."""
    progress(done + share * part)
