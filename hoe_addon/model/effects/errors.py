# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the picture is wrong with a simpler hologram: by shares, and by directions."""

import math

import numpy as np

from ...core.arrays import FloatArray, as_float, dot
from ...core.haze import rough_share
from ...core.orders import Branch
from ...core.units import mm_to_m, nm_to_m
from ..convert import pattern_from
from ..efficiency import RcwaSpec
from ..efficiency.haze import HazeSpec
from ..element import element_shape
from ..hologram import HologramSpec
from ..medium import medium_from
from .passing import shares_of
from .sharpness import blur_error, shift_error
from .sight import Sight
from .walk import Hits

_DRAW_SEED = 20260814
_LEAST_COSINE = 0.1
_CHANCE = 3.0
"""Standard errors that a mean may be off by chance."""


def hits_of(sight: Sight, name: str) -> list[Hits]:
    """List the hits on one hologram."""
    return [hits for hits in sight.walk.hits if hits.name == name]


def picture_change(
    sight: Sight, hits: Hits, change: FloatArray, *, bright: bool = False
) -> FloatArray:
    """Work out what a change of shares at some hits does to the picture.

    Args:
        sight: The rays of the picture.
        hits: Hits on one hologram.
        change: Of the share of each way out, shape ``(n, K)``.
        bright: Whether an order may show the lights of a room.

    Returns:
        Size of the change for each component of the light and each place of the picture, cd/m^2,
        shape ``(C, P)``.
    """
    rays = sight.walk.levels[hits.level].rays.pick(hits.rays)
    returned = np.zeros(hits.child.shape)
    back = sight.bright_back if bright else sight.back
    if hits.level + 1 < len(back):
        walked = hits.child >= 0
        returned[walked] = back[hits.level + 1][hits.child[walked]]
    values = np.zeros(len(sight.component))
    np.add.at(values, rays.root, rays.weight * np.sum(change * returned, axis=1))
    # At every wavelength by itself: what cancels in the luminance is seen in the colour.
    return sight.spread(np.abs(values))


def share_change(sight: Sight, name: str, simple: HologramSpec) -> FloatArray:
    """Work out what the shares of a simpler hologram change in the picture.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        simple: The simpler hologram; rigorous shares are too slow to be looked at.

    Returns:
        cd/m^2 by component and place, shape ``(C, P)``.
    """
    total = np.zeros((len(sight.components), sight.pixels))
    if isinstance(simple.efficiency, RcwaSpec):
        return total
    for hits in hits_of(sight, name):
        nm = sight.walk.levels[hits.level].rays.nm[hits.rays]
        shares = shares_of(simple, hits.points_mm, hits.out, nm, hits.ways)
        total += picture_change(sight, hits, shares - hits.shares)
    return total


def order_change(sight: Sight, name: str, dropped: tuple[Branch, ...]) -> FloatArray:
    """Work out what is missing in the picture without some orders.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        dropped: The branches that are left out.

    Returns:
        cd/m^2 by component and place, shape ``(C, P)``.
    """
    total = np.zeros((len(sight.components), sight.pixels))
    for hits in hits_of(sight, name):
        chosen = np.array([way in dropped for way in hits.ways])
        total += picture_change(sight, hits, np.where(chosen, hits.shares, 0.0), bright=True)
    return total


def unseen_share(sight: Sight, name: str, dropped: tuple[Branch, ...]) -> float:
    """Bound what the rays that were looked at may have missed of some orders.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        dropped: The branches that are left out.

    Returns:
        Relative error: the largest share that may go on, times the luminance of the brightest
        emitter over the mean, over the root of the number of hits; 0 where no ray is near to go on.
    """
    most, count = 0.0, 0
    for hits in hits_of(sight, name):
        chosen = np.array([way in dropped for way in hits.ways])
        near = (hits.reach <= _NEARLY) & chosen
        count += len(hits.rays)
        if near.any():
            shares = hits.shares[:, chosen]
            most = max(most, float(shares.max()) if shares.max() > 0.0 else 1.0)
    return most * sight.brightest / float(np.sqrt(count)) if count else 0.0


_NEARLY = 1.02
"""An order this far beyond evanescence does not go on between the rays looked at either."""


