# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light that a hologram is checked with, at the centre of the element or beside it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...core.arrays import FloatArray, as_float
from ...core.efficiency import Incidence, meet
from ...core.recording import Recording
from ...core.units import m_to_mm, mm_to_m, nm_to_m
from .. import medium
from ..convert import pattern_from
from ..element import element_shape
from ..evaluate import centre_mm, incident_direction
from ..hologram import HologramSpec
from ..medium import medium_from


@dataclass(frozen=True)
class Angles:
    """Where light comes from.

    Attributes:
        theta_deg: Angle from the normal in its own medium, degrees.
        phi_deg: Azimuth of its direction of travel, from +x toward +y, degrees.
        from_front: Whether it comes from z > 0.
        words: Why these angles.
    """

    theta_deg: float
    phi_deg: float
    from_front: bool
    words: str


@dataclass(frozen=True, eq=False)
class Lit:
    """N rays at one place of a hologram.

    Attributes:
        point_mm: The place, shape ``(3,)``.
        wavelength_nm: Vacuum wavelengths, nm, shape ``(N,)``.
        theta_deg: Angles from the normal, degrees, shape ``(N,)``.
        phi_deg: Azimuths, degrees, shape ``(N,)``.
        direction: Unit directions of travel, shape ``(N, 3)``.
        normal: Unit normal at the place, shape ``(3,)``.
        gradient: grad V, shape ``(N, 3)``.
        incidence: The same light in the frame of the grating.
        recorded_nm: Wavelength that the pattern is stated for, nm.
    """

    point_mm: FloatArray
    wavelength_nm: FloatArray
    theta_deg: FloatArray
    phi_deg: FloatArray
    direction: FloatArray
    normal: FloatArray
    gradient: FloatArray
    incidence: Incidence
    recorded_nm: float

    def words(self, place: int) -> str:
        """Name one of the rays for a reader."""
        side = "front" if bool(self.incidence.from_front[place]) else "back"
        return (
            f"{self.wavelength_nm[place]:g} nm, theta {self.theta_deg[place]:.4g} deg, "
            f"phi {self.phi_deg[place]:.4g} deg, from the {side}"
        )


_PLACES = ((0.5, 0.0), (0.25, 0.0), (0.75, 0.0), (0.95, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5))
"""Where else it is looked for a grating, as shares of half the width and half the height."""


def recorded_place_mm(spec: HologramSpec) -> FloatArray:
    """Find the place nearest the centre of a hologram, of a few, where something is recorded.

    Args:
        spec: The hologram.

    Returns:
        The centre, or a place beside it, such as for rings, which have no direction in their
        middle; the centre where nothing is recorded at any of them. In mm, shape ``(3,)``.
    """
    centre = centre_mm(spec)
    shape, pattern = element_shape(spec), pattern_from(spec.pattern)
    half = mm_to_m(np.asarray(spec.surface.size_mm)) / 2.0
    x, y = half[:, None] * as_float(_PLACES).T
    beside = np.stack((x, y, shape.sag(x, y)), axis=-1)
    points = np.concatenate((mm_to_m(centre)[None], beside))
    gradients = np.broadcast_to(pattern.gradient(points), points.shape)
    known = np.isfinite(points).all(axis=-1) & np.isfinite(gradients).all(axis=-1)
    first = int(np.argmax(known))
    return m_to_mm(points[first]) if first else centre


def light_on(
    spec: HologramSpec,
    wavelengths_nm: Sequence[float],
    thetas_deg: Sequence[float],
    phis_deg: Sequence[float],
    *,
    from_front: bool,
    at_mm: FloatArray | None = None,
) -> Lit:
    """Send a ray of every wavelength, angle and azimuth to one place of a hologram.

    Args:
        spec: The hologram; of extended sources the middle point counts.
        wavelengths_nm: Vacuum wavelengths, nm.
        thetas_deg: Angles from the normal in their own medium, degrees.
        phis_deg: Azimuths, degrees.
        from_front: Whether all come from z > 0.
        at_mm: The place on the surface, mm, shape ``(3,)``; None is the centre.

    Returns:
        The rays, wavelengths outermost.

    Raises:
        SpecError: If a medium has no index at one of the wavelengths.
    """
    rows = as_float(list(product(wavelengths_nm, thetas_deg, phis_deg)))
    colour, theta, phi = rows.T
    direction = incident_direction(theta, phi, from_front=from_front)
    point_mm = centre_mm(spec) if at_mm is None else at_mm
    point, wavelength = mm_to_m(point_mm), nm_to_m(colour)
    normal = element_shape(spec).normal(point)
    back, front = (
        medium_from(side).index(wavelength) for side in (spec.media.back, spec.media.front)
    )
    pattern = pattern_from(spec.pattern)
    gradient, incidence = meet(pattern, point, None, normal, direction, wavelength, (back, front))
    whole = np.broadcast_to(gradient, direction.shape)
    recorded_nm = spec.pattern.wavelength_nm
    return Lit(point_mm, colour, theta, phi, direction, normal, whole, incidence, recorded_nm)


def reference_light(spec: HologramSpec, at_mm: FloatArray | None = None) -> Angles:
    """The reference wave where it meets a place of a hologram, or light along the normal.

    Args:
        spec: The hologram.
        at_mm: The place on the surface, mm, shape ``(3,)``; None is the centre.

    Returns:
        Its angles, in the medium of the side that it comes from.
    """
    straight = Angles(0.0, 0.0, from_front=False, words="along the normal")
    pattern = pattern_from(spec.pattern)
    if not isinstance(pattern, Recording):
        return straight
    point_mm = centre_mm(spec) if at_mm is None else at_mm
    x, y, z = (float(part) for part in pattern.waves(mm_to_m(point_mm))[1])
    side = "front" if z < 0.0 else "back"
    index = medium.index_at(spec.media, side, spec.pattern.wavelength_nm)
    sine = float(np.hypot(x, y)) / index
    if not sine < 1.0:
        return straight
    theta, phi = np.degrees(np.arcsin(sine)), np.degrees(np.arctan2(y, x))
    return Angles(float(theta), float(phi), from_front=side == "front", words="the reference wave")
