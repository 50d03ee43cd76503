# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light that a check takes where none is asked for."""

import numpy as np

from ...core.arrays import FloatArray
from ...core.units import nm_to_m
from .. import medium
from ..efficiency import KogelnikSpec, RcwaSpec
from ..hologram import HologramSpec
from ..recording import RecordingSpec
from .fringes import Fringes, of_kogelnik, of_rcwa
from .light import Angles, light_on, reference_light

_ROUNDED = 1e-4
"""Fringes that are too narrow by this share, as written with few digits, count as on Bragg."""


def usual_light(spec: HologramSpec, at_mm: FloatArray | None = None) -> Angles:
    """Choose light that a hologram is meant for.

    Args:
        spec: The hologram.
        at_mm: The place on the surface, mm, shape ``(3,)``; None is the centre.

    Returns:
        The reference wave of a recording; for the fringes of a volume grating without one, light
        whose order +1 is on Bragg at the wavelength of the pattern; else light along the normal.
    """
    if isinstance(spec.pattern, RecordingSpec):
        return reference_light(spec, at_mm)
    lit = light_on(spec, [spec.pattern.wavelength_nm], [0.0], [0.0], from_front=False, at_mm=at_mm)
    fringes = None
    if isinstance(spec.efficiency, KogelnikSpec):
        fringes = of_kogelnik(spec.efficiency, lit.incidence)
    elif isinstance(spec.efficiency, RcwaSpec):
        fringes = of_rcwa(spec.efficiency, lit.incidence)
    if fringes is not None:
        x, y = (float(part) for part in lit.gradient[0, :2])
        azimuth = float(np.degrees(np.arctan2(y, x))) if fringes.along > 0.0 else 0.0
        for side in ("back", "front"):
            theta = _bragg_deg(spec, fringes, side)
            if theta is not None:
                return Angles(theta, azimuth, from_front=side == "front", words="on Bragg")
    return Angles(0.0, 0.0, from_front=False, words="along the normal")


def _bragg_deg(spec: HologramSpec, fringes: Fringes, side: str) -> float | None:
    """Angle in the plane of K and the normal, in the medium of a side, at which +1 is on Bragg.

    With K at the angle delta from the normal that the light follows, 2 rho.K + K.K = 0 is
    cos(theta - delta) = -lambda |K| / (4 pi n).
    """
    wavelength = float(nm_to_m(spec.pattern.wavelength_nm))
    index = float(fringes.index.index(wavelength).real)
    cosine = -wavelength / (2.0 * index * fringes.period)
    if cosine < -1.0 - _ROUNDED:
        return None
    along_z = -fringes.normal if side == "front" else fringes.normal
    delta, turn = float(np.arctan2(fringes.along, along_z)), float(np.arccos(max(cosine, -1.0)))
    outside = medium.index_at(spec.media, side, spec.pattern.wavelength_nm)
    angles = ((delta + sign * turn + np.pi) % (2.0 * np.pi) - np.pi for sign in (-1.0, 1.0))
    sines = [index * float(np.sin(angle)) / outside for angle in angles if abs(angle) < 0.5 * np.pi]
    kept = sorted((sine for sine in sines if abs(sine) < 1.0), key=abs)
    return float(np.degrees(np.arcsin(kept[0]))) if kept else None
