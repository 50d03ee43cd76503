# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scattering haze: a share of each order is spread around its direction."""

from msgspec import Struct

from .. import fields
from ..field_error import FieldError

WIDEST_DEG = 30.0
ROUGHEST_NM = 10_000.0


class HazeSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A lobe around each order that takes a share of its light.

    Attributes:
        width_deg: Standard deviation of the lobe along each of two axes, degrees, in the medium
            that the light leaves into, for light along the normal; elsewhere the lobe is the same
            in direction cosines.
        share: Share of each order that is scattered, 0 to 1, or
        roughness_nm: root mean square of the roughness that scatters it, nm; exactly one of both.
    """

    width_deg: float
    share: float | None = None
    roughness_nm: float | None = None

    def __post_init__(self) -> None:
        """Check the width, and that either the share or the roughness is given."""
        fields.number(self, "width_deg", above=0.0, at_most=WIDEST_DEG)
        if self.share is not None and self.roughness_nm is not None:
            rule = "must be left out where share is given"
            raise FieldError("roughness_nm", rule, self.roughness_nm)
        if self.roughness_nm is not None:
            fields.number(self, "roughness_nm", at_least=0.0, at_most=ROUGHEST_NM)
        elif self.share is not None:
            fields.number(self, "share", at_least=0.0, at_most=1.0)
        else:
            raise FieldError("share", "must be given, or roughness_nm instead", None)
