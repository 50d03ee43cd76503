# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra: line shapes, illuminants, display primaries, bad input."""

import colour
import numpy as np
import pytest

from hoe_addon.core import spectrum
from hoe_addon.core.errors import SpecError
from hoe_addon.core.spectrum import Spectrum

# Straight lines between 48 nodes per width, see spectrum.py.
CHORD = 4e-4
# colour-science has A to six digits and D65 to four decimals.
TABLE_DIGITS = 1e-5


def sampled(reference: colour.SpectralDistribution, low: int, high: int) -> np.ndarray:
    """Values of a colour-science distribution at 1 nm, by straight lines."""
    return np.interp(np.arange(low, high + 1), reference.wavelengths, reference.values)


@pytest.mark.parametrize("shape", [spectrum.line, spectrum.led])
@pytest.mark.parametrize("fwhm", [1e-12, 1e-9, 30e-9])
def test_peak_and_width(shape, fwhm: float) -> None:
    made = shape(532e-9, fwhm)
    assert made(532e-9) == 1.0
    # 532 nm + 0.5 pm has four digits less than the width, hence the looser tolerance there.
    tolerance = CHORD + 1e-16 * 532e-9 / fwhm * 1e3
    assert made(532e-9 + np.array([-0.5, 0.5]) * fwhm) == pytest.approx(0.5, abs=tolerance)
    assert made(np.array([400e-9, 700e-9])) == pytest.approx(0.0, abs=1e-12)


def test_line_is_gaussian(rng: np.random.Generator) -> None:
    at = rng.uniform(530e-9, 534e-9, 500)
    expected = np.exp(-4.0 * np.log(2.0) * ((at - 532e-9) / 1e-9) ** 2)
    assert spectrum.line(532e-9, 1e-9)(at) == pytest.approx(expected, abs=CHORD)


def test_led_is_ohno_2005() -> None:
    # Ohno's width for a full width of 30 nm: solve (g + 2 g^5) / 3 = 1/2 at 15 nm.
    roots = np.roots([2.0, 0.0, 0.0, 0.0, 1.0, -1.5])
    half_height = float(roots[np.isreal(roots)].real[0])
    width = 15.0 / np.sqrt(-np.log(half_height))
    shape = colour.SpectralShape(442, 622, 1)
    expected = colour.colorimetry.sd_single_led_Ohno2005(532, width, shape).values
    made = spectrum.led(532e-9, 30e-9)(np.arange(442.0, 623.0) / 1e9)
    # The last node, at three widths, is rounded to one side or the other.
    assert made[1:-1] == pytest.approx(expected[1:-1], abs=CHORD)


@pytest.mark.parametrize("name", ["D65", "A", "E"])
def test_illuminants_match_colour_science(name: str) -> None:
    expected = sampled(colour.SDS_ILLUMINANTS[name], 360, 780)[::5]
    made = spectrum.illuminant(name)(np.arange(360.0, 781.0, 5.0) / 1e9)
    scale = 100.0 / np.interp(560.0, np.arange(360.0, 781.0, 5.0), expected)
    assert made == pytest.approx(expected * scale, rel=TABLE_DIGITS)


def test_illuminant_is_read_once() -> None:
    assert spectrum.illuminant("D65") is spectrum.illuminant("D65")


def test_zero_outside() -> None:
    table = spectrum.tabulated([500e-9, 600e-9], [1.0, 3.0])
    inside_and_out = table([499e-9, 500e-9, 550e-9, 600e-9, 601e-9])
    assert inside_and_out == pytest.approx([0.0, 1.0, 2.0, 3.0, 0.0], abs=1e-12)


def test_nodes_are_copied_and_read_only() -> None:
    power = np.array([1.0, 2.0])
    made = Spectrum(np.array([5e-7, 6e-7]), power)
    power[0] = 7.0
    assert made.power[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        made.power[0] = 7.0


@pytest.mark.parametrize("name", spectrum.DISPLAY_PRIMARIES)
def test_display_primaries(name: str) -> None:
    red, green, blue = spectrum.display_primaries(name)
    peaks = [float(s.wavelength[np.argmax(s.power)]) for s in (red, green, blue)]
    assert 610e-9 < peaks[0] < 640e-9
    assert 515e-9 < peaks[1] < 540e-9
    assert 445e-9 < peaks[2] < 470e-9


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: spectrum.line(532e-9, 0.0), "line.fwhm: must be above 0"),
        (lambda: spectrum.line(532e-9, float("nan")), "line.fwhm"),
        (lambda: spectrum.led(float("inf"), 1e-9), "led.centre"),
        (lambda: spectrum.led(50e-9, 30e-9), "led.centre: must be more than 3 widths above 0"),
        (lambda: spectrum.tabulated([5e-7], [1.0]), "table: needs"),
        (lambda: spectrum.tabulated([5e-7, 6e-7], [1.0]), "table: needs"),
        (lambda: spectrum.tabulated([6e-7, 5e-7], [1.0, 1.0]), "table.wavelength"),
        (lambda: spectrum.tabulated([5e-7, float("nan")], [1.0, 1.0]), "table.wavelength"),
        (lambda: spectrum.tabulated([5e-7, 6e-7], [1.0, -1.0]), "table.power"),
        (lambda: spectrum.tabulated([5e-7, 6e-7], [1.0, float("inf")]), "table.power"),
        (lambda: spectrum.illuminant("F11"), "illuminant: must be one of D65, E, A; got 'F11'"),
        (lambda: spectrum.display_primaries("crt"), "primaries: must be one of led_rgb.*'crt'"),
    ],
)
def test_bad_input(make, message: str) -> None:
    with pytest.raises(SpecError, match=message):
        make()
