# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which wavelength a light path has: the inverse distribution, and the tables that go with it.

A path draws t uniformly from [0, 1] and has the wavelength lambda(t). Three tables over the same
nodes t = i/K, with straight lines between them, are all that a renderer needs: lambda(t); the
filter W(t), linear RGB, in front of the eye; and the emission E(t) of each known spectrum.

* The mean of W over t is exactly (1, 1, 1): light without a spectrum of its own counts as daylight,
  and its RGB comes out unchanged.
* The mean of W E over t has luminance exactly 1, and the colour of the spectrum.

W and E are not samples at the nodes but means over the two cells beside each node (a projection on
hat functions, weighted with wavelength). So no light is lost however narrow a line is or however
fast the density changes.

Colour errors, in u'v', with 512 cells: primaries that the sampling knows, 1 nm lasers included, and
standard illuminants below 1e-4; other 1 nm lines, from 460 to 630 nm, below 5e-4.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float
from .colour import LUMINANCE_WEIGHTS, linear_rgb_bar
from .errors import SpecError
from .quadrature import hat_areas, hat_integrals
from .spectrum import Spectrum, illuminant
from .units import m_to_nm

VISIBLE_SPAN = (360e-9, 830e-9)
"""Whole range of the CIE 1931 observer, in m: nothing visible is left out."""

_MUST_COVER = (400e-9, 700e-9)  # less cannot give the white its colour
_FINE_STEP = 0.1e-9  # of the grid on which the density is known, beside the nodes of the spectra
# No cell is wider than this many mean cells, so that no rare sample stands out.
_WIDEST_CELL = 8.0
# Most often that a wavelength is drawn, over daylight: the filter weighs the inverse, and Cycles
# drops what weighs less than 1e-5. A line of 1e-3 nm alone would come near.
_MOST_GAIN = 1e4
# Largest change of cell width per length: the straight lines between nodes must follow.
_WIDTH_GROWTH = 0.25


@dataclass(frozen=True, eq=False)
class SpectralTables:
    """What a shader needs to know about the spectra of a scene.

    Attributes:
        wavelength_nm: Wavelength at the nodes in nm, shape ``(K + 1,)``.
        filter_rgb: Filter W at the nodes, linear RGB, shape ``(K + 1, 3)``; may be negative.
        emission: Emission E at the nodes for unit luminance, at least 0, shape ``(P, K + 1)``.
    """

    wavelength_nm: FloatArray
    filter_rgb: FloatArray
    emission: FloatArray


