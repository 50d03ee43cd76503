# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light of a device's white display, as rays that leave its lens."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..core import colour, tracer
from ..core.arrays import FloatArray, IntArray, as_float
from ..core.spectrum import Spectrum, tabulated
from ..core.units import m_to_nm, mm_to_m
from ..core.wavelength_sampling import WavelengthSampling, by_significance
from .device import LightGuideSpec
from .device_parts import DisplaySpec
from .device_surfaces import DeviceSurfaces

_STRAY_SHARE = 0.1
"""Share of the rays that start anywhere on the lens; the others head for the source's hologram."""

_DAYLIGHT_SHARE = 0.05
"""Share of the wavelengths drawn by daylight: the display's own light is all that counts here."""

_DIMENSIONS = 6


@dataclass(frozen=True, eq=False)
class Beam:
    """Rays that leave the lens.

    Attributes:
        rays: R rays, weighted by their flux in lm.
        xyz_per_lm: Tristimulus values for Y = 1, shape ``(R, 3)``.
        part: Which part each belongs to, shape ``(R,)``.
    """

    rays: tracer.Rays
    xyz_per_lm: FloatArray
    part: IntArray


@dataclass(frozen=True, eq=False)
class DeviceLight:
    """The light of a white display on its way through the lens.

    Attributes:
        spec: The device.
        device: Its surfaces.
        light: Spectrum with a luminous integral of 1.
        sampling: The distribution of wavelengths.
        half_field: Tangents of the field's half angles, along x and y.
    """

    spec: LightGuideSpec
    device: DeviceSurfaces
    light: Spectrum
    sampling: WavelengthSampling
    half_field: FloatArray

    @classmethod
    def of(cls, spec: LightGuideSpec, device: DeviceSurfaces, light: Spectrum | None) -> Self:
        """Prepare the light of a device.

        Args:
            spec: The device.
            device: Its surfaces.
            light: Spectrum instead of that of the display's white; the luminance stays.
        """
        spectrum = white_light(spec.display) if light is None else light
        scaled = tabulated(
            spectrum.wavelength, spectrum.power / colour.xyz_of(spectrum)[1], spectrum.name
        )
        emitters = spec.display.spectra() if light is None else (light,)
        sampling = by_significance(emitters, floor=_DAYLIGHT_SHARE)
        half_field = as_float(spec.display.size_mm) / (2.0 * spec.lens.focal_length_mm)
        return cls(spec, device, scaled, sampling, half_field)

    def launch(self, count: int, parts: int, rng: np.random.Generator) -> Beam:
        """Launch light from all over the display through all of the lens.

        The flux of each part is that of the whole display.

        Args:
            count: Number of rays in a part; those that miss the lens are left out.
            parts: Number of parts, each of which stands for the whole.
            rng: For the random shift of each part.

        Returns:
            The rays that have left the lens with some flux.
        """
        points = np.concatenate([_points(count, rng) for _ in range(parts)])
        wavelength = self.sampling.wavelength(points[:, 0])
        pixel = (2.0 * points[:, 1:3] - 1.0) * self.half_field * self.device.lens.focal_length
        spot, density = self._spots(pixel, points[:, 3:])
        # per m of wavelength; the integral of xyz_bar is taken over nm
        rate = m_to_nm(self.light(wavelength) / self.sampling.density(wavelength))
        xyz = rate[:, None] * colour.xyz_bar(wavelength)
        start = self._through_lens(pixel, spot, wavelength)
        flux = self.spec.display.luminance_cd_m2 * xyz[:, 1] / (density * count)
        flux *= extent(self.half_field) * projection(start.direction)
        chosen = np.isfinite(start.position).all(axis=1) & (flux > 0.0)
        rays = tracer.Rays(
            start.position[chosen], start.direction[chosen], wavelength[chosen], flux[chosen]
        )
        part = np.repeat(np.arange(parts), count)[chosen]
        return Beam(rays, xyz[chosen] / xyz[chosen, 1:2], part)

    def _spots(self, pixel: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return points in the plane of the lens, from its axis, and their density per m^2.

        Most head for the hologram of the source; the rest are anywhere on the lens, so that all
        light is counted. Each has the density of the mixture.
        """
        size = mm_to_m(as_float(self.spec.patch(self.spec.source.patch).size_mm))
        drift = -pixel / self.device.lens.focal_length * mm_to_m(self.spec.lens.distance_mm)
        radius = mm_to_m(self.spec.lens.diameter_mm) / 2.0
        angle = 2.0 * np.pi * points[:, 0]
        disc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        disc *= radius * np.sqrt(points[:, 1:2])
        aimed = (points[:, :2] - 0.5) * size - drift
        spot = np.where(points[:, 2:] < _STRAY_SHARE, disc, aimed)
        on_patch = np.all(np.abs(spot + drift) <= 0.5 * size, axis=1)
        density = on_patch * (1.0 - _STRAY_SHARE) / np.prod(size)
        return spot, density + _STRAY_SHARE / (np.pi * radius**2)

    def _through_lens(
        self, pixel: FloatArray, spot: FloatArray, wavelength: FloatArray
    ) -> tracer.Rays:
        """Return rays from the display as they leave the lens; NaN where they miss it."""
        lens = self.device.lens
        flat = np.zeros((len(pixel), 1))
        place = np.concatenate([pixel, flat + lens.focal_length], axis=1)
        heading = np.concatenate([spot, flat], axis=1) - place
        rays = tracer.Rays.of(lens.frame.point_to_world(place), heading, wavelength)
        return tracer.walk_sequence(rays, [tracer.Step(lens)]).rays


def white_light(display: DisplaySpec) -> Spectrum:
    """Give the spectrum of a display's white.

    Args:
        display: The display.

    Returns:
        Its primaries, balanced to its white point; relative power.
    """
    primaries = display.spectra()
    shares = colour.white_balance(primaries, display.white)
    nodes = np.unique(np.concatenate([primary.wavelength for primary in primaries]))
    power = np.zeros(nodes.size)
    for share, primary in zip(shares, primaries, strict=True):
        power += share * primary(nodes) / colour.xyz_of(primary)[1]
    return tabulated(nodes, power, "display white")


def extent(half_field: FloatArray) -> float:
    """Area of a field in the tangents along x and y.

    Args:
        half_field: Tangents of its half angles along x and y.

    Returns:
        The area.
    """
    return float(4.0 * half_field[0] * half_field[1])


def projection(direction: FloatArray) -> FloatArray:
    """Projected solid angle per area in the tangents: cos^4 of the angle to the z axis.

    Args:
        direction: Unit directions, shape ``(R, 3)``.

    Returns:
        The ratio, shape ``(R,)``.
    """
    return direction[:, 2] ** 4


def _points(count: int, rng: np.random.Generator) -> FloatArray:
    """Return a rank-1 sequence in the unit cube with a random shift, shape (count, 6)."""
    # The root of x^(d+1) = x + 1 makes the most even steps; five digits are given by 50 rounds.
    root = 2.0
    for _ in range(50):
        root = (1.0 + root) ** (1.0 / (_DIMENSIONS + 1))
    steps = root ** -np.arange(1.0, _DIMENSIONS + 1.0)
    return (rng.random(_DIMENSIONS) + np.arange(count)[:, None] * steps) % 1.0
