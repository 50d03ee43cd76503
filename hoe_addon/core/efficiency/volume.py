# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms: at each point the thick grating that the two recording waves left there.

Inside the emulsion both waves keep the tangential part of n s and follow Snell's law, and
K = k_O - k_R. Development leaves a layer of thickness ``d (1 - s)``, in which K along the normal is
K_z / (1 - s). Light enters by Snell's law too. Two-wave theory (`kogelnik`) then gives the orders
+1 and -1 of each exposure; `sharing` puts them together. Reflection at the faces of the emulsion is
left out, but for total reflection where it is asked for: an order that cannot leave on its own side
is given to the other, without what it does to the grating on its way back.

Rays are n s, wave vectors times lambda / (2 pi), and gratings Q = K / (2 pi), in the frame of
`Incidence`, whose z is turned so that the light runs toward +z.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, as_float, dot, unit
from ..errors import SpecError
from ..media import Medium
from ..orders import TRANSMITTED_ZERO, Branch
from . import kogelnik
from .incidence import Incidence, Polarization
from .sharing import Taken, share_out

type Quantity = float | Callable[[FloatArray], FloatArray]
"""A number, or a function of the place ``(..., 2)`` in metres."""

_SAME_FREQUENCY = 1e-9
"""Exposures differ by more than this, relative."""


@dataclass(frozen=True)
class Exposure:
    """One grating of a hologram.

    Attributes:
        modulation: Amplitude n_1 of the index.
        absorption_modulation: Amplitude of the absorption of the amplitude, 1/m.
        wavelength: Vacuum wavelength of its recording, metres; None for that of the pattern.
    """

    modulation: Quantity
    absorption_modulation: float = 0.0
    wavelength: float | None = None


@dataclass(frozen=True, eq=False)
class _Light:
    """The light inside the emulsion: n s, its index, whether it gets in, and its wavelength."""

    ray: FloatArray
    index: FloatArray
    enters: BoolArray
    wavelength: FloatArray
    depth: FloatArray


