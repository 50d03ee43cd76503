# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which distributions of wavelengths a scene keeps ready for its renders."""

from collections.abc import Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..core.colour import white_balance
from ..core.fixed_lines import fixed_lines
from ..core.spectrum import Spectrum
from ..core.units import nm_to_m
from ..core.wavelength_sampling import WavelengthSampling, by_significance, uniform
from .device_parts import DisplaySpec, RenderSpec

UNIFORM_NM = (380.0, 780.0)
"""What is drawn from where all wavelengths are equally likely."""

_DAYLIGHT = 0.9
_EMITTERS = 0.1
"""Share of daylight where a pass serves ordinary light, or the emitters; never 1, never 0."""

_LINES_OF_DAYLIGHT = (450.0, 530.0, 610.0)
_NEAREST_NM = 5.0
"""Fixed lines that are nearer than that to another are one."""


def display_weights(display: DisplaySpec) -> tuple[float, float, float]:
    """How often the primaries of a display are drawn.

    An error of luminance asks for as often as they are bright, one of colour for equally often:
    the square root of the luminance lies between.

    Args:
        display: The display.

    Returns:
        Weights of red, green and blue; their sum is 1.
    """
    rooted = np.sqrt(white_balance(display.spectra(), display.white))
    red, green, blue = (rooted / rooted.sum()).tolist()
    return red, green, blue


def samplings(
    render: RenderSpec, spectra: Sequence[Spectrum], weights: Sequence[float]
) -> tuple[WavelengthSampling, ...]:
    """The distributions of a scene.

    Args:
        render: How wavelengths and orders are chosen.
        spectra: Spectra of all emitters.
        weights: How often each is drawn among them, for what is guided.

    Returns:
        The one for whole pictures first. Where order selection is guided, one for what ordinary
        light lights and one for what emitters do follow.
    """
    if render.wavelengths == "uniform":
        low, high = map(nm_to_m, UNIFORM_NM)
        return (uniform(low, high),)
    if render.wavelengths == "lines":
        return (fixed_lines(_lines(spectra)),)
    # What has no weight is in no picture.
    present = [float(weight > 0.0) for weight in weights]
    whole = by_significance(spectra, floor=render.spectrum_floor, weights=present or None)
    if render.order_selection == "significance" or not spectra:
        return (whole,)
    return (
        whole,
        by_significance(spectra, floor=_DAYLIGHT, weights=weights),
        by_significance(spectra, floor=_EMITTERS, weights=weights),
    )


def _lines(spectra: Sequence[Spectrum]) -> list[float]:
    """The middle of each emitter, those that are nearly equal once; else three of daylight."""
    middles = sorted(_middle(spectrum) for spectrum in spectra)
    apart = [
        line
        for place, line in enumerate(middles)
        if place == 0 or line - middles[place - 1] > nm_to_m(_NEAREST_NM)
    ]
    return apart if len(apart) > 1 else [nm_to_m(line) for line in _LINES_OF_DAYLIGHT]


def _middle(spectrum: Spectrum) -> float:
    """Mean wavelength of the visible power, in m."""
    grid: FloatArray = np.linspace(nm_to_m(380.0), nm_to_m(780.0), 4001)
    own = spectrum.wavelength
    grid = np.union1d(grid, own[(own > grid[0]) & (own < grid[-1])])
    power = spectrum(grid)
    return float(np.trapezoid(power * grid, grid) / np.trapezoid(power, grid))
