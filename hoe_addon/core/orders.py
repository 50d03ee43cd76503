# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the light of each order goes, and how much: the one place for the rules on weights."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .arrays import BoolArray, FloatArray, IntArray, as_float
from .ray_law import Status, diffract


@dataclass(frozen=True)
class Branch:
    """One way out of a diffracting surface.

    Attributes:
        order: Diffraction order m.
        reflected: True for the order that goes back.
        frequency: Of the grating that diffracts, over that of the pattern; it is not 1 for the
            further exposures of a multiplexed hologram. The order 0 belongs to all of them.
    """

    order: int
    reflected: bool = False
    frequency: float = 1.0

    @property
    def steps(self) -> float:
        """How many times the grating vector of the pattern is added to the ray."""
        return self.order * self.frequency


TRANSMITTED_ZERO = Branch(0, reflected=False)
REFLECTED_ZERO = Branch(0, reflected=True)


@dataclass(frozen=True, eq=False)
class OrderFan:
    """All branches of each ray.

    Attributes:
        branches: The K branches, in the order of the last axis.
        directions: Unit directions, shape ``(..., K, 3)``, NaN where none goes on.
        weights: Power of each branch over the incident power, shape ``(..., K)``.
        status: `Status` of each branch, shape ``(..., K)``.
    """

    branches: tuple[Branch, ...]
    directions: FloatArray
    weights: FloatArray
    status: IntArray


def order_weights(
    branches: Sequence[Branch],
    efficiencies: ArrayLike,
    direction: ArrayLike,
    normal: ArrayLike,
    gradient: ArrayLike,
    wavelength_ratio: ArrayLike,
    index_in: ArrayLike,
    index_out: ArrayLike,
    *,
    total_internal_reflection: bool,
) -> OrderFan:
    """Return directions and weights of all branches of each ray.

    An order that does not propagate has a weight of exactly 0, and what it would have carried
    is lost. With `total_internal_reflection` there is one exception: where the transmitted
    order 0 is evanescent its share goes to the reflected order 0, as on a bare surface beyond
    the critical angle. A ray and its reverse have the same share, so the rule is reciprocal.

    Where the gradient is NaN nothing is recorded: there is no grating, whatever the model of the
    efficiency says. All light is in the transmitted order 0 (or, with the fold, reflected), and
    every other order is `Status.UNDEFINED`.

    Args:
        branches: The K ways out, each named once.
        efficiencies: Base efficiencies, broadcastable to ``(..., K)``.
        direction: Unit direction of the incident light, shape ``(..., 3)``.
        normal: Unit normal, to either side, broadcastable to ``(..., 3)``.
        gradient: ``n_O s_O - n_R s_R``, broadcastable to ``(..., 3)``.
        wavelength_ratio: Wavelength over recording wavelength, broadcastable to ``(...)``.
        index_in: Index of the medium of incidence, broadcastable to ``(...)``.
        index_out: Index of the other medium, broadcastable to ``(...)``.
        total_internal_reflection: Fold the evanescent transmitted order 0 into the reflected.

    Returns:
        The fan. What is needed and not listed is added behind the others: the transmitted order
        0 where some ray meets nothing recorded, then the reflected order 0 for the fold.
    """
    listed = tuple(branches)
    recorded = np.isfinite(as_float(gradient)).all(axis=-1)
    ways = listed
    if TRANSMITTED_ZERO not in ways and not recorded.all():
        ways = (*ways, TRANSMITTED_ZERO)
    fold = total_internal_reflection and TRANSMITTED_ZERO in ways
    if fold and REFLECTED_ZERO not in ways:
        ways = (*ways, REFLECTED_ZERO)
    directions, status = diffract(
        as_float(direction)[..., None, :],
        as_float(normal)[..., None, :],
        as_float(gradient)[..., None, :],
        as_float([way.steps for way in ways]),
        as_float(wavelength_ratio)[..., None],
        as_float(index_in)[..., None],
        as_float(index_out)[..., None],
        np.asarray([way.reflected for way in ways], dtype=np.bool_),
    )
    base = np.zeros(status.shape, dtype=np.float64)
    base[..., : len(listed)] = efficiencies
    straight: BoolArray = np.asarray([way == TRANSMITTED_ZERO for way in ways], dtype=np.bool_)
    base = np.where(recorded[..., None], base, straight)
    weights = np.where(status == Status.OK, base, 0.0)
    if fold:
        zero = ways.index(TRANSMITTED_ZERO)
        trapped: BoolArray = status[..., zero] == Status.EVANESCENT
        weights[..., ways.index(REFLECTED_ZERO)] += np.where(trapped, base[..., zero], 0.0)
    # The reflected order 0 has a direction with or without a grating, but there is no such light.
    absent = ~recorded[..., None] & ~straight & (weights == 0.0)
    status = np.where(absent, Status.UNDEFINED, status)
    directions = np.where(absent[..., None], np.nan, directions)
    return OrderFan(ways, directions, weights, status)
