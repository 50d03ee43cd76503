# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each model gives to each order, with its energy audit."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency import EfficiencyModel, Incidence, Polarization
from ...core.efficiency.rigorous import RigorousGrating
from ...core.errors import ConvergenceError, SpecError
from ...core.limits import MAX_ORDER
from ...core.orders import Branch, order_weights
from ...core.units import m_to_nm
from ..hologram import HologramSpec
from .candidates import Candidate
from .light import Lit

type Progress = Callable[[float], None]
type Way = tuple[int, bool]
"""Order, and whether it is reflected."""

MOST_PROPAGATING = 61
"""Orders on both sides above which the rigorous model would take minutes, and is left out."""
_SPARE = 20
"""Orders looked at where the pattern has no tangential part, so that all coincide."""
_POLARIZATIONS = (Polarization.S, Polarization.P)


@dataclass(frozen=True, eq=False)
class ModelShares:
    """Shares of N rays in one model.

    Attributes:
        candidate: The model.
        ways: The K ways out that may get light.
        shares: Share for s and p light, shape ``(N, K, 2)``.
        error: Largest change of a share between the last numbers of harmonics, shape ``(N,)``;
            None for a model without harmonics.
        harmonics: Number of harmonics, shape ``(N,)``, or None.
    """

    candidate: Candidate
    ways: tuple[Way, ...]
    shares: FloatArray
    error: FloatArray | None = None
    harmonics: FloatArray | None = None

    def of(self, way: Way) -> FloatArray:
        """Shares of one way out, shape ``(N, 2)``; 0 where the model does not know it."""
        if way not in self.ways:
            return np.zeros((len(self.shares), 2))
        return self.shares[:, self.ways.index(way)]

    def total(self, *, reflected: bool) -> FloatArray:
        """Power that goes on, or back, for s and p light, shape ``(N, 2)``."""
        chosen = [place for place, way in enumerate(self.ways) if way[1] == reflected]
        return self.shares[:, chosen].sum(axis=1)


def absorbed(model: ModelShares) -> FloatArray:
    """What is neither transmitted nor reflected, for s and p light, shape ``(N, 2)``."""
    return 1.0 - model.total(reflected=False) - model.total(reflected=True)


def propagating(light: Incidence) -> tuple[FloatArray, FloatArray]:
    """Count the orders that propagate.

    Args:
        light: The light, shape ``(N,)``.

    Returns:
        Numbers of transmitted and of reflected orders, shape ``(N,)``.
    """
    return _count(light, light.index_out), _count(light, light.index_in)


def _count(light: Incidence, index: FloatArray) -> FloatArray:
    """Integers m with |t + m lambda f| below the index; 0 or 1 where all orders are one."""
    step = np.nan_to_num(light.wavelength * light.frequency)
    along, across = light.tangential[:, 0], light.tangential[:, 1]
    squared = index**2 - across**2
    half = np.sqrt(np.maximum(squared, 0.0))
    safe = np.where(step > 0.0, step, 1.0)
    several = np.ceil((half - along) / safe) - np.floor((-half - along) / safe) - 1.0
    only = (np.abs(along) < half).astype(np.float64)
    return np.where(squared > 0.0, np.where(step > 0.0, several, only), 0.0)


def shares_of(
    spec: HologramSpec, candidate: Candidate, lit: Lit, progress: Progress | None = None
) -> ModelShares:
    """Evaluate one model.

    Args:
        spec: The hologram.
        candidate: The model, which must apply.
        lit: The light.
        progress: Told how far the rigorous model is.

    Returns:
        The shares of all orders that propagate.

    Raises:
        SpecError: The model cannot be evaluated here, with the reason.
    """
    efficiency = candidate.efficiency
    if efficiency is None:
        raise SpecError(candidate.words)
    light = lit.incidence if candidate.own else replace(lit.incidence, waves=None)
    highest = highest_order(light)
    listed = efficiency.branches(range(-highest, highest + 1), spec.pattern.wavelength_nm)
    model = efficiency.model()
    error = harmonics = None
    if isinstance(model, RigorousGrating):
        base, error, harmonics = _rigorous(model, listed, light, progress, own=candidate.own)
    else:
        base = _closed(model, listed, light)
    tir = efficiency.total_internal_reflection
    found = [_weights(listed, base[..., place], lit, tir) for place in (0, 1)]
    ways, first = found[0]
    flat = bool(np.all(np.nan_to_num(light.frequency) == 0.0))
    return _collected(
        candidate, ways, np.stack((first, found[1][1]), axis=-1), flat, error, harmonics
    )


def highest_order(light: Incidence) -> int:
    """Highest order that may propagate, as far as orders are counted."""
    step = light.wavelength * np.nan_to_num(light.frequency)
    if not np.any(step > 0.0):
        return _SPARE
    reach = np.maximum(light.index_back, light.index_front) + np.abs(light.tangential[:, 0])
    return min(int(np.max(reach[step > 0.0] / step[step > 0.0])) + 1, MAX_ORDER)


def _closed(model: EfficiencyModel, listed: tuple[Branch, ...], light: Incidence) -> FloatArray:
    both = [model.shares(listed, light, polarization) for polarization in _POLARIZATIONS]
    return np.stack(both, axis=-1)


def _rigorous(
    model: RigorousGrating,
    listed: tuple[Branch, ...],
    light: Incidence,
    progress: Progress | None,
    *,
    own: bool,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    beyond, back = propagating(light)
    most = int(np.max(np.maximum(beyond, back)))
    if most > MOST_PROPAGATING and not own:
        raise SpecError(f"{most} orders propagate, too many for a quick rigorous solution")
    try:
        found = replace(model, accept=True).solve(listed, light, progress)
    except ConvergenceError as error:
        raise SpecError(str(error)) from error
    return found.shares, found.error, found.harmonics.astype(np.float64)


def _weights(
    listed: tuple[Branch, ...], base: FloatArray, lit: Lit, tir: bool
) -> tuple[tuple[Branch, ...], FloatArray]:
    fan = order_weights(
        listed,
        base,
        lit.direction,
        lit.normal,
        lit.gradient,
        m_to_nm(lit.incidence.wavelength) / lit.recorded_nm,
        lit.incidence.index_in,
        lit.incidence.index_out,
        total_internal_reflection=tir,
    )
    return fan.branches, fan.weights


def _collected(
    candidate: Candidate,
    branches: tuple[Branch, ...],
    weights: FloatArray,
    flat: bool,
    error: FloatArray | None,
    harmonics: FloatArray | None,
) -> ModelShares:
    """Sum the exposures of an order, and all orders where they coincide."""
    named = [(0 if flat else way.order, way.reflected) for way in branches]
    ways = tuple(sorted(set(named), key=lambda way: (way[1], way[0])))
    shares = np.zeros((len(weights), len(ways), 2))
    for place, way in enumerate(named):
        shares[:, ways.index(way)] += weights[:, place]
    return ModelShares(candidate, ways, shares, error, harmonics)
