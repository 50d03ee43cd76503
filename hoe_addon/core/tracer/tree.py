# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Non-sequential walk: each ray splits into all its branches until they land or fade."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .geometry import Rays
from .hits import NO_SURFACE, intersect, nearest
from .surfaces import PlanarSurface, Receiver


@dataclass(frozen=True, eq=False)
class Landed:
    """The L rays that reached the receiver, in its frame.

    Attributes:
        position: Places on the receiver, its x and y, metres, shape ``(L, 2)``.
        direction: Unit directions of travel in the frame of the receiver, shape ``(L, 3)``.
        weight: Power, in the unit of the launched weights, shape ``(L,)``.
        wavelength: Vacuum wavelengths, metres, shape ``(L,)``.
        ray_id: Index of the launched ray that each comes from, shape ``(L,)``.
        interactions: Number of surfaces met before the receiver, shape ``(L,)``.
    """

    position: FloatArray
    direction: FloatArray
    weight: FloatArray
    wavelength: FloatArray
    ray_id: IntArray
    interactions: IntArray


@dataclass
class EnergyBalance:
    """Where the launched power went; the parts sum to the whole.

    Attributes:
        launched: Power of all launched rays.
        landed: Power on the receiver.
        absorbed: Power lost at surfaces: absorbers, efficiencies that sum below 1, evanescent
            orders.
        escaped: Power of rays that met no further surface.
        pruned: Power of branches that were dropped, below the weight cut or beyond the largest
            number of interactions.
    """

    launched: float = 0.0
    landed: float = 0.0
    absorbed: float = 0.0
    escaped: float = 0.0
    pruned: float = 0.0


@dataclass(frozen=True, eq=False)
class TreeWalk:
    """What landed on the receiver, and the power that did not."""

    landed: Landed
    energy: EnergyBalance


@dataclass(frozen=True, eq=False)
class _Front:
    """The rays on their way, with their launching ray and the surface they just left."""

    rays: Rays
    ray_id: IntArray
    left: IntArray

    def pick(self, chosen: BoolArray) -> "_Front":
        """Return the chosen rays."""
        rays = Rays(
            self.rays.position[chosen],
            self.rays.direction[chosen],
            self.rays.wavelength[chosen],
            self.rays.weight[chosen],
        )
        return _Front(rays, self.ray_id[chosen], self.left[chosen])


def walk_tree(
    rays: Rays,
    surfaces: Sequence[PlanarSurface],
    receiver: Receiver,
    *,
    weight_cut: float = 1e-6,
    max_interactions: int = 256,
) -> TreeWalk:
    """Follow rays through whatever they meet, splitting them into all branches.

    Args:
        rays: R rays in the world with their weights.
        surfaces: The surfaces of the scene, without the receiver.
        receiver: Where rays are recorded and end.
        weight_cut: A branch ends when its weight falls below this part of its launching ray's.
        max_interactions: A branch ends when it has met this many surfaces.

    Returns:
        The landed rays, in no particular order, and the energy balance.
    """
    scene = (*surfaces, receiver)
    count = len(rays.wavelength)
    front = _Front(rays, np.arange(count), np.full(count, NO_SURFACE, dtype=np.int64))
    energy = EnergyBalance(launched=float(np.sum(rays.weight)))
    landings: list[Landed] = []
    for interaction in range(max_interactions + 1):
        which = nearest(front.rays, scene, front.left)
        energy.escaped += _power(front.rays.weight[which == NO_SURFACE])
        landings.append(_land(front.pick(which == len(surfaces)), receiver, interaction))
        energy.landed += _power(landings[-1].weight)
        if interaction == max_interactions:
            on_the_way = (which != NO_SURFACE) & (which != len(surfaces))
            energy.pruned += _power(front.rays.weight[on_the_way])
            break
        cuts = weight_cut * rays.weight
        front = _join(
            [
                _split(front.pick(which == number), surface, number, cuts, energy)
                for number, surface in enumerate(surfaces)
            ],
            front,
        )
        if not len(front.ray_id):
            break
    return TreeWalk(_gather(landings), energy)


def _power(weights: FloatArray) -> float:
    """Return the sum of weights as a plain float."""
    return float(np.sum(weights))


def _split(
    front: _Front, surface: PlanarSurface, number: int, cuts: FloatArray, energy: EnergyBalance
) -> _Front:
    """Return the branches that leave a surface; book what is absorbed or pruned."""
    _distance, local = intersect(front.rays, surface)
    directions, shares = surface.scatter(local)
    branches = shares.shape[1]
    weights = front.rays.weight[:, None] * shares
    energy.absorbed += _power(front.rays.weight) - _power(weights)
    ray_id = np.repeat(front.ray_id, branches)
    flat = weights.reshape(-1)
    keep = (flat > 0.0) & (flat >= cuts[ray_id])
    energy.pruned += _power(flat[~keep])
    position = np.repeat(surface.frame.point_to_world(local.points), branches, axis=0)
    heading = surface.frame.vector_to_world(directions.reshape(-1, 3))
    wavelength = np.repeat(local.wavelengths, branches)
    left = np.full(len(flat), number, dtype=np.int64)
    return _Front(Rays(position, heading, wavelength, flat), ray_id, left).pick(keep)


def _join(parts: list[_Front], empty_like: _Front) -> _Front:
    """Return all fronts as one; an empty one when there is no part."""
    if not parts:
        return empty_like.pick(np.zeros(len(empty_like.ray_id), dtype=np.bool_))
    rays = Rays(
        np.concatenate([part.rays.position for part in parts]),
        np.concatenate([part.rays.direction for part in parts]),
        np.concatenate([part.rays.wavelength for part in parts]),
        np.concatenate([part.rays.weight for part in parts]),
    )
    ray_id = np.concatenate([part.ray_id for part in parts])
    return _Front(rays, ray_id, np.concatenate([part.left for part in parts]))


def _land(front: _Front, receiver: Receiver, interaction: int) -> Landed:
    """Return the rays of a front at their hits on the receiver."""
    _distance, local = intersect(front.rays, receiver)
    return Landed(
        local.points[:, :2],
        local.directions,
        front.rays.weight,
        local.wavelengths,
        front.ray_id,
        np.full(len(front.ray_id), interaction, dtype=np.int64),
    )


def _gather(parts: list[Landed]) -> Landed:
    """Return the landings of all interactions as one."""
    return Landed(
        np.concatenate([part.position for part in parts]),
        np.concatenate([part.direction for part in parts]),
        np.concatenate([part.weight for part in parts]),
        np.concatenate([part.wavelength for part in parts]),
        np.concatenate([part.ray_id for part in parts]),
        np.concatenate([part.interactions for part in parts]),
    )
