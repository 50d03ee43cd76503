# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the grating of a document (um) to the layers and materials of the core (SI)."""

import math
from typing import TYPE_CHECKING

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import SpecError
from ...core.material import IndexWave, Material
from ...core.rcwa import reliefs
from ...core.rcwa.convergence import DEFAULT_MAXIMUM
from ...core.rcwa.profiles import Polygon, polygon_layers
from ...core.rcwa.stack import FRONT, Lamellar, Layer, Repeat, Stack, Uniform
from ...core.rcwa.volume import volume_layers
from ...core.units import UM
from .optical_index import material_from
from .rcwa_layers import LayersProfile
from .rcwa_profile import (
    BinaryProfile,
    PolygonProfile,
    ProfileSpec,
    SampledProfile,
    SawtoothProfile,
    SinusoidProfile,
    SlantedProfile,
    StaircaseProfile,
    TriangleProfile,
    VolumeProfile,
)

if TYPE_CHECKING:
    from .rcwa import CoatingSpec, RcwaSpec

type _Layers = tuple[Layer | Repeat, ...]

FIRST = FRONT + 1
"""Place of the first material of a document; those before it are the half spaces."""
MOST_FRINGES = 5000
"""Slanted fringes from the back of a volume grating to its front; each is many layers."""
_FEWEST_SLICES = 16
"""Automatic slices are no fewer, however few the harmonics."""
_MOST_AUTO = 129
"""Automatic harmonics of a profile that is cut into as many slices: 10 s for one ray of a metal.
More harmonics with the same slices would settle on a wrong result."""


def materials_from(spec: "RcwaSpec") -> tuple[Material | IndexWave, ...]:
    """List the materials of a grating.

    Args:
        spec: The grating.

    Returns:
        The materials that `stack_from` counts from `FIRST` on: those of the layers under the
        profile, of the profile, and of the layers over it.
    """
    return (*_coatings(spec, "under"), *_profile_materials(spec), *_coatings(spec, "over"))


def _coatings(spec: "RcwaSpec", side: str) -> list[Material]:
    layers: tuple[CoatingSpec, ...] = getattr(spec, side)
    return [
        material_from(layer.index, f"efficiency.{side}[{place}].index")
        for place, layer in enumerate(layers)
    ]


def _profile_materials(spec: "RcwaSpec") -> list[Material | IndexWave]:
    profile = spec.profile
    if isinstance(profile, VolumeProfile):
        mean = material_from(profile.index, "efficiency.profile.index")
        return [mean, IndexWave(mean, profile.modulation)]
    if isinstance(profile, LayersProfile):
        return [
            material_from(segment.index, f"efficiency.profile.layers[{i}].segments[{j}].index")
            for i, layer in enumerate(profile.layers)
            for j, segment in enumerate(layer.segments)
        ]
    ridge, groove = spec.ridge, spec.groove
    assert ridge is not None and groove is not None  # the spec has checked it
    return [material_from(ridge, "efficiency.ridge"), material_from(groove, "efficiency.groove")]


def stack_from(spec: "RcwaSpec", frequency: float, harmonics: int) -> Stack:
    """Make the layers of a grating where it has a certain frequency.

    Args:
        spec: The grating.
        frequency: Cycles per metre along x, at least 0. At 0 there is no grating along x, and a
            volume grating has its fringes along the surface.
        harmonics: Number of harmonics; with automatic slices there are as many of these.

    Returns:
        The layers from the back to the front.
    """
    slices = spec.slices if isinstance(spec.slices, int) else max(harmonics, _FEWEST_SLICES)
    place = FIRST
    under = _plane_layers(spec.under, place)
    place += len(spec.under)
    profile = _profile_layers(spec.profile, slices, frequency, place)
    place += len(_profile_materials(spec))
    return Stack((*under, *profile, *_plane_layers(spec.over, place)))


