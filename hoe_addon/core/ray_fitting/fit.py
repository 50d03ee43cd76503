# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays fitted to many points of a hologram."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, IntArray, as_float
from ..errors import SpecError
from .chain import trace
from .landing import Landing, blocked
from .many import FitStatus, land_all
from .search import starts
from .system import OpticalSystem


class NoRayError(SpecError):
    """A system throws no ray on an element.

    Attributes:
        surface: Number of the surface where the rays are lost, from 0.
        rule: What it should do, and what happens.
    """

    def __init__(self, surface: int, reason: str) -> None:
        """Make the message ``surfaces[i]: must ..., got 0``."""
        self.surface = surface
        self.rule = f"must {reason}"
        super().__init__(f"surfaces[{surface}]: {self.rule}, got 0")


@dataclass(frozen=True, eq=False)
class RayFit:
    """The rays of many points.

    Attributes:
        points: The points, metres, shape ``(..., 3)``.
        direction: Unit directions at the points, shape ``(..., 3)``; NaN unless fitted.
        path: Optical paths from the source, metres, shape ``(...)``; NaN unless fitted. From the
            point of a point source (negative up to it for a converging one), or from the wave
            front through the origin of the frame.
        error: Distances of the points from their rays, metres, shape ``(...)``; NaN unless fitted.
        status: `FitStatus` of each, shape ``(...)``.
    """

    points: FloatArray
    direction: FloatArray
    path: FloatArray
    error: FloatArray
    status: IntArray

    def report(self) -> str:
        """Say how many points are not fitted, and where.

        Returns:
            One line: numbers, the box around them in mm, the first of them.
        """
        parts = [
            f"{np.count_nonzero(self.status == FitStatus.FITTED)} of {self.status.size} fitted"
        ]
        for status in (FitStatus.VIGNETTED, FitStatus.CAUSTIC):
            places = self.points[self.status == status]
            if len(places):
                box = f"{_millimetres(places.min(axis=0))} to {_millimetres(places.max(axis=0))}"
                first = _millimetres(places[0])
                parts.append(f"{len(places)} {status.name.lower()} within {box}, first {first}")
        return "; ".join(parts)


def fit_rays(system: OpticalSystem, points: ArrayLike) -> RayFit:
    """Find the ray from the source through all surfaces that lands on each point.

    Args:
        system: The chain.
        points: The points, in the hologram's frame, metres, shape ``(..., 3)``.

    Returns:
        Directions, paths and status. A point without exactly one ray is NaN, never a guess.
    """
    places = as_float(points)
    flat = places.reshape(-1, 3)
    landing = Landing.nowhere(len(flat))
    status: IntArray = np.full(len(flat), FitStatus.VIGNETTED, dtype=np.int64)
    usable = np.flatnonzero(np.isfinite(flat).all(axis=1))
    if usable.size:
        found, status[usable] = land_all(system, flat[usable])
        landing.put(usable, found)
    fitted = (status == FitStatus.FITTED).reshape(places.shape[:-1])
    return RayFit(
        places,
        np.where(fitted[..., None], landing.heading.reshape(places.shape), np.nan),
        np.where(fitted, landing.path.reshape(fitted.shape), np.nan),
        np.where(fitted, landing.error.reshape(fitted.shape), np.nan),
        status.reshape(fitted.shape),
    )


def check_reaches(system: OpticalSystem, points: ArrayLike) -> None:
    """Refuse a system that throws no ray on an element.

    Args:
        system: The chain.
        points: Some points of the element, metres, shape ``(..., 3)``.

    Raises:
        NoRayError: No ray reaches any of them; it names the surface that no ray passes.
    """
    if np.any(fit_rays(system, points).status == FitStatus.FITTED):
        return
    stopped = blocked(trace(system, starts(system)))
    inside = np.hypot(*starts(system).T) <= system.surfaces[0].semi_diameter
    stopped = stopped[inside]
    if np.all(stopped >= 0):
        # Every ray is stopped: the last surface that stops any is the one that none passes.
        reason = "let a ray pass; all miss it, pass outside its aperture, or are totally reflected"
        raise NoRayError(int(stopped.max()), reason)
    reason = "send a ray to the element; none lands on it, or only several on the same place"
    raise NoRayError(len(system.surfaces) - 1, reason)


def _millimetres(point: FloatArray) -> str:
    return "(" + ", ".join(f"{1e3 * value:.4g}" for value in point.tolist()) + ") mm"
