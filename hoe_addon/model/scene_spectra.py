# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of lamps as documents write them, told apart by ``kind``."""

from typing import Annotated, Literal

import numpy as np
from msgspec import Meta, Struct

from ..core import spectrum
from ..core.spectrum import Spectrum
from ..core.units import nm_to_m
from . import field_kinds, fields
from .device_parts import WHITES
from .field_error import FieldError

_LEAST_CENTRE_WIDTHS = 3.0
"""Nearer to wavelength 0 than this many widths, a band of the core would reach it."""

_VISIBLE_NM = (380.0, 780.0)
"""A lamp's luminance needs light that is seen."""

_MAX_LINES = 32


class _Band(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind"):
    """A band of light.

    Attributes:
        centre_nm: Vacuum wavelength of its peak.
        fwhm_nm: Full width at half maximum.
    """

    centre_nm: float
    fwhm_nm: float

    def __post_init__(self) -> None:
        """Check wavelength and width."""
        low, high = _VISIBLE_NM
        if not low <= fields.wavelength(self, "centre_nm") <= high:
            raise FieldError(
                "centre_nm", f"must be visible, from {low:g} to {high:g}", self.centre_nm
            )
        widest = self.centre_nm / _LEAST_CENTRE_WIDTHS
        if fields.number(self, "fwhm_nm", above=0.0) >= widest:
            raise FieldError(
                "fwhm_nm", f"must be below {widest:g}, a third of the centre", self.fwhm_nm
            )


class LineSpec(_Band, frozen=True, kw_only=True, tag="line"):
    """A laser line, Gaussian."""

    def spectrum(self) -> Spectrum:
        """Make the spectrum, 1 at its peak."""
        return spectrum.line(nm_to_m(self.centre_nm), nm_to_m(self.fwhm_nm))


class LedSpec(_Band, frozen=True, kw_only=True, tag="led"):
    """A single-colour LED."""

    def spectrum(self) -> Spectrum:
        """Make the spectrum, 1 at its peak."""
        return spectrum.led(nm_to_m(self.centre_nm), nm_to_m(self.fwhm_nm))


class IlluminantSpec(
    Struct,
    frozen=True,
    forbid_unknown_fields=True,
    kw_only=True,
    tag_field="kind",
    tag="illuminant",
):
    """A standard illuminant.

    Attributes:
        illuminant: Its name.
    """

    illuminant: Literal["D65", "E", "A"] = "D65"

    def __post_init__(self) -> None:
        """Check the name."""
        field_kinds.choice(self, "illuminant", WHITES)

    def spectrum(self) -> Spectrum:
        """Make the spectrum."""
        return spectrum.illuminant(self.illuminant)


class LampLine(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One line of a discharge lamp.

    Attributes:
        centre_nm: Vacuum wavelength of its peak.
        power: Power in the line, in any unit.
    """

    centre_nm: float
    power: float

    def __post_init__(self) -> None:
        """Check wavelength and power."""
        fields.wavelength(self, "centre_nm")
        fields.number(self, "power", above=0.0)


class LinesSpec(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="lines"
):
    """Lines of a discharge lamp.

    Attributes:
        lines: The lines.
        fwhm_nm: Full width at half maximum of each.
    """

    lines: Annotated[tuple[LampLine, ...], Meta(min_length=1)]
    fwhm_nm: float = 1.0

    def __post_init__(self) -> None:
        """Check the width, and that something can be seen."""
        if not 1 <= len(self.lines) <= _MAX_LINES:
            raise FieldError("lines", f"must be 1 to {_MAX_LINES} lines", len(self.lines))
        fields.number(self, "fwhm_nm", above=0.0, at_most=min(n.centre_nm for n in self.lines) / 4)
        low, high = _VISIBLE_NM
        if not any(low <= line.centre_nm <= high for line in self.lines):
            raise FieldError("lines", f"must have one from {low:g} to {high:g} nm", len(self.lines))

    def spectrum(self) -> Spectrum:
        """Make the spectrum, lines of one width."""
        parts = [spectrum.line(nm_to_m(n.centre_nm), nm_to_m(self.fwhm_nm)) for n in self.lines]
        nodes = np.unique(np.concatenate([part.wavelength for part in parts]))
        power = sum(n.power * part(nodes) for n, part in zip(self.lines, parts, strict=True))
        return spectrum.tabulated(nodes, power, "lines")


type SpectrumSpec = LineSpec | LedSpec | IlluminantSpec | LinesSpec

SPECTRA = (LineSpec, LedSpec, IlluminantSpec, LinesSpec)
"""Every kind of spectrum."""