@dataclass(frozen=True)
class VolumeGrating:
    """Thick gratings recorded by the same two waves, one at each of some wavelengths.

    Attributes:
        thickness: Of the emulsion when it was exposed, metres.
        index: Of the emulsion when it was exposed.
        exposures: The gratings; those of a wavelength of their own need a pattern that knows its
            waves.
        shrinkage: Share of the thickness that development takes away; below 0 it swells.
        index_shift: What development adds to the index.
        absorption: alpha, of the amplitude, 1/m; the power falls by exp(-2 alpha) a metre.
        normal_frequency: Grating frequency along the normal, 1/m, as recorded; only for a pattern
            that is given outright and does not know it.
        total_internal_reflection: Whether an order +1 or -1 beyond the critical angle of the side
            that it runs to leaves on the other side, if it can.
    """

    thickness: Quantity
    index: Medium
    exposures: tuple[Exposure, ...]
    shrinkage: float = 0.0
    index_shift: float = 0.0
    absorption: float = 0.0
    normal_frequency: float = 0.0
    total_internal_reflection: bool = False

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches, shape ``(..., K)``; see `EfficiencyModel`.

        Raises:
            SpecError: The emulsion has no index at one of the wavelengths.
        """
        inside = self._inside(light)
        vectors = [self._grating(exposure, light) for exposure in self.exposures]
        across = np.ones(light.shape)
        if polarization is not Polarization.UNPOLARISED:
            across = _across(inside.ray, vectors[0], light, inside)
        share_across = {Polarization.S: across, Polarization.P: 1.0 - across}.get(
            polarization, np.full(light.shape, 0.5)
        )
        found = np.zeros((*light.shape, len(branches)))
        for along_fringes, part in ((True, share_across), (False, 1.0 - share_across)):
            mode = self._mode(branches, light, inside, vectors, along_fringes=along_fringes)
            found += part[..., None] * mode
        return np.where(inside.enters[..., None], found, 0.0)

    def fringes(self, light: Incidence) -> tuple[FloatArray, list[FloatArray]]:
        """Return what decides whether light is on Bragg, after development.

        Args:
            light: The light, shape ``(...)``.

        Returns:
            The index of the layer, shape ``(...)``, and the grating vector of each exposure over
            2 pi, 1/m, z along the light, shape ``(..., 3)``; NaN where none was recorded.
        """
        return self._inside(light).index, [self._grating(each, light) for each in self.exposures]

    def _inside(self, light: Incidence) -> _Light:
        index = self._index(light.wavelength) + self.index_shift
        normal_squared = index**2 - dot(light.tangential, light.tangential)
        forward = np.sqrt(np.maximum(normal_squared, 0.0))
        return _Light(
            ray=np.concatenate((light.tangential, forward[..., None]), axis=-1),
            index=index,
            enters=normal_squared > 0.0,
            wavelength=light.wavelength,
            depth=np.maximum(_at(self.thickness, light.place), 0.0) * (1.0 - self.shrinkage),
        )

    def _index(self, wavelength: FloatArray | float) -> FloatArray:
        try:
            return as_float(self.index.index(wavelength))
        except SpecError as error:
            raise SpecError(f"efficiency.index: {error}") from error

    def _grating(self, exposure: Exposure, light: Incidence) -> FloatArray:
        """Q of the developed grating, 1/m; NaN where none was recorded."""
        if light.waves is None:
            tangential = np.stack((light.frequency, np.zeros(light.shape)), axis=-1)
            normal = np.full(light.shape, self.normal_frequency)
        else:
            wavelength = exposure.wavelength or light.waves.wavelength
            index = float(self._index(wavelength))
            waves = (light.waves.object, light.waves.reference)
            tangential = (waves[0][..., :2] - waves[1][..., :2]) / wavelength
            normal = (_normal_part(waves[0], index) - _normal_part(waves[1], index)) / wavelength
        normal = np.where(light.from_front, -normal, normal) / (1.0 - self.shrinkage)
        return np.concatenate((tangential, normal[..., None]), axis=-1)

    def _mode(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        inside: _Light,
        vectors: Sequence[FloatArray],
        *,
        along_fringes: bool,
    ) -> FloatArray:
        """Shares of one polarisation: with the field along the fringes, or in the plane of K."""
        waves = [
            [
                self._wave(exposure, order * vector, light, inside, along_fringes=along_fringes)
                for order in (1, -1)
            ]
            for exposure, vector in zip(self.exposures, vectors, strict=True)
        ]
        bare = np.exp(-2.0 * self.absorption * inside.depth * _per_cosine(inside))
        zero, given = share_out([[taken for taken, _ in pair] for pair in waves], bare)
        found = np.zeros((*light.shape, len(branches)))
        for place, branch in enumerate(branches):
            if branch == TRANSMITTED_ZERO:
                found[..., place] = zero
            number = self._exposed(branch, light)
            if number is not None:
                side = 0 if branch.order == 1 else 1
                to_here = waves[number][side][1] == branch.reflected
                found[..., place] = np.where(to_here, given[number][side], 0.0)
        return found

    def _exposed(self, branch: Branch, light: Incidence) -> int | None:
        """Which exposure a branch belongs to."""
        if abs(branch.order) != 1:
            return None
        for number, exposure in enumerate(self.exposures):
            frequency = 1.0
            if light.waves is not None and exposure.wavelength is not None:
                frequency = light.waves.wavelength / exposure.wavelength
            if abs(branch.frequency / frequency - 1.0) < _SAME_FREQUENCY:
                return number
        return None

    def _wave(
        self,
        exposure: Exposure,
        vector: FloatArray,
        light: Incidence,
        inside: _Light,
        *,
        along_fringes: bool,
    ) -> tuple[Taken, BoolArray]:
        """What one order of one exposure takes in two-wave theory, and whether it goes back."""
        step = vector * inside.wavelength[..., None]
        leaving = inside.ray + step
        exists = dot(leaving[..., :2], leaving[..., :2]) < inside.index**2
        exists = exists & inside.enters & np.isfinite(leaving[..., 2])
        step, leaving = (np.where(exists[..., None], v, inside.ray) for v in (step, leaving))
        coupled = kogelnik.coupling(
            inside.wavelength,
            np.where(exists, _at(exposure.modulation, light.place), 0.0),
            np.where(exists, exposure.absorption_modulation, 0.0),
        )
        if not along_fringes:
            coupled = coupled * kogelnik.polarization_factor(inside.ray, leaving)
        waves = 2.0 * np.pi / inside.wavelength
        wave, rest = kogelnik.efficiencies(
            inside.ray[..., 2] / inside.index,
            leaving[..., 2] / inside.index,
            waves * kogelnik.dephasing(inside.ray, step, inside.index),
            coupled,
            self.absorption,
            inside.depth,
        )
        return Taken(wave, rest), self._leaves_back(leaving, light)

    def _leaves_back(self, leaving: FloatArray, light: Incidence) -> BoolArray:
        """Whether an order inside the emulsion leaves on the side that the light comes from."""
        back = leaving[..., 2] < 0.0
        if not self.total_internal_reflection:
            return back
        squared = dot(leaving[..., :2], leaving[..., :2])
        here = np.where(back, light.index_in, light.index_out)
        there = np.where(back, light.index_out, light.index_in)
        return back ^ ((squared >= here**2) & (squared < there**2))


def _at(quantity: Quantity, place: FloatArray) -> FloatArray:
    return quantity(place) if callable(quantity) else np.full(place.shape[:-1], quantity)


def _per_cosine(inside: _Light) -> FloatArray:
    cosine = np.maximum(inside.ray[..., 2] / inside.index, kogelnik.LEAST_OBLIQUITY)
    return 1.0 / cosine


def _normal_part(wave: FloatArray, index: float) -> FloatArray:
    """Normal part of n s inside a medium; NaN where the wave does not get in."""
    squared = index**2 - dot(wave[..., :2], wave[..., :2])
    size = np.sqrt(np.where(squared >= 0.0, squared, np.nan))
    return np.where(wave[..., 2] < 0.0, -size, size)


def _across(ray: FloatArray, vector: FloatArray, light: Incidence, inside: _Light) -> FloatArray:
    """Share of s-polarised light whose field is along the fringes, across rho and K."""
    grooves = np.broadcast_to((0.0, 1.0), light.tangential.shape)
    tilted = dot(light.tangential, light.tangential) > (1e-9 * inside.index) ** 2
    along = unit(np.where(tilted[..., None], light.tangential, (1.0, 0.0)))
    across_plane = np.stack((-along[..., 1], along[..., 0]), axis=-1)
    s = np.where(tilted[..., None], across_plane, grooves)
    normal = np.cross(ray, vector)
    squared = dot(normal, normal)
    flat = ~(squared > 1e-18 * dot(ray, ray) * dot(vector, vector))
    shared = dot(s, normal[..., :2]) ** 2 / np.where(flat, 1.0, squared)
    return np.where(flat, 1.0, np.minimum(shared, 1.0))
