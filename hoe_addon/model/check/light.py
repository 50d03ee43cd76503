# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light that a hologram is checked with, at the centre of the element."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...core.arrays import FloatArray, as_float
from ...core.efficiency import Incidence, meet
from ...core.recording import Recording
from ...core.units import mm_to_m, nm_to_m
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
    """N rays at the centre of a hologram.

    Attributes:
        wavelength_nm: Vacuum wavelengths, nm, shape ``(N,)``.
        theta_deg: Angles from the normal, degrees, shape ``(N,)``.
        phi_deg: Azimuths, degrees, shape ``(N,)``.
        direction: Unit directions of travel, shape ``(N, 3)``.
        normal: Unit normal at the centre, shape ``(3,)``.
        gradient: grad V, shape ``(N, 3)``.
        incidence: The same light in the frame of the grating.
        recorded_nm: Wavelength that the pattern is stated for, nm.
    """

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


def light_on(
    spec: HologramSpec,
    wavelengths_nm: Sequence[float],
    thetas_deg: Sequence[float],
    phis_deg: Sequence[float],
    *,
    from_front: bool,
) -> Lit:
    """Send a ray of every wavelength, angle and azimuth to the centre of a hologram.

    Args:
        spec: The hologram; of extended sources the middle point counts.
        wavelengths_nm: Vacuum wavelengths, nm.
        thetas_deg: Angles from the normal in their own medium, degrees.
        phis_deg: Azimuths, degrees.
        from_front: Whether all come from z > 0.

    Returns:
        The rays, wavelengths outermost.

    Raises:
        SpecError: If a medium has no index at one of the wavelengths.
    """
    rows = as_float(list(product(wavelengths_nm, thetas_deg, phis_deg)))
    colour, theta, phi = rows.T
    direction = incident_direction(theta, phi, from_front=from_front)
    point, wavelength = mm_to_m(centre_mm(spec)), nm_to_m(colour)
    normal = element_shape(spec).normal(point)
    back, front = (
        medium_from(side).index(wavelength) for side in (spec.media.back, spec.media.front)
    )
    pattern = pattern_from(spec.pattern)
    gradient, incidence = meet(pattern, point, None, normal, direction, wavelength, (back, front))
    whole = np.broadcast_to(gradient, direction.shape)
    recorded_nm = spec.pattern.wavelength_nm
    return Lit(colour, theta, phi, direction, normal, whole, incidence, recorded_nm)


def reference_light(spec: HologramSpec) -> Angles:
    """The reference wave where it meets the centre of a hologram, or light along the normal.

    Args:
        spec: The hologram.

    Returns:
        Its angles, in the medium of the side that it comes from.
    """
    straight = Angles(0.0, 0.0, from_front=False, words="along the normal")
    pattern = pattern_from(spec.pattern)
    if not isinstance(pattern, Recording):
        return straight
    x, y, z = (float(part) for part in pattern.waves(mm_to_m(centre_mm(spec)))[1])
    side = "front" if z < 0.0 else "back"
    index = medium.index_at(spec.media, side, spec.pattern.wavelength_nm)
    sine = float(np.hypot(x, y)) / index
    if not sine < 1.0:
        return straight
    theta, phi = np.degrees(np.arcsin(sine)), np.degrees(np.arctan2(y, x))
    return Angles(float(theta), float(phi), from_front=side == "front", words="the reference wave")