def turned_change(sight: Sight, name: str, given: HologramSpec, simple: HologramSpec) -> FloatArray:
    """Work out what other directions change in the picture, as if all of it were sharp edges.

    See `sharpness` for what counts how.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        given: The hologram.
        simple: The simpler hologram.

    Returns:
        cd/m^2 by component and place, shape ``(C, P)``.
    """
    total = np.zeros((len(sight.components), sight.pixels))
    full, plain = pattern_from(given.pattern), pattern_from(simple.pattern)
    rng = np.random.default_rng(_DRAW_SEED)
    blurred = full.draws > plain.draws
    for hits in hits_of(sight, name):
        points = mm_to_m(hits.points_mm)
        normal = element_shape(given).normal(points)
        draws = rng.random((len(points), full.draws)) if full.draws else None
        apart = np.nan_to_num(plain.gradient(points) - full.gradient(points, draws))
        apart = apart - dot(apart, normal)[..., None] * normal
        nm = sight.walk.levels[hits.level].rays.nm[hits.rays]
        slant = np.maximum(np.abs(dot(hits.way, normal)), _LEAST_COSINE)
        unit = nm / given.pattern.wavelength_nm / sight.pixel_angle / slant
        steps = np.abs([way.steps for way in hits.ways])
        moved = np.linalg.norm(apart, axis=-1) * unit
        if blurred:
            middle = _off_middle(apart) * float(np.mean(unit))
            wrong = shift_error(steps * middle) + blur_error(steps * moved[:, None])
        else:
            wrong = shift_error(steps * moved[:, None])
        total += picture_change(sight, hits, hits.shares * np.minimum(wrong, 1.0))
    return total


def _off_middle(apart: FloatArray) -> float:
    """How far the mean of random points is from the middle, beyond what chance does."""
    mean = float(np.linalg.norm(np.mean(apart, axis=0)))
    scatter = float(np.sqrt(np.sum(np.var(apart, axis=0)) / len(apart)))
    return max(mean - _CHANCE * scatter, 0.0)


def haze_change(sight: Sight, name: str, spec: HologramSpec, haze: HazeSpec) -> FloatArray:
    """Work out what the picture lacks without haze.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        spec: The hologram.
        haze: Its haze.

    Returns:
        cd/m^2 by component and place, shape ``(C, P)``.
    """
    total = np.zeros((len(sight.components), sight.pixels))
    wide = float(blur_error(as_float(math.radians(haze.width_deg) / sight.pixel_angle)))
    for hits in hits_of(sight, name):
        share = scattered_share(sight, hits, spec, haze)
        total += picture_change(sight, hits, hits.shares * share * wide)
    return total


def largest_scatter(sight: Sight, name: str, spec: HologramSpec, haze: HazeSpec) -> float:
    """Tell the largest share of an order that is scattered.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        spec: The hologram.
        haze: Its haze.

    Returns:
        Share, 0 to 1.
    """
    shares = (scattered_share(sight, hits, spec, haze) for hits in hits_of(sight, name))
    return max((float(np.max(each, initial=0.0)) for each in shares), default=0.0)


def scattered_share(sight: Sight, hits: Hits, spec: HologramSpec, haze: HazeSpec) -> FloatArray:
    """Tell which share of each order is scattered.

    Args:
        sight: The rays of the picture.
        hits: Hits on the hologram.
        spec: The hologram.
        haze: Its haze.

    Returns:
        Shares, shape ``(n, K)``; 0 where there is no order.
    """
    if haze.share is not None:
        return np.full(hits.shares.shape, haze.share)
    nm = sight.walk.levels[hits.level].rays.nm[hits.rays]
    normal = np.broadcast_to(element_shape(spec).normal(mm_to_m(hits.points_mm)), hits.way.shape)
    sides = [medium_from(side).index(nm_to_m(nm)) for side in (spec.media.back, spec.media.front)]

    def along(way: FloatArray) -> FloatArray:
        cosine = dot(way, normal)
        return np.where(cosine > 0.0, sides[1], sides[0]) * np.abs(cosine)

    before = np.where(dot(hits.way, normal) > 0.0, sides[0], sides[1])
    before = before * np.abs(dot(hits.way, normal))
    columns = [
        rough_share(
            (haze.roughness_nm or 0.0) * 1e-9,
            nm_to_m(nm),
            before,
            along(np.nan_to_num(hits.out[:, place])),
            reflected=way.reflected,
        )
        for place, way in enumerate(hits.ways)
    ]
    return np.stack(columns, axis=1)


def wavelength_change(
    sight: Sight, name: str, spec: HologramSpec, wavelength_nm: float
) -> FloatArray:
    """Work out what shares of one wavelength for all light change in the picture.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        spec: The hologram.
        wavelength_nm: The wavelength.

    Returns:
        cd/m^2 by component and place, shape ``(C, P)``.
    """
    total = np.zeros((len(sight.components), sight.pixels))
    for hits in hits_of(sight, name):
        nm = np.full(len(hits.rays), wavelength_nm)
        shares = shares_of(spec, hits.points_mm, hits.out, nm, hits.ways)
        total += picture_change(sight, hits, shares - hits.shares)
    return total
