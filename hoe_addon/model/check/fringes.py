# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fringes of a volume hologram at the centre of the element, as they are after development."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.incidence import Incidence
from ...core.material import Material
from ...core.units import MM, UM, m_to_nm, nm_to_m
from ..efficiency import KogelnikSpec, RcwaSpec, varying
from ..efficiency.optical_index import OpticalIndex, OwnIndex, material_from
from ..efficiency.rcwa_profile import VolumeProfile
from ..medium import MediumRef, SellmeierMedium, medium_from


@dataclass(frozen=True, eq=False)
class Fringes:
    """One thick grating.

    Attributes:
        thickness: Metres.
        modulation: Amplitude of the index.
        along: Tangential part of K / (2 pi), 1/m.
        normal: Normal part of K / (2 pi), 1/m, toward the front.
        index: Material of the layer.
    """

    thickness: float
    modulation: float
    along: float
    normal: float
    index: Material

    @property
    def period(self) -> float:
        """Distance of the fringes, 2 pi / |K|, metres."""
        size = float(np.hypot(self.along, self.normal))
        return 1.0 / size if size > 0.0 else np.inf

    def ray(self, light: Incidence) -> FloatArray:
        """Vectors n s inside the layer, z counted up, shape ``(N, 3)``; NaN where it stays out."""
        inside = self.index.index(light.wavelength).real
        squared = inside**2 - np.sum(light.tangential**2, axis=-1)
        normal = np.sqrt(np.where(squared > 0.0, squared, np.nan))
        return np.concatenate((light.tangential, normal[:, None]), axis=-1)


def of_kogelnik(spec: KogelnikSpec, light: Incidence) -> Fringes | None:
    """The fringes of the main exposure at the place of the light.

    Args:
        spec: The model.
        light: Light at the centre, at least one ray.

    Returns:
        The fringes; None where nothing is recorded there.
    """
    wavelengths = light.wavelength
    along, normal = float(light.frequency.flat[0]), 0.0
    if light.waves is not None:
        recorded = light.waves.wavelength
        index = float(medium_from(spec.index).index(recorded))
        waves = (light.waves.object, light.waves.reference)
        first, second = (_normal_part(wave.reshape(-1, 3)[0], index) for wave in waves)
        normal = (first - second) / recorded
    elif spec.normal_period_um is not None:
        normal = 1.0 / (spec.normal_period_um * UM)
    if not np.isfinite(along + normal):
        return None
    place = light.place.reshape(-1, 2)[:1]
    kept = 1.0 - spec.shrinkage
    return Fringes(
        thickness=_here(varying.quantity(spec.thickness_um, UM), place) * kept,
        modulation=_here(varying.quantity(spec.modulation, 1.0), place),
        along=along,
        normal=normal / kept,
        index=material_from(developed_index(spec, wavelengths), "efficiency.index"),
    )


def of_rcwa(spec: RcwaSpec, light: Incidence) -> Fringes | None:
    """The fringes of a rigorous volume grating at the place of the light.

    Args:
        spec: The model.
        light: Light at the centre, at least one ray.

    Returns:
        The fringes; None for a relief, for layers, and where nothing is recorded.
    """
    profile, along = spec.profile, float(light.frequency.flat[0])
    if not isinstance(profile, VolumeProfile) or not np.isfinite(along):
        return None
    normal = 0.0
    if profile.normal_period_um is not None:
        normal = 1.0 / (profile.normal_period_um * UM)
    elif profile.slant_deg is not None:
        normal = -along * float(np.tan(np.radians(profile.slant_deg)))
    return Fringes(
        thickness=profile.thickness_um * UM,
        modulation=profile.modulation,
        along=along,
        normal=normal,
        index=material_from(profile.index, "efficiency.profile.index"),
    )


def developed_index(spec: KogelnikSpec, wavelengths: FloatArray) -> OpticalIndex:
    """The index of an emulsion after development, absorption included.

    Args:
        spec: The model.
        wavelengths: Where it is needed, metres, any shape.

    Returns:
        The material; where development changes it, a table that is exact at the wavelengths.
    """
    if spec.index_shift == 0.0 and spec.absorption_per_mm == 0.0:
        return as_optical(spec.index)
    nodes = np.unique(m_to_nm(wavelengths))
    if len(nodes) == 1:
        nodes = np.append(nodes, nodes + 1.0)
    index = medium_from(spec.index).index(nm_to_m(nodes)) + spec.index_shift
    loss = spec.absorption_per_mm / MM * nm_to_m(nodes) / (2.0 * np.pi)
    rows = zip(nodes.tolist(), index.tolist(), loss.tolist(), strict=True)
    return OwnIndex(table=tuple(rows))


def as_optical(ref: MediumRef) -> OpticalIndex:
    """A medium as the rigorous model's materials are written."""
    return OwnIndex(sellmeier=ref.sellmeier) if isinstance(ref, SellmeierMedium) else ref


def as_medium(ref: OpticalIndex) -> MediumRef | None:
    """A material as a transparent medium; None where it is none."""
    if isinstance(ref, str):
        return ref
    if not isinstance(ref, OwnIndex):
        return ref if ref >= 1.0 else None
    if ref.sellmeier is not None:
        return SellmeierMedium(ref.sellmeier)
    return ref.n if ref.n is not None and ref.n >= 1.0 and ref.k == 0.0 else None


def _here(quantity: varying.Quantity, place: FloatArray) -> float:
    return float(quantity(place)[0]) if callable(quantity) else quantity


def _normal_part(wave: FloatArray, index: float) -> float:
    """Normal part of n s inside the emulsion; NaN where the wave does not get in."""
    squared = index**2 - float(wave[0] ** 2 + wave[1] ** 2)
    size = float(np.sqrt(squared)) if squared >= 0.0 else np.nan
    return -size if wave[2] < 0.0 else size
