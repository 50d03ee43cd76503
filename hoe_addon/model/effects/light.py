# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light that occurs in a document: emitters and the room, each with wavelengths of its own.

Luminance counts here, so wavelengths are drawn by power times V(lambda), at equal shares of it.
"""

from dataclasses import dataclass

import numpy as np

from ...core import colour
from ...core.arrays import FloatArray
from ...core.spectrum import Spectrum, illuminant
from ...core.units import m_to_nm
from ..device import DeviceSpec, LightGuideSpec
from ..device_parts import DisplaySpec
from ..scene_parts import DisplayElement, LampElement

ROOM = -1
"""Number of what is met where nothing else is."""

USED_PRIMARIES = {"reticle": (0,), "speed": (1,)}
"""Red, green or blue alone in a built-in picture; the others, and files, use all three."""

_PRIMARIES = (0, 1, 2)

ROOM_ALBEDO = 0.3
"""Luminance of what stands in a room over that of white; rooms have 0.2 to 0.5 in the mean."""

_NARROW_NM = 4.0
_FEW, _MANY = 4, 10
"""Wavelengths that stand for a line, and for a broad spectrum."""

_LEAST_SHARE = 1e-9


@dataclass(frozen=True, eq=False)
class Component:
    """One part of the light, with a spectrum of its own.

    Attributes:
        name: What it is, for a sentence.
        emitter: Name of the element that gives it; empty for the room.
        luminance: Of the emitter, or of white in the room, cd/m^2.
        area_mm2: Of the emitter.
        wavelengths_nm: Wavelengths of equal shares of its luminance, shape ``(n,)``.
        width_nm: Standard deviation of its wavelengths.
    """

    name: str
    emitter: str
    luminance: float
    area_mm2: float
    wavelengths_nm: FloatArray
    width_nm: float

    @property
    def mean_nm(self) -> float:
        """Mean of its wavelengths."""
        return float(np.mean(self.wavelengths_nm))


def components_of(spec: DeviceSpec) -> tuple[Component, ...]:
    """List all light of a document.

    Args:
        spec: The document.

    Returns:
        The room first, where it is not dark; then each primary that a display uses, and each lamp.
    """
    found: list[Component] = []
    if spec.room.kind != "none" and spec.room.luminance_cd_m2 > 0.0:
        found.append(_component("the room", "", spec.room.luminance_cd_m2, 0.0, illuminant("D65")))
    if isinstance(spec, LightGuideSpec):
        # The survey of its eyebox shows white, whatever the picture is.
        found += _display("display", spec.display, _PRIMARIES)
    else:
        for element in spec.elements:
            if isinstance(element, DisplayElement):
                used = USED_PRIMARIES.get(element.display.image, _PRIMARIES)
                found += _display(element.name, element.display, used)
            elif isinstance(element, LampElement):
                light, area = element.spectrum.spectrum(), float(np.prod(element.size_mm))
                found.append(
                    _component(element.name, element.name, element.luminance_cd_m2, area, light)
                )
    if spec.render.mode == "preview":
        at = np.array([spec.render.preview_wavelength_nm])
        found = [
            Component(each.name, each.emitter, each.luminance, each.area_mm2, at, 0.0)
            for each in found
        ]
    return tuple(each for each in found if each.luminance > 0.0)


def _display(name: str, display: DisplaySpec, used: tuple[int, ...]) -> list[Component]:
    shares = colour.white_balance(display.spectra(), display.white)
    words = ("red", "green", "blue")
    return [
        _component(
            f"{words[place]} of {name}",
            name,
            float(shares[place]) * display.luminance_cd_m2,
            float(np.prod(display.size_mm)),
            display.spectra()[place],
        )
        for place in used
        if shares[place] > _LEAST_SHARE
    ]


def _component(
    name: str, emitter: str, luminance: float, area: float, light: Spectrum
) -> Component:
    grid = np.unique(np.concatenate((np.linspace(380e-9, 780e-9, 401), light.wavelength)))
    grid = grid[(grid >= 380e-9) & (grid <= 780e-9)]
    density = np.maximum(light(grid) * colour.xyz_bar(grid)[:, 1], 0.0)
    steps = 0.5 * (density[1:] + density[:-1]) * np.diff(grid)
    whole = np.concatenate(([0.0], np.cumsum(steps)))
    if not whole[-1] > 0.0:
        return Component(name, emitter, 0.0, area, np.array([555.0]), 0.0)
    whole /= whole[-1]
    fine = m_to_nm(np.interp((np.arange(64) + 0.5) / 64.0, whole, grid))
    width = float(np.std(fine))
    count = _FEW if width < _NARROW_NM else _MANY
    middles = (np.arange(count) + 0.5) / count
    nodes = m_to_nm(np.interp(middles, whole, grid))
    if count == _FEW:
        # Few middles of equal shares are closer together than the line is wide.
        mean = float(np.mean(fine))
        nodes = mean + (nodes - mean) * (width / float(np.std(nodes)))
    return Component(name, emitter, luminance, area, nodes, width)


def equal_light() -> Component:
    """Daylight of one luminance from everywhere."""
    return _component("daylight", "", 1.0, 0.0, illuminant("D65"))
