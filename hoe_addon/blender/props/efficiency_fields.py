# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The usual numbers of efficiency models, as properties that are fields of their texts."""

from ...model.efficiency.common import LEAST_TOLERANCE, MOST_TOLERANCE, WIDEST_DEG
from ...model.efficiency.haze import ROUGHEST_NM
from ...model.efficiency.haze import WIDEST_DEG as WIDEST_HAZE_DEG
from ..ids import Choice
from . import detail_media as media
from .detail_fields import Field, choice, flag, number, word
from .detail_fitting import fit_relief
from .detail_switches import either, presence, varies
from .rcwa_fields import RcwaFields

_SHARE = {"step": 1, "precision": 4}
_LENGTH = {"step": 10, "precision": 4}


class ReliefShape(Choice):
    """Shapes of one period of a thin relief."""

    SAWTOOTH = "sawtooth", 0, "Sawtooth", "A blazed relief, continuous or in levels"
    BINARY = "binary", 1, "Binary", "Ridges with upright walls"
    SINUSOID = "sinusoid", 2, "Sinusoid", "A smooth wave"
    TRIANGLE = "triangle", 3, "Triangle", "Rises straight and falls straight"
    SAMPLED = "sampled", 4, "Heights", "Heights at equal steps, from the document or a file"


class Beyond(Choice):
    """What holds outside a table."""

    CLAMP = "clamp", 0, "Nearest", "The nearest shares of the table"
    ZERO = "zero", 1, "Nothing", "No light goes into any order"


def _kinoform(path: str) -> Field:
    return Field("kinoform_details", path)


def _kogelnik(path: str) -> Field:
    return Field("kogelnik_details", path)


def _common(path: str) -> Field:
    return Field("common_details", path)


class KinoformFields:
    """Of a thin relief."""

    relief_shape: choice(
        _kinoform("profile.shape"),
        "Shape",
        "Shape of one period of the relief",
        ReliefShape,
        ReliefShape.SAWTOOTH,
        fit_relief,
    )
    relief_duty: number(
        _kinoform("profile.duty"),
        "Duty Cycle",
        "Share of the period that the ridge takes, from 0 to 1",
        0.5,
        (0.001, 0.999),
        **_SHARE,
    )
    relief_peak: number(
        _kinoform("profile.peak"),
        "Peak",
        "Place of the ridge in the period, from 0 to 1",
        0.5,
        (0.001, 0.999),
        **_SHARE,
    )
    relief_depth_waves: number(
        _kinoform("depth_waves"),
        "Depth",
        "Depth at the design wavelength, in waves; 1 sends all light into one order",
        1.0,
        (1e-6, 100.0),
        soft_max=4.0,
        step=1,
        precision=3,
    )
    relief_angle_dependent: flag(
        _kinoform("angle_dependent"),
        "Depth Follows Angle",
        "Whether light that comes in aslant sees another depth",
        default=True,
    )
    relief_depth_error: number(
        _kinoform("errors.depth_error"),
        "Depth Error",
        "Relative error of the depth: 0.05 is 5 % too deep",
        0.0,
        (-0.99, 1.0),
        soft_min=-0.2,
        soft_max=0.2,
        **_SHARE,
    )
    relief_edge_width: number(
        _kinoform("errors.edge_width"),
        "Edge Width",
        "Share of the period that each wall takes instead of being upright",
        0.0,
        (0.0, 0.5),
        **_SHARE,
    )


