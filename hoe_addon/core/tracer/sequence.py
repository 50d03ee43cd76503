# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequential walk: rays through a given list of surfaces, forward and back."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..orders import Branch
from ..ray_law import Status
from .geometry import Rays
from .hits import LEAVING_DISTANCE, intersect
from .surfaces import PlanarSurface


@dataclass(frozen=True, eq=False)
class Step:
    """One surface of a sequence and the way out that is followed.

    Attributes:
        surface: The surface. A mirror always reflects; a lens, an absorber and a receiver always
            let the ray pass.
        order: Diffraction order m.
        reflected: True for the way back.
    """

    surface: PlanarSurface
    order: int = 0
    reflected: bool = False


@dataclass(frozen=True, eq=False)
class SequenceWalk:
    """What became of the rays.

    Attributes:
        rays: The rays as they leave the last surface, at their last hit; NaN where the status
            is not OK.
        status: First `Status` that was not OK, or OK, shape ``(R,)``.
        hits: World points on each surface in the order of the walk, metres, shape
            ``(S, R, 3)``; NaN from the first miss on, and after any other failure.
    """

    rays: Rays
    status: IntArray
    hits: FloatArray


def walk_sequence(rays: Rays, steps: Sequence[Step]) -> SequenceWalk:
    """Follow rays through the surfaces in the given order.

    A ray misses a surface that lies behind it or whose aperture it passes by. Other surfaces
    are ignored: nothing shades and nothing splits.

    Args:
        rays: R rays in the world. Their weights are kept as they are.
        steps: The surfaces, in the order in which light meets them.

    Returns:
        The walk.
    """
    status = np.full(len(rays.wavelength), int(Status.OK), dtype=np.int64)
    status[~np.isfinite(rays.position + rays.direction).all(axis=1)] = Status.UNDEFINED
    hits = np.full((len(steps), len(rays.wavelength), 3), np.nan)
    for number, step in enumerate(steps):
        rays, status = _one_step(rays, status, step)
        hits[number] = rays.position
    failed = (status != Status.OK)[:, None]
    position = np.where(failed, np.nan, rays.position)
    direction = np.where(failed, np.nan, rays.direction)
    return SequenceWalk(Rays(position, direction, rays.wavelength, rays.weight), status, hits)


def walk_sequence_backward(rays: Rays, steps: Sequence[Step]) -> SequenceWalk:
    """Take rays back along a sequence, from its end to before its start.

    The rays are turned round and obey the same laws with the same orders, in reverse order of
    the surfaces. So the rays that `walk_sequence` returns come back along those it was given.

    Args:
        rays: R rays in the world in their *forward* direction, at or behind the last surface.
        steps: The surfaces, in the order in which forward light meets them.

    Returns:
        The walk. Its rays stand on the first surface and point backward, to where the light
        came from; its hits begin with the last surface.
    """
    return walk_sequence(rays.reversed(), tuple(reversed(steps)))


def _one_step(rays: Rays, status: IntArray, step: Step) -> tuple[Rays, IntArray]:
    """Return the rays after one surface, NaN where they do not go on, and the new status."""
    surface = step.surface
    distance, local = intersect(rays, surface)
    with np.errstate(invalid="ignore"):
        met = distance >= -LEAVING_DISTANCE
        directions, outcome = surface.follow(local, Branch(step.order, step.reflected))
    fresh = np.where(met, outcome, Status.MISS)
    status = np.where(status == Status.OK, fresh, status)
    position = np.where(met[:, None], surface.frame.point_to_world(local.points), np.nan)
    heading = surface.frame.vector_to_world(directions)
    heading = np.where((status == Status.OK)[:, None], heading, np.nan)
    return Rays(position, heading, rays.wavelength, rays.weight), status
