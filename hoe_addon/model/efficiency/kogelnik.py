# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The volume hologram of a document, in coupled two-wave theory."""

from collections.abc import Iterable

from msgspec import Struct

from ...core.efficiency import EfficiencyModel
from ...core.efficiency.volume import Exposure, VolumeGrating
from ...core.orders import Branch
from ...core.units import MM, UM, nm_to_m
from .. import fields, medium
from ..field_error import FieldError
from ..medium import MediumRef, medium_from
from ..optical_system import SystemWaveSpec
from ..pattern import PatternSpec
from ..recording import RecordingSpec
from ..surface import SurfaceSpec
from . import lists, varying
from .common import CommonFields
from .varying import Varying

MOST_EXPOSURES = 7
"""Further ones; each has four ways out, of which Cycles takes 64 in all."""

_ORDERS = (-1, 0, 1)
_LARGEST_CHANGE = 0.5
_LARGEST_MODULATION = 1.0
_LEAST_PERIOD_UM = 0.01


class ExposureSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One more exposure to the same two waves at another wavelength.

    Attributes:
        wavelength_nm: Vacuum wavelength in nm.
        modulation: Amplitude of the index, a number or a formula of the place.
        absorption_modulation_per_mm: Amplitude of the absorption of the amplitude, 1/mm.
    """

    wavelength_nm: float
    modulation: Varying
    absorption_modulation_per_mm: float = 0.0

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.wavelength(self, "wavelength_nm")
        varying.check(self, "modulation", at_least=0.0, at_most=_LARGEST_MODULATION)
        fields.number(self, "absorption_modulation_per_mm", at_least=0.0)


class KogelnikSpec(CommonFields, frozen=True, kw_only=True, tag_field="model", tag="kogelnik"):
    """A volume hologram in an emulsion, in coupled two-wave theory (Kogelnik 1969).

    Attributes:
        thickness_um: Thickness of the emulsion when it was exposed, in um; a number or a formula.
        index: Medium of the emulsion when it was exposed.
        modulation: Amplitude of the index, n + modulation cos(K.r); a number or a formula.
        shrinkage: Share of the thickness that development takes away; below 0 it swells.
        index_shift: What development adds to the mean index.
        absorption_per_mm: Absorption of the amplitude (Kogelnik's alpha), 1/mm; the power falls
            by exp(-2 alpha) a mm.
        absorption_modulation_per_mm: Its amplitude, alpha + amplitude cos(K.r), in 1/mm.
        normal_period_um: Period of the fringes along the normal as recorded, in um; only beside a
            characteristic function. Its sign tells which way they slant; None for unslanted.
        exposures: Further exposures to the same two waves at other wavelengths.
    """

    thickness_um: Varying
    index: MediumRef
    modulation: Varying
    shrinkage: float = 0.0
    index_shift: float = 0.0
    absorption_per_mm: float = 0.0
    absorption_modulation_per_mm: float = 0.0
    normal_period_um: float | None = None
    exposures: tuple[ExposureSpec, ...] = ()

    def __post_init__(self) -> None:
        """Check what does not depend on the pattern."""
        varying.check(self, "thickness_um", above=0.0)
        medium.check(self, "index")
        varying.check(self, "modulation", at_least=0.0, at_most=_LARGEST_MODULATION)
        for field in ("shrinkage", "index_shift"):
            fields.number(self, field, at_least=-_LARGEST_CHANGE, at_most=_LARGEST_CHANGE)
        fields.number(self, "absorption_per_mm", at_least=0.0)
        fields.number(self, "absorption_modulation_per_mm", at_least=0.0)
        lists.structs(self, "exposures", ExposureSpec, 0, MOST_EXPOSURES)
        self._check_absorption()
        if self.normal_period_um is not None:
            period = fields.number(self, "normal_period_um")
            if abs(period) < _LEAST_PERIOD_UM:
                rule = f"must be at least {_LEAST_PERIOD_UM:g} in size"
                raise FieldError("normal_period_um", rule, period)
        self.check_common()

    def _check_absorption(self) -> None:
        """No place of the emulsion may amplify light."""
        total = self.absorption_modulation_per_mm
        total += sum(each.absorption_modulation_per_mm for each in self.exposures)
        if total > self.absorption_per_mm * (1.0 + fields.SHARE_SLACK):
            rule = f"must be at most absorption_per_mm, {self.absorption_per_mm:g}, in all"
            raise FieldError("absorption_modulation_per_mm", rule, total)

    def check_on(self, pattern: PatternSpec, surface: SurfaceSpec) -> None:
        """Check what depends on the pattern and the surface.

        Args:
            pattern: What is recorded in the element.
            surface: The element's surface.

        Raises:
            FieldError: The fields do not go with them.
        """
        if isinstance(pattern, RecordingSpec):
            self._check_recording(pattern)
        elif self.exposures:
            rule = "must be left out beside characteristic, which has no waves"
            raise FieldError("exposures", rule, len(self.exposures))
        index = medium.index_at(self, "index", pattern.wavelength_nm) + self.index_shift
        if index < 1.0:
            raise FieldError("index_shift", "must leave an index of at least 1", self.index_shift)
        varying.check_on(self.thickness_um, "thickness_um", surface, above=0.0)
        varying.check_on(self.modulation, "modulation", surface, at_least=0.0)
        for place, exposure in enumerate(self.exposures):
            path = f"exposures[{place}].modulation"
            varying.check_on(exposure.modulation, path, surface, at_least=0.0)
        # Nowhere may the index fall to that of the vacuum.
        strengths = [self.modulation, *(each.modulation for each in self.exposures)]
        if any(strengths):
            varying.check_sum(strengths, "modulation", surface, below=index - 1.0)

    def _check_recording(self, pattern: RecordingSpec) -> None:
        if self.normal_period_um is not None:
            rule = "must be left out beside recording, whose two waves give it"
            raise FieldError("normal_period_um", rule, self.normal_period_um)
        if isinstance(pattern.object, SystemWaveSpec) and isinstance(
            pattern.reference, SystemWaveSpec
        ):
            rule = "must not be kogelnik where both waves are of kind system: one map holds both"
            raise FieldError("model", rule, "kogelnik")
        seen = [pattern.wavelength_nm]
        for place, exposure in enumerate(self.exposures):
            if exposure.wavelength_nm in seen:
                rule = "must be another wavelength than those of the other exposures"
                raise FieldError(f"exposures[{place}].wavelength_nm", rule, exposure.wavelength_nm)
            seen.append(exposure.wavelength_nm)
            medium.index_at(self, "index", exposure.wavelength_nm)

    def listed_orders(self) -> tuple[int, ...]:
        """Give the orders of two-wave theory: -1, 0 and 1."""
        return _ORDERS

    def branches(self, orders: Iterable[int], recorded_nm: float) -> tuple[Branch, ...]:
        """List the ways out that can get light.

        Args:
            orders: The orders to trace.
            recorded_nm: Wavelength that the pattern is stated for, nm.

        Returns:
            The transmitted order 0, and the orders +1 and -1 of each exposure on both sides.
        """
        frequencies = [1.0, *(recorded_nm / each.wavelength_nm for each in self.exposures)]
        found: list[Branch] = []
        for order in orders:
            if order == 0:
                found.append(Branch(0))
            elif order in _ORDERS:
                found += [
                    Branch(order, reflected=side, frequency=frequency)
                    for frequency in frequencies
                    for side in (False, True)
                ]
        return tuple(found)

    def model(self) -> EfficiencyModel:
        """Make the model of the core."""
        main = Exposure(
            varying.quantity(self.modulation, 1.0), self.absorption_modulation_per_mm / MM
        )
        further = (
            Exposure(
                varying.quantity(each.modulation, 1.0),
                each.absorption_modulation_per_mm / MM,
                nm_to_m(each.wavelength_nm),
            )
            for each in self.exposures
        )
        period = self.normal_period_um
        return VolumeGrating(
            thickness=varying.quantity(self.thickness_um, UM),
            index=medium_from(self.index),
            exposures=(main, *further),
            shrinkage=self.shrinkage,
            index_shift=self.index_shift,
            absorption=self.absorption_per_mm / MM,
            normal_frequency=0.0 if period is None else 1.0 / (period * UM),
            total_internal_reflection=self.total_internal_reflection,
        )
