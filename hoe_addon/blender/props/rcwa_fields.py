# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The usual numbers of a rigorous grating, as properties that are fields of its text."""

from ..ids import Choice
from . import detail_media as media
from .detail_fields import Field, choice, number, whole
from .detail_fitting import fit_profile

_SHARE = {"step": 1, "precision": 4}
_LENGTH = {"step": 10, "precision": 4}


class ProfileShape(Choice):
    """Cross-sections of a rigorous grating."""

    BINARY = "binary", 0, "Binary", "Ridges with upright walls"
    SAWTOOTH = "sawtooth", 1, "Sawtooth", "A blazed relief with an upright wall"
    SINUSOID = "sinusoid", 2, "Sinusoid", "A smooth wave"
    TRIANGLE = "triangle", 3, "Triangle", "Rises straight and falls straight"
    STAIRCASE = "staircase", 4, "Staircase", "A sawtooth in equal steps"
    SLANTED = "slanted", 5, "Slanted", "Ridges with two parallel walls that lean"
    POLYGON = "polygon", 6, "Polygon", "Any outline, by its corners in the document"
    SAMPLED = "sampled", 7, "Heights", "Heights at equal steps, in the document"
    LAYERS = "layers", 8, "Layers", "Layers of upright walls, in the document"
    VOLUME = "volume", 9, "Volume", "Fringes of the index in a layer"


def _rcwa(path: str) -> Field:
    return Field("rcwa_details", path)


class RcwaFields:
    """Of a rigorous grating."""

    profile_shape: choice(
        _rcwa("profile.shape"),
        "Profile",
        "Cross-section of the grating",
        ProfileShape,
        ProfileShape.BINARY,
        fit_profile,
    )
    profile_depth_um: number(
        _rcwa("profile.depth_um"),
        "Depth",
        "Height of the relief, in micrometres",
        0.5,
        (1e-6, 1e4),
        soft_max=5.0,
        **_LENGTH,
    )
    profile_duty: number(
        _rcwa("profile.duty"),
        "Duty Cycle",
        "Share of the period that the ridge takes, from 0 to 1",
        0.5,
        (0.001, 0.999),
        **_SHARE,
    )
    profile_peak: number(
        _rcwa("profile.peak"),
        "Peak",
        "Place of the ridge in the period, from 0 to 1",
        0.5,
        (0.001, 0.999),
        **_SHARE,
    )
    profile_levels: whole(
        _rcwa("profile.levels"), "Levels", "Number of steps", 4, (2, 256), soft_max=16
    )
    profile_slant_deg: number(
        _rcwa("profile.slant_deg"),
        "Slant",
        "Angle of walls or fringes from the normal, in degrees",
        0.0,
        (-88.9, 88.9),
        step=100,
        precision=2,
    )
    profile_thickness_um: number(
        _rcwa("profile.thickness_um"),
        "Thickness",
        "Thickness of the layer, in micrometres",
        10.0,
        (1e-6, 1e4),
        soft_max=100.0,
        **_LENGTH,
    )
    profile_modulation: number(
        _rcwa("profile.modulation"),
        "Modulation",
        "Amplitude of the refractive index",
        0.02,
        (1e-9, 1.0),
        soft_max=0.1,
        step=0.1,
        precision=5,
    )
    profile_index_kind: media.medium_kind(
        _rcwa("profile.index"), "Layer", "How the index of the layer is given", 1.5
    )
    profile_index: number(
        _rcwa("profile.index"),
        "Index",
        "Mean refractive index",
        1.5,
        (1e-6, 100.0),
        soft_min=1.0,
        soft_max=3.0,
        **_SHARE,
    )
    profile_index_name: media.medium_name(_rcwa("profile.index"))
    ridge_kind: media.medium_kind(_rcwa("ridge"), "Ridge", "What the ridges are made of", 1.5)
    ridge_index: number(
        _rcwa("ridge"),
        "Index",
        "Refractive index of the ridges",
        1.5,
        (1e-6, 100.0),
        soft_min=1.0,
        soft_max=3.0,
        **_SHARE,
    )
    ridge_name: media.medium_name(_rcwa("ridge"))
    groove_kind: media.medium_kind(_rcwa("groove"), "Groove", "What fills the grooves", 1.0)
    groove_index: number(
        _rcwa("groove"),
        "Index",
        "Refractive index of what fills the grooves",
        1.0,
        (1e-6, 100.0),
        soft_min=1.0,
        soft_max=3.0,
        **_SHARE,
    )
    groove_name: media.medium_name(_rcwa("groove"))
