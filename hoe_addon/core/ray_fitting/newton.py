# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Newton's method for the rays that reach given points, damped so that every step gains."""

import numpy as np

from ..arrays import FloatArray
from .landing import Landing, land
from .system import OpticalSystem

LANDING = 1e-13
"""A ray that passes a point within this, in metres (1e-10 mm), reaches it."""

_ROUND_OFF = 16.0 * float(np.finfo(np.float64).eps)
"""What far coordinates allow, relative to them."""

_CLEAR = 1e-2
"""Below this share of the tolerance no further step is taken."""

_STEPS = 40
_SHORTEST = 1e-6
"""A step cut down to this share of Newton's gains nothing any more: there is no ray."""

_LONGEST = 0.5
"""Longest step, over the first surface's semi-diameter."""


def tolerance(system: OpticalSystem, points: FloatArray) -> float:
    """Return how near a ray has to pass, metres.

    Args:
        system: The chain.
        points: The points, metres, shape ``(N, 3)``.

    Returns:
        `LANDING`, or the round-off of coordinates so large that this is more.
    """
    reach = float(np.max(np.abs(points), initial=0.0))
    for surface in system.surfaces:
        reach = max(reach, float(np.max(np.abs(surface.frame.origin))), surface.semi_diameter)
    return max(LANDING, _ROUND_OFF * reach)


def newton(system: OpticalSystem, starts: FloatArray, points: FloatArray) -> Landing:
    """Move rays until they pass through the points.

    A step that does not come nearer is cut to a quarter and tried again. A ray that has arrived
    takes one step more: its landing error, and so that of its direction, falls to round-off.

    Args:
        system: The chain.
        starts: Places on the first surface to begin from, metres, shape ``(N, 2)``.
        points: The points, metres, shape ``(N, 3)``.

    Returns:
        The landings; the `Landing.error` of one that does not arrive stays above `tolerance`.
    """
    enough = tolerance(system, points)
    longest = _LONGEST * system.surfaces[0].semi_diameter
    current = land(system, starts.copy(), points)
    error = current.error
    share = np.ones(len(starts))
    for _ in range(_STEPS):
        active = np.flatnonzero(
            np.isfinite(error) & (error > _CLEAR * enough) & (share > _SHORTEST)
        )
        if active.size == 0:
            break
        step = _newton_step(current.miss[active], current.jacobian[active], longest)
        trial = land(system, current.start[active] + share[active, None] * step, points[active])
        reached = trial.error
        nearer = reached < error[active]
        arrived = error[active] <= enough
        gained = active[nearer]
        current.put(gained, trial.part(nearer))
        error[gained] = reached[nearer]
        cut = np.where(nearer, np.minimum(1.0, 4.0 * share[active]), 0.25 * share[active])
        share[active] = np.where(arrived, 0.0, cut)
    return current


def _newton_step(miss: FloatArray, jacobian: FloatArray, longest: float) -> FloatArray:
    """Return the solution of ``jacobian step = miss``, no longer than allowed."""
    a, b, c, d = (jacobian[:, i, j] for i in (0, 1) for j in (0, 1))
    with np.errstate(all="ignore"):
        determinant = a * d - b * c
        step = np.stack((d * miss[:, 0] - b * miss[:, 1], a * miss[:, 1] - c * miss[:, 0]), axis=-1)
        step /= determinant[:, None]
        length = np.hypot(step[:, 0], step[:, 1])
        return step * np.minimum(1.0, longest / length)[:, None]
