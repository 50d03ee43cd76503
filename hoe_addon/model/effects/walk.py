# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays that occur: from the eye backward through the orders of all holograms, split at each.

What comes back along each ray is worked out from the ends. So a small change of the shares of one
hologram changes the picture by the sum over its hits of the weight of the hit, times the change of
each share, times what comes back in that order.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray, dot
from ...core.orders import Branch
from .bodies import Body, nearest
from .passing import Scattered, scatter

MOST_LEVELS = 32
_MOST_NEAR, _MOST_FAR, _NEAR = 30_000, 1_500, 3
"""Rays on one of the first levels, and on a later one; beyond, rays are kept by a chance that
follows their weight."""

_LEAST_WEIGHT = 1e-7
_ALL_WAYS = 2
"""Levels on which ways without light are walked too."""

_SEED = 20260812


@dataclass(frozen=True, eq=False)
class Rays:
    """Rays on their way; all of the same length n.

    Attributes:
        start: mm, shape ``(n, 3)``.
        way: Unit directions, shape ``(n, 3)``.
        nm: Vacuum wavelengths, shape ``(n,)``.
        root: Number of the ray from the eye that each belongs to, shape ``(n,)``.
        weight: Share of that ray's radiance that each carries, shape ``(n,)``.
        left: Body that each just left, -1 for none, shape ``(n,)``.
        step: Change of n times the direction with the wavelength, 1/nm, in the document's frame,
            shape ``(n, 3)``; only its part across the direction turns the ray.
        drift: How the place changes with the wavelength, mm/nm, shape ``(n, 3)``.
        far: Length of the way so far, mm, shape ``(n,)``.
    """

    start: FloatArray
    way: FloatArray
    nm: FloatArray
    root: IntArray
    weight: FloatArray
    left: IntArray
    step: FloatArray
    drift: FloatArray
    far: FloatArray

    @property
    def turning(self) -> FloatArray:
        """Change of the direction with the wavelength, rad/nm, shape ``(n, 3)``."""
        return self.step - dot(self.step, self.way)[:, None] * self.way

    def pick(self, chosen: BoolArray | IntArray) -> "Rays":
        """Give some of the rays."""
        return Rays(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))


@dataclass(frozen=True, eq=False)
class Hits:
    """Rays that meet one hologram on one level; n of them, with K ways out.

    Attributes:
        level: Number of surfaces that were met before.
        name: Name of the hologram in the document.
        rays: Which rays of the level, shape ``(n,)``.
        points_mm: In the hologram's frame, shape ``(n, 3)``.
        way: Directions of the walk in the hologram's frame, shape ``(n, 3)``.
        ways: The K ways out.
        out: Directions of the walk in them, in the hologram's frame, shape ``(n, K, 3)``.
        shares: Shape ``(n, K)``; of the light that takes this way in the other direction.
        reach: Tangential part of n s over n, above 1 for an evanescent order, shape ``(n, K)``.
        child: Which ray of the next level goes there, -1 for none, shape ``(n, K)``.
    """

    level: int
    name: str
    rays: IntArray
    points_mm: FloatArray
    way: FloatArray
    ways: tuple[Branch, ...]
    out: FloatArray
    shares: FloatArray
    reach: FloatArray
    child: IntArray


@dataclass(frozen=True, eq=False)
class Level:
    """All rays that have met the same number of surfaces.

    Attributes:
        rays: They.
        body: Number of the body that each meets, -1 for the room.
        end: Whether it ends there.
        points: Where it meets it, mm, shape ``(n, 3)``; of the room, anywhere.
        gain: Over the weight that it would have without the choice, shape ``(n,)``.
    """

    rays: Rays
    body: IntArray
    end: BoolArray
    points: FloatArray
    gain: FloatArray


@dataclass(eq=False)
class Walk:
    """A finished walk.

    Attributes:
        bodies: All bodies.
        levels: The levels.
        hits: Hits on holograms.
        edges: Of every level, the pairs of a ray, its follower on the next level, and the share.
    """

    bodies: tuple[Body, ...]
    levels: list[Level] = field(default_factory=list[Level])
    hits: list[Hits] = field(default_factory=list[Hits])
    edges: list[tuple[IntArray, IntArray, FloatArray]] = field(
        default_factory=list[tuple[IntArray, IntArray, FloatArray]]
    )

    def comes_back(self, ends: list[FloatArray]) -> list[FloatArray]:
        """Work out what comes back along each ray.

        Args:
            ends: Radiance at the ends, for each level and ray; 0 where a ray goes on.

        Returns:
            Radiance for each level and ray, over the weight that the ray has by itself.
        """
        found = [np.array(each, dtype=np.float64) for each in ends]
        for number in range(len(self.levels) - 1, -1, -1):
            if number + 1 < len(self.levels):
                parent, child, share = self.edges[number]
                np.add.at(found[number], parent, share * found[number + 1][child])
            found[number] *= self.levels[number].gain
        return found


