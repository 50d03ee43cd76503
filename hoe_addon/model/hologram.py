# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document of one hologram: surface, media, recording, efficiency, orders."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from . import field_kinds, medium, pattern
from .characteristic import CharacteristicSpec
from .efficiency import EFFICIENCIES, EfficiencySpec, check_fits, settle_orders
from .field_error import FieldError
from .medium import MediumRef
from .pattern import PatternSpec, pattern_of
from .recording import RecordingSpec
from .surface import SURFACES, SurfaceSpec

type Orders = Annotated[tuple[int, ...], Meta(min_length=1)]
"""Diffraction orders to trace; may be left out where the efficiency model lists its own."""


class SideMedia(Struct, frozen=True, forbid_unknown_fields=True):
    """Media on the two sides of the surface.

    Attributes:
        back: Medium at z < 0.
        front: Medium at z > 0.
    """

    back: MediumRef = 1.0
    front: MediumRef = 1.0

    def __post_init__(self) -> None:
        """Check both media."""
        medium.check(self, "back")
        medium.check(self, "front")


class HologramSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One hologram optical element, in its own frame: z along the normal, lengths in mm.

    Attributes:
        schema: Version of the document's format.
        name: Name of the element.
        surface: Its shape.
        media: The media behind and before it.
        recording: The two waves that it was made with, or
        characteristic: the function V(x, y) that is recorded in it; exactly one of the two.
        efficiency: How much light each order gets.
        orders: Orders that are traced, each once; those of the table where it is left out.
    """

    schema: Literal[1] = 1
    name: str
    surface: SurfaceSpec
    media: SideMedia
    recording: RecordingSpec | None = None
    characteristic: CharacteristicSpec | None = None
    efficiency: EfficiencySpec
    orders: Orders = ()

    def __post_init__(self) -> None:
        """Check what the parts cannot check alone."""
        field_kinds.text(self, "name")
        field_kinds.instance(self, "surface", *SURFACES)
        field_kinds.instance(self, "media", SideMedia)
        field_kinds.instance(self, "efficiency", *EFFICIENCIES)
        pattern.check(self, self.surface)
        for side in ("back", "front"):
            try:
                medium.index_at(self.media, side, self.pattern.wavelength_nm)
            except FieldError as error:
                raise error.inside("media") from error
        settle_orders(self, self.efficiency)
        check_fits(self.efficiency, self.pattern, self.surface)

    @property
    def pattern(self) -> PatternSpec:
        """What is recorded in it."""
        return pattern_of(self)
