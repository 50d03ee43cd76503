# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Refractive index of optical media by their dispersion formula.

Indices are relative to air and wavelengths are those in air, as in the makers' catalogues and in
the tables of the eye's response. So air has the index 1 exactly.
"""

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float
from .errors import SpecError
from .units import UM, m_to_nm

_EVERYWHERE_NM = (0.0, float("inf"))


@dataclass(frozen=True)
class Medium:
    """A transparent medium, n^2 = a + sum of b L^2 / (L^2 - c), with L in micrometres.

    Attributes:
        name: Name for messages and files.
        a: Constant term; 1 for a Sellmeier formula, n^2 for a constant index.
        b: Strengths of the three resonances, dimensionless.
        c_um2: Squares of the three resonance wavelengths, in um^2.
        range_nm: Wavelengths for which the source vouches; the formula answers outside too.
        source: Where the numbers come from.
    """

    name: str
    a: float
    b: tuple[float, float, float]
    c_um2: tuple[float, float, float]
    range_nm: tuple[float, float]
    source: str

    def index(self, wavelength: ArrayLike) -> FloatArray:
        """Refractive index.

        Args:
            wavelength: Wavelength in m, above 0, shape ``(...)``.

        Returns:
            Index, at least 1, shape ``(...)``.

        Raises:
            SpecError: Where the formula gives no index of at least 1 (inside or beyond an
                absorption band), or the wavelength is not above 0.
        """
        metres = as_float(wavelength)
        squared_um2 = (metres / UM) ** 2
        squared_index = np.full(metres.shape, self.a)
        with np.errstate(divide="ignore", invalid="ignore"):
            for strength, resonance in zip(self.b, self.c_um2, strict=True):
                if strength != 0.0:
                    squared_index += strength * squared_um2 / (squared_um2 - resonance)
        usable = np.isfinite(squared_index) & (squared_index >= 1.0) & (metres > 0.0)
        if not np.all(usable):
            first_nm = m_to_nm(float(metres[~usable].flat[0]))
            raise SpecError(f"medium {self.name}: has no index of at least 1 at {first_nm:g} nm")
        return np.sqrt(squared_index)


def constant(index: float, name: str | None = None) -> Medium:
    """A medium without dispersion.

    Args:
        index: Refractive index, at least 1.
        name: Name of the medium; by default it tells the index.

    Returns:
        The medium; its ``index`` gives exactly the number put in.

    Raises:
        SpecError: The index is below 1 or not finite.
    """
    if not (np.isfinite(index) and index >= 1.0):
        raise SpecError(f"index: must be a finite number of at least 1, got {index!r}")
    zeros = (0.0, 0.0, 0.0)
    label = f"n = {index!r}" if name is None else name
    return Medium(label, float(index) ** 2, zeros, zeros, _EVERYWHERE_NM, "constant")


_SCHOTT = "SCHOTT optical glass catalogue, datasheet of 2014-02-01"
_SULTANOVA = (
    "N. Sultanova, S. Kasarova, I. Nikolov, Acta Physica Polonica A 116, 585 (2009), "
    "doi:10.12693/APhysPolA.116.585; one-term fit by M. Polyanskiy, refractiveindex.info"
)

CATALOGUE = MappingProxyType(
    {
        medium.name: medium
        for medium in (
            constant(1.0, "air"),
            Medium(
                "fused silica",
                1.0,
                (0.6961663, 0.4079426, 0.8974794),
                (0.0684043**2, 0.1162414**2, 9.896161**2),
                (210.0, 3710.0),
                "I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965), doi:10.1364/JOSA.55.001205",
            ),
            Medium(
                "N-BK7",
                1.0,
                (1.03961212, 0.231792344, 1.01046945),
                (0.00600069867, 0.0200179144, 103.560653),
                (300.0, 2500.0),
                _SCHOTT,
            ),
            Medium(
                "PMMA",
                1.0,
                (1.1819, 0.0, 0.0),
                (0.011313, 0.0, 0.0),
                (436.8, 1052.0),
                _SULTANOVA,
            ),
            Medium(
                "polycarbonate",
                1.0,
                (1.4182, 0.0, 0.0),
                (0.021304, 0.0, 0.0),
                (436.8, 1052.0),
                _SULTANOVA,
            ),
            Medium(
                "N-SF15",
                1.0,
                (1.57055634, 0.218987094, 1.50824017),
                (0.0116507014, 0.0597856897, 132.709339),
                (370.0, 2500.0),
                _SCHOTT,
            ),
            Medium(
                "N-LASF31A",
                1.0,
                (1.96485075, 0.475231259, 1.48360109),
                (0.00982060155, 0.0344713438, 110.739863),
                (250.0, 2500.0),
                _SCHOTT,
            ),
            Medium(
                "N-SF66",
                1.0,
                (2.0245976, 0.470187196, 2.59970433),
                (0.0147053225, 0.0692998276, 161.817601),
                (390.0, 2500.0),
                _SCHOTT,
            ),
        )
    }
)
"""Media by name."""


def by_name(name: str) -> Medium:
    """Look a medium up in the catalogue.

    Args:
        name: Its name, as in ``CATALOGUE``.

    Returns:
        The medium.

    Raises:
        SpecError: No medium has this name; the message lists those that there are.
    """
    try:
        return CATALOGUE[name]
    except KeyError:
        known = ", ".join(CATALOGUE)
        raise SpecError(f"medium: must be one of {known}; got {name!r}") from None
