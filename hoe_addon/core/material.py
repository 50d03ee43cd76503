# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Complex index and permittivity of materials that may absorb, such as metals.

With the time convention exp(-i omega t) an absorbing material has n + i k with k > 0.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .arrays import ComplexArray, FloatArray, as_float
from .errors import SpecError
from .media import Medium
from .units import m_to_nm


@dataclass(frozen=True, eq=False)
class TabulatedIndex:
    """An index that is measured at some wavelengths, linear between them.

    Attributes:
        wavelength: Vacuum wavelengths, metres, ascending, shape ``(J,)``.
        values: n + i k at each, shape ``(J,)``.
    """

    wavelength: FloatArray
    values: ComplexArray

    def index(self, wavelength: ArrayLike) -> ComplexArray:
        """Refractive index; see `Material.index`.

        Raises:
            SpecError: A wavelength is outside the table.
        """
        asked = as_float(wavelength)
        first, last = self.wavelength[0], self.wavelength[-1]
        outside = ~((asked >= first) & (asked <= last))
        if np.any(outside):
            bad = m_to_nm(float(asked[outside].flat[0]))
            ends = f"{m_to_nm(float(first)):g} to {m_to_nm(float(last)):g} nm"
            raise SpecError(f"table holds no index at {bad:g} nm; its rows go from {ends}")
        return np.interp(asked, self.wavelength, self.values)


@dataclass(frozen=True)
class Material:
    """What a part of a grating is made of.

    Attributes:
        field: Path of the field that names it, for messages.
        source: A transparent medium, a constant n + i k, or a table.
    """

    field: str
    source: Medium | complex | TabulatedIndex

    def index(self, wavelength: ArrayLike) -> ComplexArray:
        """Refractive index.

        Args:
            wavelength: Vacuum wavelengths, metres, shape ``(...)``.

        Returns:
            n + i k, shape ``(...)``.

        Raises:
            SpecError: With the field, where there is no index at a wavelength.
        """
        metres = as_float(wavelength)
        if not isinstance(self.source, Medium | TabulatedIndex):
            return np.full(metres.shape, self.source, dtype=np.complex128)
        try:
            return np.asarray(self.source.index(metres), dtype=np.complex128)
        except SpecError as error:
            raise SpecError(f"{self.field}: {error}") from error

    def permittivity(self, wavelength: ArrayLike) -> ComplexArray:
        """Relative permittivity, the square of `index`, shape ``(...)``."""
        return self.index(wavelength) ** 2


@dataclass(frozen=True)
class IndexWave:
    """The wave of a volume grating whose index is n + dn cos(K.r), to first order in dn.

    Attributes:
        mean: Material of the mean index n.
        modulation: Amplitude dn.
    """

    mean: Material
    modulation: float

    def permittivity(self, wavelength: ArrayLike) -> ComplexArray:
        """Amplitude 2 n dn of the wave of the permittivity, shape ``(...)``."""
        return 2.0 * self.mean.index(wavelength) * self.modulation