@dataclass(frozen=True, eq=False)
class WavelengthSampling:
    """Inverse distribution of the wavelength, straight lines between nodes at t = i/K.

    Attributes:
        wavelength_nodes: Wavelengths at the nodes in m, increasing, shape ``(K + 1,)``.

    Raises:
        SpecError: The nodes do not increase, do not reach from 400 to 700 nm, or leave 360-830 nm.
    """

    wavelength_nodes: FloatArray

    def __post_init__(self) -> None:
        """Check the nodes and keep a read-only copy of them."""
        nodes = np.array(self.wavelength_nodes, dtype=np.float64)
        if nodes.ndim != 1 or nodes.size < 2 or not np.all(np.diff(nodes) > 0.0):
            raise SpecError("sampling.wavelength: needs 2 or more nodes that increase")
        _check_span(float(nodes[0]), float(nodes[-1]))
        nodes.flags.writeable = False
        object.__setattr__(self, "wavelength_nodes", nodes)

    @property
    def cells(self) -> int:
        """Number of cells, K."""
        return self.wavelength_nodes.size - 1

    def wavelength(self, t: ArrayLike) -> FloatArray:
        """Wavelength that belongs to a random number.

        Args:
            t: Number in [0, 1], clamped to it, shape ``(...)``.

        Returns:
            Wavelength in m, shape ``(...)``.
        """
        nodes = self.wavelength_nodes
        position = as_float(t) * self.cells
        return np.asarray(np.interp(position, np.arange(nodes.size), nodes))

    def density(self, wavelength: ArrayLike) -> FloatArray:
        """Probability density of the wavelength, the same all over a cell.

        Args:
            wavelength: Wavelength in m, shape ``(...)``.

        Returns:
            Density per m, shape ``(...)``; zero outside the nodes.
        """
        at = as_float(wavelength)
        nodes = self.wavelength_nodes
        cell = np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, self.cells - 1)
        inside = (at >= nodes[0]) & (at <= nodes[-1])
        return np.where(inside, 1.0 / (self.cells * np.diff(nodes)[cell]), 0.0)

    @cached_property
    def filter_rgb(self) -> FloatArray:
        """Filter W at the nodes, linear RGB, mean over t exactly (1, 1, 1), shape (K + 1, 3)."""
        white = illuminant("D65")

        def response(at: FloatArray) -> FloatArray:
            return white(at)[..., None] * linear_rgb_bar(at)

        raw = hat_integrals(response, self.wavelength_nodes, white.wavelength)
        # At the ends a node has one cell instead of two.
        raw[[0, -1]] *= 2.0
        raw /= _mean(raw)
        raw.flags.writeable = False
        return raw

    def emission(self, spectrum: Spectrum) -> FloatArray:
        """Emission E of a spectrum, for unit luminance.

        Args:
            spectrum: Spectral power of the emitter.

        Returns:
            E at the nodes, at least 0, shape ``(K + 1,)``; the mean of W E has luminance 1.

        Raises:
            SpecError: The spectrum has no visible power.
        """
        white = illuminant("D65")

        def ratio(at: FloatArray) -> FloatArray:
            return (spectrum(at) / white(at))[..., None]

        breaks = np.union1d(white.wavelength, spectrum.wavelength)
        nodes = self.wavelength_nodes
        emission = hat_integrals(ratio, nodes, breaks)[:, 0] / hat_areas(nodes)
        luminance = float(self.mean_rgb(emission) @ LUMINANCE_WEIGHTS)
        if not luminance > 0.0:
            raise SpecError(f"{spectrum.name}: has no visible power, so it cannot have a luminance")
        return emission / luminance

    def mean_rgb(self, emission: ArrayLike) -> FloatArray:
        """Colour that the eye sees of an emission: the mean of W E over t.

        Args:
            emission: E at the nodes, shape ``(..., K + 1)``.

        Returns:
            Linear RGB, shape ``(..., 3)``: the exact mean of the product of the two tables'
            interpolants.
        """
        e = as_float(emission)[..., None]
        w = self.filter_rgb
        e0, e1, w0, w1 = e[..., :-1, :], e[..., 1:, :], w[:-1], w[1:]
        return np.mean(e0 * w0 + e1 * w1 + 0.5 * (e0 * w1 + e1 * w0), axis=-2) / 3.0

    def shader_tables(self, spectra: Sequence[Spectrum] = ()) -> SpectralTables:
        """Tables for a shader that interpolates them linearly in t.

        Args:
            spectra: P emitters.

        Returns:
            The tables, with one row of emission for each emitter.

        Raises:
            SpecError: A spectrum has no visible power.
        """
        rows = [self.emission(spectrum) for spectrum in spectra]
        emission = np.array(rows).reshape(len(rows), self.cells + 1)
        return SpectralTables(m_to_nm(self.wavelength_nodes), self.filter_rgb, emission)


def uniform(low: float, high: float, cells: int = 512) -> WavelengthSampling:
    """Every wavelength equally likely.

    Args:
        low: Shortest wavelength in m, from 360e-9 to 400e-9.
        high: Longest wavelength in m, from 700e-9 to 830e-9.
        cells: Number of cells, at least 1.

    Returns:
        The sampling.

    Raises:
        SpecError: The range or the number is not so.
    """
    _check_cells(cells)
    _check_span(low, high)
    return WavelengthSampling(np.linspace(low, high, cells + 1))


