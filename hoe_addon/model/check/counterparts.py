# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A grating of one model written as that of another; SpecError tells why one cannot be."""

import numpy as np

from ...core.efficiency.profiles import Profile, Sawtooth
from ...core.errors import SpecError
from ...core.units import UM, nm_to_m
from ..efficiency import KinoformSpec, KogelnikSpec, RcwaSpec
from ..efficiency.rcwa_profile import (
    MOST_LEVELS,
    BinaryProfile,
    PolygonProfile,
    ProfileSpec,
    SampledProfile,
    SawtoothProfile,
    SinusoidProfile,
    StaircaseProfile,
    TriangleProfile,
    VolumeProfile,
)
from ..efficiency.relief_shapes import (
    BinaryRelief,
    ReliefShape,
    SampledRelief,
    SawtoothRelief,
    SinusoidRelief,
    TriangleRelief,
)
from ..hologram import HologramSpec
from ..medium import index_at, medium_from
from .fringes import as_medium, as_optical, developed_index, of_kogelnik, of_rcwa
from .light import Lit
from .relief import outline, pieces_of

_MOST_PIECES = 400
"""Straight pieces of a relief that a polygon may stand for."""
_UPRIGHT = 1e-6
"""Fringes that turn by less than this share of a period through the layer stand upright."""
_NM_PER_UM = 1e3


def rcwa_of_kinoform(spec: HologramSpec, own: KinoformSpec, lit: Lit) -> RcwaSpec:
    """Write a thin relief as a cross-section.

    Args:
        spec: The hologram.
        own: Its model.
        lit: The light of the check.

    Returns:
        The rigorous model: the relief stands on the medium whose index is nearer to its own, in
        air.

    Raises:
        SpecError: The relief has too many pieces, or there is none at the centre.
    """
    if not np.all(lit.incidence.frequency > 0.0):
        raise SpecError("nothing is recorded at the centre")
    index = index_at(own, "relief", own.design_wavelength_nm)
    depth_um = own.made_depth_waves * own.design_wavelength_nm / (index - 1.0) / _NM_PER_UM
    away = [
        abs(index_at(spec.media, side, spec.pattern.wavelength_nm) - index)
        for side in ("back", "front")
    ]
    pieces = pieces_of(_drawable(own.made_profile()))
    if pieces.pieces > _MOST_PIECES:
        raise SpecError(f"the relief has {pieces.pieces} pieces, more than {_MOST_PIECES}")
    corners = outline(pieces, depth_um, on_front=away[1] < away[0])
    profile = PolygonProfile(tuple(corners))
    return RcwaSpec(profile=profile, ridge=as_optical(own.relief), groove=1.0)


def _drawable(profile: Profile) -> Profile:
    """A relief of very many levels is drawn as the continuous one that it is close to."""
    if isinstance(profile, Sawtooth) and profile.levels > MOST_LEVELS:
        return Sawtooth(edge_width=profile.edge_width)
    return profile


def rcwa_of_kogelnik(own: KogelnikSpec, lit: Lit) -> RcwaSpec:
    """Write a volume hologram, as it is at the centre of the element, as layers.

    Args:
        own: The model.
        lit: The light of the check.

    Returns:
        The rigorous model.

    Raises:
        SpecError: It has several exposures, fringes that absorb, or none at all.
    """
    if own.exposures:
        raise SpecError("several gratings in one emulsion have no common period")
    if own.absorption_modulation_per_mm != 0.0:
        raise SpecError("the volume profile of rcwa has fringes of the index alone")
    fringes = of_kogelnik(own, lit.incidence)
    if fringes is None or fringes.modulation == 0.0:
        raise SpecError("nothing is recorded at the centre")
    upright = abs(fringes.normal) * fringes.thickness < _UPRIGHT
    return RcwaSpec(
        profile=VolumeProfile(
            thickness_um=fringes.thickness / UM,
            index=developed_index(own, lit.incidence.wavelength),
            modulation=fringes.modulation,
            normal_period_um=None if upright else 1.0 / fringes.normal / UM,
        )
    )


def kogelnik_of_rcwa(own: RcwaSpec, lit: Lit) -> KogelnikSpec:
    """Write a rigorous volume grating for two-wave theory; coatings are left out.

    Args:
        own: The model, with a volume profile.
        lit: The light of the check.

    Returns:
        The two-wave model of the grating as it is at the centre of the element.

    Raises:
        SpecError: The layer absorbs, or nothing is recorded at the centre.
    """
    fringes = of_rcwa(own, lit.incidence)
    if fringes is None or not isinstance(own.profile, VolumeProfile):
        raise SpecError("nothing is recorded at the centre")
    index = as_medium(own.profile.index)
    if index is None:
        raise SpecError("the layer is no transparent medium with an index of at least 1")
    upright = abs(fringes.normal) * fringes.thickness < _UPRIGHT
    return KogelnikSpec(
        thickness_um=own.profile.thickness_um,
        index=index,
        modulation=fringes.modulation,
        normal_period_um=None if upright else 1.0 / fringes.normal / UM,
        # The rigorous solution knows of total reflection.
        total_internal_reflection=True,
    )


def kinoform_of_rcwa(spec: HologramSpec, own: RcwaSpec) -> KinoformSpec:
    """Write a relief for scalar theory; coatings are left out.

    Args:
        spec: The hologram.
        own: Its model.

    Returns:
        The scalar model.

    Raises:
        SpecError: The cross-section is no relief in air that scalar theory knows.
    """
    shape, levels, depth_um = _thin(own.profile)
    relief = None if own.ridge is None else as_medium(own.ridge)
    if relief is None:
        raise SpecError("the ridge is no transparent medium with an index of at least 1")
    if own.groove not in (1.0, "air"):
        raise SpecError("the kinoform is a relief in air, but the groove is not air")
    at_nm = spec.pattern.wavelength_nm
    waves = depth_um * _NM_PER_UM * (float(medium_from(relief).index(nm_to_m(at_nm))) - 1.0) / at_nm
    return KinoformSpec(
        levels=levels,
        design_wavelength_nm=at_nm,
        relief=relief,
        depth_waves=waves,
        profile=shape,
    )


def _thin(profile: ProfileSpec) -> tuple[ReliefShape, int, float]:
    """Shape, levels and depth of a profile in scalar theory."""
    match profile:
        case SawtoothProfile():
            return SawtoothRelief(), 0, profile.depth_um
        case StaircaseProfile():
            return SawtoothRelief(), profile.levels, profile.depth_um
        case SinusoidProfile():
            return SinusoidRelief(), 0, profile.depth_um
        case BinaryProfile():
            return BinaryRelief(profile.duty), 0, profile.depth_um
        case TriangleProfile():
            return TriangleRelief(profile.peak), 0, profile.depth_um
        case SampledProfile():
            highest = max(profile.heights_um)
            heights = tuple(height / highest for height in profile.heights_um)
            return SampledRelief(heights=heights), 0, highest
        case _:
            shape = type(profile).__struct_config__.tag
            raise SpecError(f"scalar theory knows no profile of the shape {shape}")
