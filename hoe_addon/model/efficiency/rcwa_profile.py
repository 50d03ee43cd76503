# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cross-sections of a grating as documents write them, told apart by ``shape``.

x runs along the grating vector Q, the way that order +1 is turned, and is counted in periods; the
period at a point of the element is lambda_0 / |tangential grad V| there. z runs from the back to
the front, in micrometres, and is 0 at the foot of the profile. A relief has the material ``ridge``
below its height, or inside its polygon, and ``groove`` in the rest of its depth.
"""

import numpy as np
from msgspec import Struct

from ...core.errors import SpecError
from ...core.rcwa.crossing import check_simple
from .. import fields
from ..field_error import FieldError
from . import optical_index
from .lists import rows
from .optical_index import OpticalIndex
from .rcwa_layers import DEEPEST_UM, LayersProfile

STEEPEST_DEG = 89.0
LEAST_PERIOD_UM = 0.01
MOST_LEVELS = 256
MOST_POINTS = 1000


class _Depth(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="shape"):
    """A relief of one depth.

    Attributes:
        depth_um: Height from the foot to the top, micrometres.
    """

    depth_um: float

    def __post_init__(self) -> None:
        """Check the depth."""
        fields.number(self, "depth_um", above=0.0, at_most=DEEPEST_UM)


class BinaryProfile(_Depth, frozen=True, tag="binary"):
    """Ridges with upright walls.

    Attributes:
        duty: Share of the period that the ridge takes.
    """

    duty: float = 0.5

    def __post_init__(self) -> None:
        """Check depth and duty."""
        super().__post_init__()
        between(self, "duty", 0.0, 1.0)


class SawtoothProfile(_Depth, frozen=True, tag="sawtooth"):
    """A blazed relief that rises along Q from 0 to its depth, with an upright wall."""


class SinusoidProfile(_Depth, frozen=True, tag="sinusoid"):
    """A relief of the height depth * (1 + cos(2 pi x)) / 2."""


class TriangleProfile(_Depth, frozen=True, tag="triangle"):
    """A relief that rises to its ridge and falls again.

    Attributes:
        peak: Place of the ridge, in periods, between 0 and 1.
    """

    peak: float = 0.5

    def __post_init__(self) -> None:
        """Check depth and peak."""
        super().__post_init__()
        between(self, "peak", 0.0, 1.0)


class StaircaseProfile(_Depth, frozen=True, kw_only=True, tag="staircase"):
    """A sawtooth in equal steps: the heights are depth * j / N for j = 0 .. N - 1.

    So depth_um is that of the sawtooth it stands for, and the top step lies one step below it.

    Attributes:
        levels: Number N of steps.
    """

    levels: int

    def __post_init__(self) -> None:
        """Check depth and levels."""
        super().__post_init__()
        fields.integer(self, "levels", 2, MOST_LEVELS)


class SlantedProfile(_Depth, frozen=True, kw_only=True, tag="slanted"):
    """Ridges with two parallel walls that lean.

    Attributes:
        duty: Share of the period that the ridge takes, at every height.
        slant_deg: Angle of the walls from the normal; above 0 the top lies toward +x.
    """

    duty: float = 0.5
    slant_deg: float

    def __post_init__(self) -> None:
        """Check all fields."""
        super().__post_init__()
        between(self, "duty", 0.0, 1.0)
        between(self, "slant_deg", -STEEPEST_DEG, STEEPEST_DEG)


class PolygonProfile(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="polygon"
):
    """A ridge with any outline, overhangs included; it is repeated every period.

    Attributes:
        points: Corners in order, the last joined to the first: x in periods, z in micrometres, at
            least 0. Edges must not cross.
    """

    points: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        """Check the corners and that no edges cross."""
        for place, (_, z) in enumerate(rows(self, "points", ("x", "z_um"), MOST_POINTS)):
            if not 0.0 <= z <= DEEPEST_UM:
                rule = f"must be from 0 to {DEEPEST_UM:g} um"
                raise FieldError(f"points[{place}][1]", rule, z)
        if len(self.points) < len(("a", "b", "c")):
            raise FieldError("points", "must be at least 3 corners", len(self.points))
        outline = np.asarray(self.points, dtype=np.float64)
        if np.ptp(outline[:, 1]) == 0.0:
            raise FieldError("points", "must have a height above 0", self.points)
        try:
            check_simple(outline)
        except SpecError as error:
            rule = str(error).removeprefix("points: ").replace(", got", ";")
            raise FieldError("points", rule, self.points) from error


class SampledProfile(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sampled"
):
    """A relief by its heights at equal steps of the period, from x = 0, joined by straight lines.

    Attributes:
        heights_um: Heights, micrometres, at least 0; the last one is joined to the first.
    """

    heights_um: tuple[float, ...]

    def __post_init__(self) -> None:
        """Check the heights."""
        count = len(self.heights_um)
        if not 2 <= count <= MOST_POINTS:
            raise FieldError("heights_um", f"must have from 2 to {MOST_POINTS} items", count)
        fields.vector(self, "heights_um", count, at_most=DEEPEST_UM)
        for place, height in enumerate(self.heights_um):
            if height < 0.0:
                raise FieldError(f"heights_um[{place}]", "must be at least 0", height)
        if max(self.heights_um) == min(self.heights_um):
            raise FieldError("heights_um", "must not all be equal", self.heights_um)


class VolumeProfile(
    Struct,
    frozen=True,
    forbid_unknown_fields=True,
    kw_only=True,
    tag_field="shape",
    tag="volume",
):
    """A volume grating: the permittivity n^2 + 2 n dn cos(K.r) with n the index and dn its wave.

    The tangential part of K is that of the pattern, 2 pi over the period.

    Attributes:
        thickness_um: Thickness, micrometres.
        index: Mean index n.
        modulation: Amplitude dn of the index, above 0.
        slant_deg: Angle of the fringes from the normal; above 0 they lean toward +x with z. Or
        normal_period_um: 2 pi / K_z, of either sign; fringes along the surface have no tangential
            part at all. At most one of the two; without both the fringes are upright.
    """

    thickness_um: float
    index: OpticalIndex
    modulation: float
    slant_deg: float | None = None
    normal_period_um: float | None = None

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.number(self, "thickness_um", above=0.0, at_most=DEEPEST_UM)
        optical_index.check(self, "index")
        fields.number(self, "modulation", above=0.0, at_most=1.0)
        if self.slant_deg is not None:
            between(self, "slant_deg", -STEEPEST_DEG, STEEPEST_DEG)
        if self.normal_period_um is not None:
            if abs(fields.number(self, "normal_period_um")) < LEAST_PERIOD_UM:
                rule = f"must be at least {LEAST_PERIOD_UM:g} in size"
                raise FieldError("normal_period_um", rule, self.normal_period_um)
            if self.slant_deg is not None:
                rule = "must not stand beside slant_deg"
                raise FieldError("normal_period_um", rule, self.normal_period_um)


type ReliefProfile = (
    BinaryProfile
    | SawtoothProfile
    | SinusoidProfile
    | TriangleProfile
    | StaircaseProfile
    | SlantedProfile
    | PolygonProfile
    | SampledProfile
)
type ProfileSpec = ReliefProfile | LayersProfile | VolumeProfile

RELIEFS = (
    BinaryProfile,
    SawtoothProfile,
    SinusoidProfile,
    TriangleProfile,
    StaircaseProfile,
    SlantedProfile,
    PolygonProfile,
    SampledProfile,
)
PROFILES = (*RELIEFS, LayersProfile, VolumeProfile)


def between(owner: Struct, field: str, low: float, high: float) -> None:
    """Check a number strictly between two bounds.

    Args:
        owner: Struct that holds the field.
        field: Name of the field.
        low: Lower bound, not allowed itself.
        high: Upper bound, not allowed itself.

    Raises:
        FieldError: It is no such number.
    """
    value = fields.number(owner, field, above=low)
    if value >= high:
        raise FieldError(field, f"must be below {high:g}", value)