def by_significance(
    spectra: Sequence[Spectrum] = (),
    floor: float = 0.5,
    cells: int = 512,
    span: tuple[float, float] = VISIBLE_SPAN,
    weights: Sequence[float] | None = None,
) -> WavelengthSampling:
    """Draw wavelengths by what they contribute to the picture.

    The density is ``floor`` times the significance of daylight, for what ordinary RGB lights light,
    and 1 - ``floor`` times the mean of that of the given spectra. Significance is power times the
    eye's response |r| + |g| + |b|. A minimum all over the range keeps all wavelengths unbiased.

    Args:
        spectra: Spectra in the scene; put every narrow one in, so that it is resolved.
        floor: Share of daylight, above 0 and at most 1.
        cells: Number of cells, at least 1.
        span: Shortest and longest wavelength in m, as in ``uniform``.
        weights: What each spectrum counts in the mean, at least 0 and not all 0; equal if None.

    Returns:
        The sampling.

    Raises:
        SpecError: An argument is out of its range, or a spectrum has no visible power.
    """
    _check_cells(cells)
    if not 0.0 < floor <= 1.0:
        raise SpecError(f"floor: must be above 0 and at most 1, got {floor!r}")
    low, high = span
    _check_span(low, high)
    grid: FloatArray = np.linspace(low, high, 1 + round((high - low) / _FINE_STEP))
    for spectrum in spectra:
        own = spectrum.wavelength
        grid = as_float(np.union1d(grid, own[(own > low) & (own < high)]))
    eye = np.sum(np.abs(linear_rgb_bar(grid)), axis=-1)
    density = daylight = _significance(illuminant("D65"), grid, eye)
    if spectra:
        shares = [_significance(spectrum, grid, eye) for spectrum in spectra]
        density = floor * density + (1.0 - floor) * np.average(shares, axis=0, weights=weights)
        density = np.minimum(density, _MOST_GAIN * daylight)
    return WavelengthSampling(_nodes_of(grid, _graded_width(grid, density, cells), cells))


def _check_span(low: float, high: float) -> None:
    """Refuse a range that cuts the visible light or leaves it."""
    if (
        not VISIBLE_SPAN[0] <= low <= _MUST_COVER[0]
        or not _MUST_COVER[1] <= high <= VISIBLE_SPAN[1]
    ):
        raise SpecError(
            "sampling.wavelength: must reach from 400 to 700 nm and stay within 360-830 nm, "
            f"got {m_to_nm(low):g} to {m_to_nm(high):g} nm"
        )


def _check_cells(cells: int) -> None:
    """Refuse a table without cells."""
    if cells < 1:
        raise SpecError(f"cells: must be at least 1, got {cells!r}")


def _mean(values: FloatArray) -> FloatArray:
    """Mean over t of the straight lines between nodes, shape of one node."""
    return np.mean(0.5 * (values[1:] + values[:-1]), axis=0)


def _significance(spectrum: Spectrum, grid: FloatArray, eye: FloatArray) -> FloatArray:
    """Power times the eye's response, integral 1, shape of the grid."""
    values = spectrum(grid) * eye
    total = float(np.trapezoid(values, grid))
    if not total > 0.0:
        raise SpecError(f"{spectrum.name}: has no visible power")
    return values / total


def _graded_width(grid: FloatArray, density: FloatArray, cells: int) -> FloatArray:
    """Wanted cell width over the grid: 1 / (K density), cut off and with bounded slope."""
    widest = _WIDEST_CELL * (grid[-1] - grid[0]) / cells
    width = 1.0 / np.maximum(cells * density, 1.0 / widest)
    ramp = _WIDTH_GROWTH * grid
    width = np.minimum.accumulate(width - ramp) + ramp
    return np.minimum.accumulate((width + ramp)[::-1])[::-1] - ramp


def _nodes_of(grid: FloatArray, width: FloatArray, cells: int) -> FloatArray:
    """Nodes at equal steps of the integral of 1 / width, shape (cells + 1,)."""
    rate = 1.0 / width
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(grid)
    reached = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(np.interp(np.linspace(0.0, float(reached[-1]), cells + 1), reached, grid))