class KogelnikFields:
    """Of a volume hologram."""

    volume_thickness_um: number(
        _kogelnik("thickness_um"),
        "Thickness",
        "Thickness of the emulsion when it was exposed, in micrometres",
        10.0,
        (1e-6, 1e6),
        soft_min=0.5,
        soft_max=100.0,
        **_LENGTH,
    )
    volume_thickness_varies: varies(
        _kogelnik("thickness_um"), "Thickness Varies", "Give the thickness as a formula", 10.0
    )
    volume_thickness_formula: word(
        _kogelnik("thickness_um.formula"),
        "Thickness",
        "Thickness in micrometres as a formula of x, y, r (in mm) and phi",
    )
    volume_index_kind: media.medium_kind(
        _kogelnik("index"), "Emulsion", "How the index of the emulsion is given", 1.5
    )
    volume_index: number(
        _kogelnik("index"),
        "Index",
        "Mean refractive index of the emulsion",
        1.5,
        (1.0, 10.0),
        soft_max=2.5,
        **_SHARE,
    )
    volume_index_name: media.medium_name(_kogelnik("index"))
    volume_modulation: number(
        _kogelnik("modulation"),
        "Modulation",
        "Amplitude of the refractive index, such as 0.02; more diffracts more, up to a limit",
        0.02,
        (0.0, 1.0),
        soft_max=0.1,
        step=0.1,
        precision=5,
    )
    volume_modulation_varies: varies(
        _kogelnik("modulation"), "Modulation Varies", "Give the modulation as a formula", 0.02
    )
    volume_modulation_formula: word(
        _kogelnik("modulation.formula"),
        "Modulation",
        "Amplitude of the index as a formula of x, y, r (in mm) and phi",
    )
    volume_shrinkage: number(
        _kogelnik("shrinkage"),
        "Shrinkage",
        "Share of the thickness that development takes away; below 0 it swells",
        0.0,
        (-0.5, 0.5),
        soft_min=-0.1,
        soft_max=0.1,
        **_SHARE,
    )
    volume_index_shift: number(
        _kogelnik("index_shift"),
        "Index Shift",
        "What development adds to the mean index",
        0.0,
        (-0.5, 0.5),
        soft_min=-0.05,
        soft_max=0.05,
        **_SHARE,
    )
    volume_absorption_per_mm: number(
        _kogelnik("absorption_per_mm"),
        "Absorption",
        "Absorption of the amplitude, per mm",
        0.0,
        (0.0, 1e6),
        soft_max=50.0,
        **_LENGTH,
    )
    volume_is_slanted: presence(
        _kogelnik("normal_period_um"),
        "Slanted Fringes",
        "Whether the fringes have a period along the normal; else they stand upright",
        0.25,
    )
    volume_normal_period_um: number(
        _kogelnik("normal_period_um"),
        "Normal Period",
        "Period of the fringes along the normal, in micrometres; its sign tells which way they "
        "slant",
        0.25,
        soft_min=-10.0,
        soft_max=10.0,
        **_LENGTH,
    )


class TableFields:
    """Of a table, in a file or made of a model."""

    table_file: word(
        Field("table_details", "file"),
        "File",
        "Shares by wavelength and direction: an .npz, .csv, .txt, .bsdf or .exr file",
        subtype="FILE_PATH",
    )
    table_has_beyond: presence(
        Field("table_details", "beyond"),
        "Own Rule Beyond",
        "Say here what holds outside the wavelengths and angles of the table, not in the file",
        Beyond.CLAMP.value,
    )
    table_beyond: choice(
        Field("table_details", "beyond"),
        "Beyond the Table",
        "What holds outside the wavelengths and angles of the table",
        Beyond,
        Beyond.CLAMP,
    )
    lookup_tolerance: number(
        _common("lookup.tolerance"),
        "Tolerance",
        "Largest error of a share in the table that the shader looks up; less takes longer to bake",
        1e-3,
        (LEAST_TOLERANCE, MOST_TOLERANCE),
        step=0.1,
        precision=5,
    )
    lookup_angle_deg: number(
        _common("lookup.angle_deg"),
        "Widest Angle",
        "Largest angle to the normal that the table is made for, in degrees",
        WIDEST_DEG,
        (1.0, WIDEST_DEG),
        step=100,
        precision=1,
    )


class HazeFields:
    """Of scattering."""

    has_haze: presence(
        _common("haze"),
        "Haze",
        "Whether a share of each order is scattered around its direction",
        {"width_deg": 0.5, "share": 0.1},
    )
    haze_width_deg: number(
        _common("haze.width_deg"),
        "Width",
        "Standard deviation of the scattered light around each order, in degrees",
        0.5,
        (1e-6, WIDEST_HAZE_DEG),
        soft_max=5.0,
        step=10,
        precision=3,
    )
    haze_is_rough: either(
        _common("haze"),
        "From Roughness",
        "Work the share out from the roughness of the surface, for each wavelength and angle",
        ("share", 0.1),
        ("roughness_nm", 10.0),
    )
    haze_share: number(
        _common("haze.share"),
        "Share",
        "Share of each order that is scattered, from 0 to 1",
        0.1,
        (0.0, 1.0),
        **_SHARE,
    )
    haze_roughness_nm: number(
        _common("haze.roughness_nm"),
        "Roughness",
        "Root mean square of the roughness that scatters, in nm",
        10.0,
        (0.0, ROUGHEST_NM),
        soft_max=200.0,
        step=10,
        precision=2,
    )


class EfficiencyFields(KinoformFields, KogelnikFields, RcwaFields, TableFields, HazeFields):
    """All of them."""
