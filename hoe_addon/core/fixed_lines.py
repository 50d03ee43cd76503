# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All light at a few wavelengths: what renderers with three or nine colours do.

Each line stands for the wavelengths that are nearer to it than to any other. RGB light comes
out unchanged; a narrow emitter takes the colour of its line, and a rainbow falls apart into as many
pictures as there are lines. It is an approximation, here to be compared with.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray
from .colour import LUMINANCE_WEIGHTS, linear_rgb_bar
from .errors import SpecError
from .quadrature import gauss_points
from .spectrum import Spectrum, illuminant
from .units import m_to_nm
from .wavelength_sampling import VISIBLE_SPAN, WavelengthSampling

_STEP = 0.1e-9


@dataclass(frozen=True, eq=False)
class FixedLines(WavelengthSampling):
    """As many equal runs of nodes as there are lines, all of a run at one wavelength.

    Between two runs one cell of the table leads over; it is as rare as the table is long.

    Attributes:
        wavelength_nodes: Wavelengths at the nodes in m, none below the one before, with runs of
            equal ones, shape ``(K + 1,)``.
    """

    def __post_init__(self) -> None:
        """Keep a read-only copy of the nodes."""
        nodes = np.array(self.wavelength_nodes, dtype=np.float64)
        nodes.flags.writeable = False
        object.__setattr__(self, "wavelength_nodes", nodes)

    def density(self, wavelength: ArrayLike) -> FloatArray:
        """Refused: lines have no density.

        Args:
            wavelength: Wavelength in m.

        Raises:
            SpecError: Always.
        """
        raise SpecError("wavelengths: fixed lines have no density")

    @cached_property
    def filter_rgb(self) -> FloatArray:
        """Filter W at the nodes, linear RGB, mean over t exactly (1, 1, 1), shape (K + 1, 3)."""
        raw = self._of_lines(illuminant("D65"), linear_rgb_bar)
        raw /= np.mean(0.5 * (raw[1:] + raw[:-1]), axis=0)
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

        def seen(wavelength: FloatArray) -> FloatArray:
            return (linear_rgb_bar(wavelength) @ LUMINANCE_WEIGHTS)[..., None]

        own = self._of_lines(spectrum, seen)[:, 0]
        white = self._of_lines(illuminant("D65"), seen)[:, 0]
        emission = np.maximum(own / white, 0.0)
        luminance = float(self.mean_rgb(emission) @ LUMINANCE_WEIGHTS)
        if not luminance > 0.0:
            raise SpecError(f"{spectrum.name}: has no visible power, so it cannot have a luminance")
        return emission / luminance

    def _of_lines(self, spectrum: Spectrum, response: "Response") -> FloatArray:
        """Integral of spectrum times response over the range of each node's line."""
        lines, of_node = np.unique(self.wavelength_nodes, return_inverse=True)
        low, high = VISIBLE_SPAN
        middles = 0.5 * (lines[1:] + lines[:-1])
        grid = np.linspace(low, high, 1 + round((high - low) / _STEP))
        own = spectrum.wavelength
        edges = np.unique(np.concatenate((grid, middles, own[(own > low) & (own < high)])))
        points, weights = gauss_points(edges)
        values = np.sum((weights * spectrum(points))[..., None] * response(points), axis=1)
        total = np.zeros((lines.size, values.shape[-1]))
        np.add.at(total, np.searchsorted(middles, points[:, 0]), values)
        return total[of_node]


type Response = Callable[[FloatArray], FloatArray]
"""From wavelengths in m, shape ``(...)``, to what is seen of them, shape ``(..., channels)``."""


def fixed_lines(lines: Sequence[float], cells: int = 512) -> FixedLines:
    """All light at a few wavelengths.

    Args:
        lines: Wavelengths in m, different ones, within 360 to 830 nm.
        cells: Number of cells, at least as many as lines.

    Returns:
        The sampling.

    Raises:
        SpecError: There is no line, or one twice, or one outside the eye's range.
    """
    ordered = np.unique(lines)
    low, high = VISIBLE_SPAN
    if ordered.size < max(1, len(lines)) or ordered[0] < low or ordered[-1] > high:
        shown = ", ".join(f"{m_to_nm(line):g}" for line in lines)
        raise SpecError(f"lines: must be different wavelengths within 360-830 nm, got {shown}")
    return FixedLines(ordered[np.arange(cells + 1) * ordered.size // (cells + 1)])
