# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of light sources: lasers, LEDs, display primaries, standard illuminants, tables."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from . import data
from .arrays import FloatArray, as_float
from .errors import SpecError
from .units import nm_to_m

# Nodes per full width at half maximum: the straight lines between them miss at most
# ln(2) / NODES_PER_WIDTH^2 = 3e-4 of the peak.
_NODES_PER_WIDTH = 48
# The Gaussian is cut at this many full widths from its centre, where it is 1.5e-11 of its peak.
_HALF_SPAN_WIDTHS = 3
# Root of (g + 2 g^5) / 3 = 1/2, the Gaussian's height where Ohno's LED is at half its peak.
_OHNO_HALF_HEIGHT = 0.8086092632090855
_ILLUMINANT_SPAN_NM = (300, 830)
# The nodes of a narrower line would fall on one another in double precision.
_NARROWEST = 1e-12
# Integrals and their squares stay within double precision.
_LEAST_PEAK, _MOST_PEAK = 1e-100, 1e100


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Relative spectral power: straight lines between nodes, zero outside them.

    Attributes:
        wavelength: Nodes in m, above 0 and increasing, shape ``(n,)`` with n at least 2.
        power: Power per wavelength at the nodes, at least 0, any unit, shape ``(n,)``; all 0, or
            from 1e-100 to 1e100 where it is most.
        name: Name for messages.

    Raises:
        SpecError: A rule above is broken.
    """

    wavelength: FloatArray
    power: FloatArray
    name: str = "spectrum"

    def __post_init__(self) -> None:
        """Check the nodes and keep read-only copies of them."""
        nodes = np.array(self.wavelength, dtype=np.float64)
        power = np.array(self.power, dtype=np.float64)
        if nodes.ndim != 1 or nodes.size < 2 or nodes.shape != power.shape:
            raise SpecError(
                f"{self.name}: needs as many powers as wavelengths, and 2 or more of each, "
                f"got shapes {power.shape} and {nodes.shape}"
            )
        if not (np.all(np.isfinite(nodes)) and nodes[0] > 0.0 and np.all(np.diff(nodes) > 0.0)):
            raise SpecError(f"{self.name}.wavelength: must be above 0, finite and increasing")
        if not (np.all(np.isfinite(power)) and np.all(power >= 0.0)):
            raise SpecError(f"{self.name}.power: must be finite and at least 0")
        peak = float(np.max(power))
        if peak != 0.0 and not _LEAST_PEAK <= peak <= _MOST_PEAK:
            span = f"{_LEAST_PEAK:g} to {_MOST_PEAK:g}"
            raise SpecError(f"{self.name}.power: the largest must be 0 or {span}, got {peak:g}")
        for field, value in (("wavelength", nodes), ("power", power)):
            value.flags.writeable = False
            object.__setattr__(self, field, value)

    def __call__(self, wavelength: ArrayLike) -> FloatArray:
        """Power per wavelength.

        Args:
            wavelength: Wavelength in m, shape ``(...)``.

        Returns:
            Power in the unit of ``power``, shape ``(...)``; zero outside the nodes.
        """
        at = as_float(wavelength)
        return np.asarray(np.interp(at, self.wavelength, self.power, left=0.0, right=0.0))


def _bell(
    centre: float, fwhm: float, name: str, shape: Callable[[FloatArray], FloatArray]
) -> Spectrum:
    """Sample a symmetric line shape, given as a function of (wavelength - centre) / fwhm."""
    if not (np.isfinite(fwhm) and fwhm > 0.0):
        raise SpecError(f"{name}.fwhm: must be above 0, got {fwhm!r} m")
    if not (np.isfinite(centre) and centre > _HALF_SPAN_WIDTHS * fwhm):
        raise SpecError(
            f"{name}.centre: must be more than {_HALF_SPAN_WIDTHS} widths above 0, got {centre!r} m"
        )
    if fwhm < _NARROWEST * centre:
        raise SpecError(
            f"{name}.fwhm: must be at least {_NARROWEST:g} of the centre, got {fwhm!r} m"
        )
    half_count = _HALF_SPAN_WIDTHS * _NODES_PER_WIDTH
    offset = np.arange(-half_count, half_count + 1) / _NODES_PER_WIDTH
    return Spectrum(centre + fwhm * offset, shape(offset), name)


def line(centre: float, fwhm: float, name: str = "line") -> Spectrum:
    """A laser line, or any other Gaussian band.

    Args:
        centre: Wavelength of the peak in m.
        fwhm: Full width at half maximum in m, above 0.
        name: Name for messages.

    Returns:
        The spectrum, 1 at its peak.

    Raises:
        SpecError: The width is not above 0 or below 1e-12 of the centre, or the line would reach
            wavelength 0.
    """

    def gaussian(offset: FloatArray) -> FloatArray:
        return np.exp(-4.0 * np.log(2.0) * offset**2)

    return _bell(centre, fwhm, name, gaussian)


def led(centre: float, fwhm: float, name: str = "led") -> Spectrum:
    """A single-colour LED: sharper than a Gaussian at the peak, wider in the wings.

    Args:
        centre: Wavelength of the peak in m.
        fwhm: Full width at half maximum in m, above 0.
        name: Name for messages.

    Returns:
        The spectrum, 1 at its peak.

    Raises:
        SpecError: The width is not above 0 or below 1e-12 of the centre, or the band would reach
            wavelength 0.

    References:
        Y. Ohno, Opt. Eng. 44, 111302 (2005), doi:10.1117/1.2130694: S = (g + 2 g^5) / 3 with
        g = exp(-((wavelength - centre) / w)^2). His w is 1.08 of the full width at half maximum.
    """

    def ohno(offset: FloatArray) -> FloatArray:
        gaussian = np.exp(4.0 * np.log(_OHNO_HALF_HEIGHT) * offset**2)
        return (gaussian + 2.0 * gaussian**5) / 3.0

    return _bell(centre, fwhm, name, ohno)


def tabulated(wavelength: ArrayLike, power: ArrayLike, name: str = "table") -> Spectrum:
    """A measured spectrum.

    Args:
        wavelength: Nodes in m, increasing, shape ``(n,)``.
        power: Power per wavelength at the nodes, at least 0, any unit, shape ``(n,)``; all 0, or
            from 1e-100 to 1e100 where it is most.
        name: Name for messages.

    Returns:
        The spectrum; zero outside the table.

    Raises:
        SpecError: The table breaks a rule of ``Spectrum``.
    """
    return Spectrum(as_float(wavelength), as_float(power), name)


def _illuminant_a(wavelength_nm: FloatArray) -> FloatArray:
    """CIE standard illuminant A, by its defining formula (ISO/CIE 11664-2:2022)."""
    second_radiation_constant_nm = 1.435e7
    temperature = 2848.0

    def planck(nm: FloatArray) -> FloatArray:
        return nm**-5 / np.expm1(second_radiation_constant_nm / (temperature * nm))

    return 100.0 * planck(wavelength_nm) / planck(np.array(560.0))


@cache
def illuminant(name: str) -> Spectrum:
    """A CIE standard illuminant.

    Args:
        name: "D65" (daylight), "E" (equal power) or "A" (incandescent lamp).

    Returns:
        The spectrum at 1 nm steps from 300 to 830 nm, 100 at 560 nm.

    Raises:
        SpecError: The name is another.

    References:
        ISO/CIE 11664-2:2022; D65 is interpolated linearly from the 5 nm table.
    """
    low, high = _ILLUMINANT_SPAN_NM
    nodes_nm = np.arange(low, high + 1.0)
    if name == "D65":
        table = data.load("cie_d65_1nm")
        return Spectrum(nm_to_m(table[:, 0]), table[:, 1], name)
    if name == "A":
        return Spectrum(nm_to_m(nodes_nm), _illuminant_a(nodes_nm), name)
    if name == "E":
        return Spectrum(nm_to_m(nodes_nm), np.full(nodes_nm.shape, 100.0), name)
    raise SpecError(f"illuminant: must be one of D65, E, A; got {name!r}")


@dataclass(frozen=True)
class PrimarySet:
    """The red, green and blue light of a kind of display.

    Attributes:
        shape: Line shape of one primary, from centre and full width at half maximum in m.
        bands_nm: Centre and full width at half maximum of red, green and blue, in nm.
        source: Why these numbers.
    """

    shape: Callable[[float, float, str], Spectrum]
    bands_nm: tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
    source: str


DISPLAY_PRIMARIES = MappingProxyType(
    {
        "led_rgb": PrimarySet(
            led,
            ((625.0, 18.0), (532.0, 30.0), (465.0, 20.0)),
            "micro-LED panel, or liquid-crystal panel lit by red, green and blue LEDs in turn; "
            "widths typical of AlGaInP red and InGaN green and blue chips",
        ),
        "laser_rgb": PrimarySet(
            line,
            ((625.0, 1.0), (532.0, 1.0), (465.0, 1.0)),
            "laser scanner; widths typical of multimode laser diodes under fast modulation",
        ),
        "oled_rgb": PrimarySet(
            line,
            ((620.0, 40.0), (528.0, 32.0), (460.0, 22.0)),
            "top-emitting OLED panel; widths typical of emitters in a microcavity",
        ),
    }
)
"""Kinds of display by name. The numbers stand for a kind, not for a product."""


@cache
def display_primaries(name: str) -> tuple[Spectrum, Spectrum, Spectrum]:
    """Spectra of a display's red, green and blue.

    Args:
        name: Kind of display, as in ``DISPLAY_PRIMARIES``.

    Returns:
        Red, green and blue, each 1 at its peak.

    Raises:
        SpecError: No set has this name; the message lists those that there are.
    """
    if name not in DISPLAY_PRIMARIES:
        known = ", ".join(DISPLAY_PRIMARIES)
        raise SpecError(f"primaries: must be one of {known}; got {name!r}")
    kind = DISPLAY_PRIMARIES[name]

    def primary(index: int, colour: str) -> Spectrum:
        centre_nm, fwhm_nm = kind.bands_nm[index]
        return kind.shape(nm_to_m(centre_nm), nm_to_m(fwhm_nm), f"{name} {colour}")

    return primary(0, "red"), primary(1, "green"), primary(2, "blue")
