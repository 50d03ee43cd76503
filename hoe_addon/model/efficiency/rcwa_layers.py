# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A grating given as layers of upright walls; x in periods along Q, from the back to the front."""

import math

from msgspec import Struct

from .. import fields
from ..field_error import FieldError
from . import optical_index
from .lists import structs
from .optical_index import OpticalIndex

DEEPEST_UM = 10_000.0
_MOST_SEGMENTS = 1000
_MOST_LAYERS = 1000
_WIDTH_SLACK = 1e-9
"""Widths of segments that add up to 1 within this are taken for a whole period."""


class Segment(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A stretch of a layer.

    Attributes:
        width: Share of the period.
        index: Its material.
    """

    width: float
    index: OpticalIndex

    def __post_init__(self) -> None:
        """Check width and material."""
        fields.number(self, "width", above=0.0, at_most=1.0)
        optical_index.check(self, "index")


class SegmentLayer(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A layer of upright walls.

    Attributes:
        thickness_um: Thickness, micrometres.
        segments: Stretches from x = 0; their widths add up to 1.
    """

    thickness_um: float
    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        """Check the thickness and that the widths fill a period."""
        fields.number(self, "thickness_um", above=0.0, at_most=DEEPEST_UM)
        structs(self, "segments", Segment, 1, _MOST_SEGMENTS)
        total = math.fsum(segment.width for segment in self.segments)
        if abs(total - 1.0) > _WIDTH_SLACK:
            raise FieldError("segments", "widths must sum to 1", total)


class LayersProfile(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="layers"
):
    """Layers of upright walls, each with materials of its own.

    Attributes:
        layers: From the back to the front.
    """

    layers: tuple[SegmentLayer, ...]

    def __post_init__(self) -> None:
        """Check the layers."""
        structs(self, "layers", SegmentLayer, 1, _MOST_LAYERS)
