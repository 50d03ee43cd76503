# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave of a point that reaches the hologram through a flat window."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float, dot, unit
from ..errors import SpecError
from .wave import check_direction, check_index, check_vector

_STEPS = 100
"""More than Newton ever takes; it needs about one step per factor 1.5 toward grazing."""
_CONVERGED = 4e-16
_ON_FACE = 1e-6
"""A place this little before the window's far face, relative to the distance of the source, counts
as on it: float32 places a hologram on the face no better. The shader has the same number."""


@dataclass(frozen=True)
class FlatWindow:
    """A plane-parallel plate; of thickness 0 it is a plain boundary of two media.

    Attributes:
        position: A point on the face toward the source, metres.
        normal: Normal of both faces, from the source's side to the hologram's; any length but 0.
        thickness: Thickness of the plate, metres, at least 0.
        index: Refractive index of the plate, at least 1.
    """

    position: tuple[float, float, float]
    normal: tuple[float, float, float]
    thickness: float = 0.0
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "position", check_vector("window.position", self.position))
        object.__setattr__(self, "normal", check_direction("window.normal", self.normal))
        if not (math.isfinite(self.thickness) and self.thickness >= 0.0):
            raise SpecError(f"window.thickness: must be at least 0, got {self.thickness}")
        check_index(self.index, "window.index")


@dataclass(frozen=True)
class WindowSource:
    """A spherical wave in one medium, seen from another one behind a flat window.

    The rays keep ``p = n sin(angle)`` through all layers, so the ray from the point to a place at
    the lateral distance rho solves ``sum t_i p / sqrt(n_i^2 - p^2) = rho``. Behind the window the
    wave is no longer spherical.

    Attributes:
        position: The point, metres, on the source's side of the window.
        window: The window.
        converging: True when the wave travels through the window toward the point.
        source_index: Refractive index around the point, at least 1.
        index: Refractive index of the medium between window and hologram, at least 1.
    """

    position: tuple[float, float, float]
    window: FlatWindow
    converging: bool = False
    source_index: float = 1.0
    index: float = 1.0
    draws = 0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "position", check_vector("position", self.position))
        check_index(self.source_index, "source_index")
        check_index(self.index)
        if not self._before_window() > 0.0:
            raise SpecError(
                "position: must lie before the window, on the side that its normal points from, "
                f"got {list(self.position)}"
            )

    def eikonal(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return the optical path from the point, negative while converging; see `Wave`.

        It is ``p rho + sum t_i n_i cos_i``, where an error of p counts only by its square.
        """
        del draws
        rho, _, thicknesses, tangents = self._ray(points)
        cosines = 1.0 / np.hypot(1.0, tangents)
        invariant = self.index * tangents[..., 2] * cosines[..., 2]
        steps = np.where(thicknesses == 0.0, 0.0, thicknesses * self._indices() * cosines)
        path = invariant * rho + np.sum(steps, axis=-1)
        return -path if self.converging else path

    def gradient(self, points: ArrayLike, draws: ArrayLike | None = None) -> FloatArray:
        """Return ``n s``; NaN at places that are not behind the window; see `Wave`."""
        del draws
        _, lateral, _, tangents = self._ray(points)
        direction = unit(tangents[..., 2:] * lateral + unit(self.window.normal))
        return (-self.index if self.converging else self.index) * direction

    def _ray(self, points: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return rho, the lateral unit vector, and thickness and tangent of each layer."""
        axis = unit(self.window.normal)
        away = as_float(points) - as_float(self.position)
        along = dot(away, axis)
        lateral = away - along[..., None] * axis
        # A second time: the first leaves a rounding of the whole length along the axis.
        lateral -= dot(lateral, axis)[..., None] * axis
        rho = np.linalg.norm(lateral, axis=-1)
        before = self._before_window()
        slack = _ON_FACE * np.linalg.norm(away, axis=-1)
        behind = dot(as_float(points) - as_float(self.window.position), axis)
        behind = behind - self.window.thickness
        behind = np.where(behind < -slack, np.nan, np.maximum(behind, 0.0))
        thicknesses = np.stack(
            np.broadcast_arrays(before, self.window.thickness, behind), axis=-1
        ).astype(np.float64)
        tangents = layer_tangents(rho, thicknesses, self._indices())
        with np.errstate(invalid="ignore", divide="ignore"):
            direction = np.where(rho[..., None] > 0.0, lateral / rho[..., None], 0.0)
        return rho, direction, thicknesses, tangents

    def _before_window(self) -> float:
        """Return the distance of the point from the window."""
        reach = as_float(self.window.position) - as_float(self.position)
        return float(dot(reach, unit(self.window.normal)))

    def _indices(self) -> FloatArray:
        return as_float((self.source_index, self.window.index, self.index))


def layer_tangents(rho: FloatArray, thicknesses: FloatArray, indices: FloatArray) -> FloatArray:
    """Return the tangent of a ray's angle in each layer of a stack of plane-parallel layers.

    The unknown is u, the tangent in the layer of lowest index, and the one in layer j is
    ``n u / sqrt(n_j^2 + (n_j^2 - n^2) u^2)``: nothing cancels, neither along the axis nor toward
    grazing. The sum of ``t_j tan_j`` is concave and rises, so that Newton's steps from below never
    overshoot.

    Args:
        rho: Lateral distance between the ends of the ray, metres, at least 0, shape ``(...)``.
        thicknesses: Thickness of each layer, metres, at least 0, shape ``(..., k)``.
        indices: Their refractive indices, shape ``(k,)``.

    Returns:
        Tangents, shape ``(..., k)``; NaN where a thickness is, or where the ray is totally
        reflected before a layer without thickness.

    References:
        Born, Wolf (1999), "Principles of Optics", 7th ed., section 3.2.2 (Snell's law as an
        invariant of a stratified medium).
    """
    # A film without thickness is no film, whatever its index.
    present = thicknesses > 0.0
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        lowest = np.min(np.where(present, indices, np.inf), axis=-1)[..., None]
        excess = (indices - lowest) * (indices + lowest)
        slow = present & (excess > 0.0)
        bounded = np.sum(np.where(slow, thicknesses * lowest / np.sqrt(excess), 0.0), axis=-1)
        straight = np.sum(np.where(excess == 0.0, thicknesses, 0.0), axis=-1)
        # From below: the tangent at 0, and the most that layers of higher index can add.
        u = np.maximum(rho / dot(thicknesses, lowest / indices), (rho - bounded) / straight)
        for _ in range(_STEPS):
            root = np.sqrt(indices**2 + excess * u[..., None] ** 2)
            tangents = np.where(present, lowest / root, 0.0)
            slope = np.sum(thicknesses * tangents * (indices / root) ** 2, axis=-1, where=present)
            step = np.maximum((rho - u * dot(thicknesses, tangents)) / slope, 0.0)
            u = u + step
            if not np.any(step > _CONVERGED * u):
                break
        return lowest * u[..., None] / np.sqrt(indices**2 + excess * u[..., None] ** 2)
