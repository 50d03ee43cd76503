# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a hologram was recorded: two waves and a wavelength."""

import math
from typing import Literal

from msgspec import Struct

from . import field_kinds, fields
from .field_error import FieldError

ON_SURFACE_MM = 1e-9
"""A source point nearer to the plane than this counts as on it; far below any real position."""


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
        beam: Whether the wave runs away from its point or toward it.
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


class RecordingSpec(Struct, frozen=True, forbid_unknown_fields=True):
    """The two waves whose interference is recorded.

    Attributes:
        wavelength_nm: Vacuum wavelength of the recording in nm.
        object: The wave that order +1 gives back.
        reference: The wave that reads the hologram out.
    """

    wavelength_nm: float
    object: WaveSpec
    reference: WaveSpec

    def __post_init__(self) -> None:
        """Check the wavelength and the kinds of wave."""
        fields.wavelength(self, "wavelength_nm")
        field_kinds.instance(self, "object", PlaneWaveSpec, PointSourceSpec)
        field_kinds.instance(self, "reference", PlaneWaveSpec, PointSourceSpec)

    def check_clear_of(self, size_mm: tuple[float, float]) -> None:
        """Check that no source point lies on the element, where a wave has no direction.

        Args:
            size_mm: Width and height of the plane element around the origin, in mm.

        Raises:
            FieldError: If a source point lies on the rectangle, edges included.
        """
        for name, wave in (("object", self.object), ("reference", self.reference)):
            if isinstance(wave, PlaneWaveSpec):
                continue
            x, y, z = wave.position_mm
            inside = abs(x) <= size_mm[0] / 2 and abs(y) <= size_mm[1] / 2
            if inside and abs(z) <= ON_SURFACE_MM:
                field = f"recording.{name}.position_mm"
                raise FieldError(field, "must not lie on the surface", wave.position_mm)
