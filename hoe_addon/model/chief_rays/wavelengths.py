# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""In which wavelengths chief rays are shown."""

import numpy as np

from ...core.spectrum import Spectrum
from ...core.units import m_to_nm
from ..device import DeviceSpec, LightGuideSpec
from ..scene_parts import DisplayElement, ElementSpec, LampElement

_OF_WHITE_NM = (610.0, 550.0, 460.0)
"""For light that has no colour, and where nothing gives light."""

_BROAD_NM = 120.0
"""Light that is half as bright as at its peak over more than that is white."""

_APART_NM = 5.0
"""Nearer wavelengths are one."""

_MOST = 3


def chief_wavelengths_nm(spec: DeviceSpec) -> tuple[float, ...]:
    """Choose up to three wavelengths of the light in a document, the longest first.

    Args:
        spec: The document.

    Returns:
        Vacuum wavelengths in nm: peaks of the primaries and of coloured lamps, else red, green
        and blue.
    """
    if isinstance(spec, LightGuideSpec):
        return _apart([peak for light in spec.display.spectra() for peak in _peaks(light)])
    return _apart([peak for element in spec.elements for peak in _peaks_of(element)])


def _peaks_of(element: ElementSpec) -> tuple[float, ...]:
    if isinstance(element, DisplayElement):
        return tuple(peak for light in element.display.spectra() for peak in _peaks(light))
    if isinstance(element, LampElement):
        return _peaks(element.spectrum.spectrum())
    return ()


def _peaks(light: Spectrum) -> tuple[float, ...]:
    bright = light.wavelength[light.power >= 0.5 * float(np.max(light.power))]
    if m_to_nm(float(np.ptp(bright))) > _BROAD_NM:
        return _OF_WHITE_NM
    return (m_to_nm(float(light.wavelength[np.argmax(light.power)])),)


def _apart(peaks: list[float]) -> tuple[float, ...]:
    found: list[float] = []
    for peak in sorted(peaks or _OF_WHITE_NM, reverse=True):
        if not found or found[-1] - peak > _APART_NM:
            found.append(peak)
    chosen = np.unique(np.linspace(0, len(found) - 1, min(len(found), _MOST)).round())
    return tuple(found[int(place)] for place in chosen)