def most_harmonics(spec: "RcwaSpec") -> int:
    """Give the number of harmonics at which a search has to end, so that it ends in some seconds.

    The work grows with the number of layers that differ, and with the harmonics cubed.

    Args:
        spec: The grating.

    Returns:
        An odd number.
    """
    match spec.profile:
        case BinaryProfile() | SlantedProfile() | VolumeProfile():
            return DEFAULT_MAXIMUM  # moved copies of one layer
        case StaircaseProfile(levels=count):
            pass
        case LayersProfile(layers=layers):
            count = len(layers)
        case _:
            count = spec.slices if isinstance(spec.slices, int) else _MOST_AUTO
    most = _MOST_AUTO * (_MOST_AUTO / count) ** (1.0 / 3.0)
    return min(DEFAULT_MAXIMUM, 2 * math.floor(0.5 * most) + 1)


def _plane_layers(layers: "tuple[CoatingSpec, ...]", first: int) -> list[Layer]:
    return [
        Layer(Uniform(first + place), layer.thickness_um * UM) for place, layer in enumerate(layers)
    ]


def _profile_layers(profile: ProfileSpec, slices: int, frequency: float, place: int) -> _Layers:
    if isinstance(profile, VolumeProfile):
        return _volume(profile, frequency, place)
    if isinstance(profile, LayersProfile):
        return _segments(profile, place)
    return _relief(profile, slices, frequency, place, place + 1)


def _volume(profile: VolumeProfile, frequency: float, place: int) -> _Layers:
    along_z = 0.0
    if profile.normal_period_um is not None:
        along_z = 1.0 / (profile.normal_period_um * UM)
    elif profile.slant_deg is not None:
        along_z = -math.tan(math.radians(profile.slant_deg)) * frequency
    thickness = profile.thickness_um * UM
    fringes = abs(along_z) * thickness
    if frequency > 0.0 and fringes > MOST_FRINGES:
        rule = f"must have at most {MOST_FRINGES} fringes along the normal"
        raise SpecError(f"efficiency.profile: {rule}, got {fringes:.6g}")
    return volume_layers(thickness, along_z, mean=place, wave=place + 1, plane=frequency == 0.0)


def _segments(profile: LayersProfile, place: int) -> _Layers:
    layers: list[Layer] = []
    for layer in profile.layers:
        count = len(layer.segments)
        materials = tuple(range(place, place + count))
        place += count
        widths = [segment.width for segment in layer.segments]
        walls = np.concatenate(([0.0], np.cumsum(widths[:-1])))
        pattern = Uniform(materials[0]) if count == 1 else Lamellar(walls, materials)
        layers.append(Layer(pattern, layer.thickness_um * UM))
    return tuple(layers)


def _relief(
    profile: ProfileSpec, slices: int, frequency: float, ridge: int, groove: int
) -> _Layers:
    two = {"ridge": ridge, "groove": groove}
    match profile:
        case BinaryProfile():
            return reliefs.binary(profile.depth_um * UM, profile.duty, **two)
        case SawtoothProfile():
            return reliefs.triangle(profile.depth_um * UM, slices, 1.0, **two)
        case TriangleProfile():
            return reliefs.triangle(profile.depth_um * UM, slices, profile.peak, **two)
        case SinusoidProfile():
            return reliefs.sinusoid(profile.depth_um * UM, slices, **two)
        case StaircaseProfile():
            return reliefs.staircase(profile.depth_um * UM, profile.levels, **two)
        case SlantedProfile():
            depth = profile.depth_um * UM
            move = math.tan(math.radians(profile.slant_deg)) * depth * frequency
            foot, top = (0.0, profile.duty), (move, profile.duty + move)
            return reliefs.trapezoid(depth, foot, top, slices, **two)
        case PolygonProfile():
            return _polygon(profile.points, slices, ridge, groove)
        case SampledProfile():
            highest = max(profile.heights_um)
            shares: FloatArray = np.asarray(profile.heights_um) / highest
            return reliefs.sampled(highest * UM, shares, slices, **two)
        case LayersProfile() | VolumeProfile():
            return ()


def _polygon(
    points: tuple[tuple[float, float], ...], slices: int, ridge: int, groove: int
) -> _Layers:
    corners = np.asarray(points, dtype=np.float64) * (1.0, UM)
    layers = polygon_layers([Polygon(corners, ridge)], groove, slices, checked=True)
    lowest = float(corners[:, 1].min())
    foot = (Layer(Uniform(groove), lowest),) if lowest > 0.0 else ()
    return (*foot, *layers)
