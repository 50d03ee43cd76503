# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves as documents write them, told apart by ``kind``; lengths in mm."""

import math
from typing import Literal

from msgspec import Struct

from . import field_kinds, fields
from .field_error import FieldError


class PlaneWaveSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="plane"):
    """A plane wave.

    Attributes:
        direction: Direction of propagation, of any length but zero; kept as written.
        index: Refractive index of the medium that the wave arrives in.
    """

    direction: tuple[float, float, float]
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check direction and index."""
        direction = fields.vector(self, "direction", 3)
        if math.hypot(*direction) == 0.0:
            raise FieldError("direction", "must not have zero length", direction)
        fields.number(self, "index", at_least=1.0)


class PointSourceSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="point"
):
    """A spherical wave.

    Attributes:
        position_mm: Its point, in the frame of the surface, in mm.
        beam: Whether the wave runs away from its point (a real source) or toward it (virtual).
        index: Refractive index of the medium that the wave arrives in.
    """

    position_mm: tuple[float, float, float]
    beam: Literal["diverging", "converging"] = "diverging"
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check position, beam and index."""
        fields.vector(self, "position_mm", 3)
        field_kinds.choice(self, "beam", ("diverging", "converging"))
        fields.number(self, "index", at_least=1.0)


type WaveSpec = PlaneWaveSpec | PointSourceSpec

WAVES = (PlaneWaveSpec, PointSourceSpec)
"""Every kind of wave."""
