# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a hologram was recorded: two waves and a wavelength."""

from msgspec import Struct

from . import field_kinds, fields
from .clearance import is_behind, touched_mm
from .field_error import FieldError
from .optical_system import SystemWaveSpec
from .surface import SurfaceSpec
from .waves import WAVES, ExtendedSourceSpec, WaveSpec, WindowSourceSpec


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
        for name, wave in self._behind_optics():
            try:
                wave.core_system(self.wavelength_nm)
            except FieldError as error:
                raise error.inside(name) from error

    def check_clear_of(self, surface: SurfaceSpec) -> None:
        """Check that no source touches the element, where a wave has no direction.

        Of an extended source its edges are looked at. A source behind optics or a window
        has to throw light on the element.

        Args:
            surface: The element's surface.

        Raises:
            FieldError: If a source lies on it, edges included, or passes through it, or no light
                of one behind optics or a window reaches it.
        """
        for name, wave in (("object", self.object), ("reference", self.reference)):
            for field, position_mm in wave.source_points():
                if surface.holds(position_mm):
                    rule = "must not lie on the surface"
                    raise FieldError(f"{name}.{field}", rule, position_mm)
            if isinstance(wave, ExtendedSourceSpec):
                place_mm = touched_mm(surface, wave.edges_mm())
                if place_mm is not None:
                    rule = "must not touch the surface with its source"
                    raise FieldError(f"{name}.shape", rule, place_mm)
            if isinstance(wave, WindowSourceSpec) and not is_behind(surface, wave.window):
                rule = "must lie before the surface, but no part of the surface is behind it"
                raise FieldError(f"{name}.window", rule, wave.window.position_mm)
        for name, wave in self._behind_optics():
            try:
                wave.check_reaches(surface, self.wavelength_nm)
            except FieldError as error:
                raise error.inside(name) from error

    def _behind_optics(self) -> list[tuple[str, SystemWaveSpec]]:
        both = (("object", self.object), ("reference", self.reference))
        return [(name, wave) for name, wave in both if isinstance(wave, SystemWaveSpec)]
