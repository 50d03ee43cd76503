# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a hologram was recorded: two waves and a wavelength."""

from msgspec import Struct

from . import field_kinds, fields
from .field_error import FieldError
from .surface import SurfaceSpec
from .waves import WAVES, PointSourceSpec, WaveSpec


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
        field_kinds.instance(self, "object", *WAVES)
        field_kinds.instance(self, "reference", *WAVES)

    def check_clear_of(self, surface: SurfaceSpec) -> None:
        """Check that no source point lies on the element, where a wave has no direction.

        Args:
            surface: The element's surface.

        Raises:
            FieldError: If a source point lies on it, edges included.
        """
        for name, wave in (("object", self.object), ("reference", self.reference)):
            if isinstance(wave, PointSourceSpec) and surface.holds(wave.position_mm):
                field = f"{name}.position_mm"
                raise FieldError(field, "must not lie on the surface", wave.position_mm)
