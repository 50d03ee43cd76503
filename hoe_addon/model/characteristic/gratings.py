# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gratings with evenly spaced lines."""

from msgspec import Struct

from .. import fields

_FINEST_LINES_PER_MM = 1e6


class LinearSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="linear"):
    """A uniform grating.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm; order m of any wavelength
            goes where it goes whatever is written here.
        lines_per_mm: Lines per mm.
        azimuth_deg: Direction of the grating vector, from x toward y, in degrees.
    """

    wavelength_nm: float
    lines_per_mm: float
    azimuth_deg: float = 0.0

    def __post_init__(self) -> None:
        """Check wavelength, lines and azimuth."""
        fields.wavelength(self, "wavelength_nm")
        fields.number(self, "lines_per_mm", at_least=0.0, at_most=_FINEST_LINES_PER_MM)
        fields.number(self, "azimuth_deg")


class RadialSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="radial"):
    """Evenly spaced circles around the origin: the track of a compact disc, or an axicon.

    At the origin itself nothing is recorded.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm; order m of any wavelength
            goes where it goes whatever is written here.
        lines_per_mm: Circles per mm of radius; order +1 is turned outward.
    """

    wavelength_nm: float
    lines_per_mm: float

    def __post_init__(self) -> None:
        """Check wavelength and lines."""
        fields.wavelength(self, "wavelength_nm")
        fields.number(self, "lines_per_mm", at_least=0.0, at_most=_FINEST_LINES_PER_MM)