def walk(bodies: tuple[Body, ...], rays: Rays, most_levels: int = MOST_LEVELS) -> Walk:
    """Walk rays until all have ended.

    Args:
        bodies: What they can meet.
        rays: The rays that start.
        most_levels: Rays that have met more surfaces than this end in the dark.

    Returns:
        The walk.
    """
    found = Walk(bodies)
    rng = np.random.default_rng(_SEED)
    front, gain = rays, np.ones(len(rays.nm))
    for _ in range(most_levels):
        front = _met(found, front, gain)
        followers, edges = _split(found, front)
        if len(followers.nm) == 0:
            break
        most = _MOST_NEAR if len(found.levels) < _NEAR else _MOST_FAR
        front, gain, kept = _chosen(followers, most, rng)
        place = np.full(len(kept), -1)
        place[kept] = np.arange(int(kept.sum()))
        parent, child, share = edges
        there = kept[child]
        found.edges.append((parent[there], place[child[there]], share[there]))
        level = len(found.levels) - 1
        for number, hits in enumerate(found.hits):
            if hits.level == level:
                moved = np.where(hits.child >= 0, place[hits.child], -1)
                found.hits[number] = replace(hits, child=moved)
    return found


def _met(found: Walk, rays: Rays, gain: FloatArray) -> Rays:
    which, far = nearest(found.bodies, rays.start, rays.way, rays.left)
    passes = np.array([*(body.passes for body in found.bodies), False])
    points = rays.start + np.where(np.isfinite(far), far, 0.0)[:, None] * rays.way
    found.levels.append(Level(rays, which, ~passes[which], points, gain))
    passed = np.where(np.isfinite(far), far, 0.0)
    drift = rays.drift + passed[:, None] * rays.turning
    return replace(rays, far=rays.far + passed, drift=drift)


def _split(found: Walk, rays: Rays) -> tuple[Rays, tuple[IntArray, IntArray, FloatArray]]:
    """Send all that goes on into every way out."""
    level = found.levels[-1]
    parts = [rays.pick(np.zeros(len(rays.nm), dtype=np.bool_))]
    parents, shares = [np.zeros(0, dtype=np.int64)], [np.zeros(0)]
    count = 0
    for number, body in enumerate(found.bodies):
        chosen = np.flatnonzero((level.body == number) & body.passes)
        if chosen.size == 0:
            continue
        points, way = body.local(level.points[chosen], rays.way[chosen])
        spread = scatter(body, points, way, rays.nm[chosen])
        goes = _goes_on(spread, rays.weight[chosen], deep=len(found.levels) > _ALL_WAYS)
        row, column = np.nonzero(goes)
        child = np.full(goes.shape, -1)
        child[row, column] = count + np.arange(len(row))
        count += len(row)
        if body.hologram is not None:
            found.hits.append(
                Hits(
                    len(found.levels) - 1,
                    body.name,
                    chosen,
                    points,
                    way,
                    spread.ways,
                    spread.out,
                    spread.shares,
                    spread.reach,
                    child,
                )
            )
        parts.append(
            _followers(rays.pick(chosen), level.points[chosen], number, body, goes, spread)
        )
        parents.append(chosen[row])
        shares.append(spread.shares[row, column])
    names = Rays.__dataclass_fields__
    merged = Rays(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))
    return merged, (np.concatenate(parents), np.arange(count), np.concatenate(shares))


def _goes_on(spread: Scattered, weight: FloatArray, *, deep: bool) -> BoolArray:
    """Tell which ways are walked; those that get no light too, near the eye, for a change of it."""
    carried = weight[:, None] * spread.shares
    some = carried > _LEAST_WEIGHT
    if not deep:
        some |= (spread.shares == 0.0) & (weight[:, None] > _LEAST_WEIGHT)
    return np.isfinite(spread.out).all(axis=-1) & some


def _followers(
    rays: Rays,
    points: FloatArray,
    number: int,
    body: Body,
    goes: BoolArray,
    spread: Scattered,
) -> Rays:
    row, column = np.nonzero(goes)
    step = rays.step @ body.turn
    step = step - dot(step, spread.normal)[:, None] * spread.normal
    turned = (step[:, None, :] + spread.kick)[row, column]
    return Rays(
        start=points[row],
        way=spread.out[row, column] @ body.turn.T,
        nm=rays.nm[row],
        root=rays.root[row],
        weight=rays.weight[row] * spread.shares[row, column],
        left=np.full(len(row), number),
        step=turned @ body.turn.T,
        drift=rays.drift[row],
        far=rays.far[row],
    )


def _chosen(rays: Rays, most: int, rng: np.random.Generator) -> tuple[Rays, FloatArray, BoolArray]:
    """Keep so many rays that the next level stays small; their weights make up for the rest."""
    count = len(rays.nm)
    if count <= most:
        return rays, np.ones(count), np.ones(count, dtype=np.bool_)
    size = rays.weight + 1e-3 * float(np.mean(rays.weight))
    chance = np.minimum(size * (most / 2) / float(np.sum(size)), 1.0)
    kept = rng.random(count) < chance
    gain = 1.0 / chance[kept]
    picked = rays.pick(kept)
    return replace(picked, weight=picked.weight * gain), gain, kept
