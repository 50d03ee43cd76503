# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From spectra to colour: the CIE 1931 observer and linear Rec. 709 primaries."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import data
from .arrays import FloatArray, as_float
from .errors import SpecError
from .quadrature import gauss_points
from .spectrum import Spectrum, illuminant
from .units import m_to_nm, nm_to_m

_REC709_XY = ((0.640, 0.330), (0.300, 0.600), (0.150, 0.060))
_REC709_WHITE_XY = (0.3127, 0.3290)
# Displays reach about 100; far above, two primaries have one colour but for rounding.
_WORST_CONDITION = 1e6


def _xyz_of_xy(xy: tuple[float, float]) -> FloatArray:
    """XYZ with Y = 1 of a chromaticity."""
    x, y = xy
    return np.array([x / y, 1.0, (1.0 - x - y) / y])


def _rec709_to_xyz() -> FloatArray:
    """Matrix whose columns are the XYZ of the primaries, their sum being the white."""
    primaries = np.stack([_xyz_of_xy(xy) for xy in _REC709_XY], axis=1)
    return primaries * np.linalg.solve(primaries, _xyz_of_xy(_REC709_WHITE_XY))


LINEAR_REC709_TO_XYZ = _rec709_to_xyz()
"""Linear RGB to XYZ, shape (3, 3), by the chromaticities of ITU-R BT.709-6."""

XYZ_TO_LINEAR_REC709 = np.linalg.inv(LINEAR_REC709_TO_XYZ)
"""XYZ to linear RGB, shape (3, 3)."""

LUMINANCE_WEIGHTS = LINEAR_REC709_TO_XYZ[1]
"""Share of linear red, green and blue in the luminance, shape (3,), sum 1."""


def xyz_bar(wavelength: ArrayLike) -> FloatArray:
    """Colour-matching functions of the CIE 1931 standard observer (2 degrees).

    Args:
        wavelength: Wavelength in m, shape ``(...)``.

    Returns:
        x, y, z, shape ``(..., 3)``; straight lines between the 1 nm nodes, zero outside
        360-830 nm.

    References:
        CIE 018:2019, doi:10.25039/CIE.DS.xvudnb9b
    """
    table = data.load("cie_1931_2deg_1nm")
    at = as_float(wavelength)
    nodes = nm_to_m(table[:, 0])
    columns = [np.interp(at, nodes, table[:, i], left=0.0, right=0.0) for i in (1, 2, 3)]
    return np.stack(columns, axis=-1)


def linear_rgb_bar(wavelength: ArrayLike) -> FloatArray:
    """Colour-matching functions for linear Rec. 709 primaries.

    Args:
        wavelength: Wavelength in m, shape ``(...)``.

    Returns:
        r, g, b, shape ``(..., 3)``; negative where a pure colour is outside the primaries' gamut.
    """
    return xyz_bar(wavelength) @ XYZ_TO_LINEAR_REC709.T


def xyz_of(spectrum: Spectrum) -> FloatArray:
    """Tristimulus values of a spectrum.

    Args:
        spectrum: Spectral power.

    Returns:
        XYZ, shape ``(3,)``: the exact integral of power times ``xyz_bar`` over wavelength in nm,
        no normalisation.
    """
    edges = np.union1d(nm_to_m(data.load("cie_1931_2deg_1nm")[:, 0]), spectrum.wavelength)
    points, weights = gauss_points(edges)
    power = weights * spectrum(points)
    return m_to_nm(np.einsum("ij,ijk->k", power, xyz_bar(points)))


def white_point(name: str) -> FloatArray:
    """XYZ of a standard illuminant, with Y = 1.

    Args:
        name: Illuminant, as in ``spectrum.illuminant``.

    Returns:
        XYZ, shape ``(3,)``.

    Raises:
        SpecError: There is no such illuminant.
    """
    xyz = xyz_of(illuminant(name))
    return xyz / xyz[1]


def uv_prime(xyz: ArrayLike) -> FloatArray:
    """Chromaticity in the CIE 1976 diagram.

    Args:
        xyz: Tristimulus values, shape ``(..., 3)``.

    Returns:
        u' and v', shape ``(..., 2)``; NaN where X + 15 Y + 3 Z is not above 0 (black).

    References:
        ISO/CIE 11664-5:2016.
    """
    values = as_float(xyz)
    total = values @ np.array([1.0, 15.0, 3.0])
    total = np.where(total > 0.0, total, np.nan)
    return values[..., :2] * np.array([4.0, 9.0]) / total[..., None]


def white_balance(primaries: Sequence[Spectrum], white: str = "D65") -> FloatArray:
    """Share of each primary in the luminance of a display's white.

    Args:
        primaries: Red, green and blue.
        white: Illuminant whose colour the sum of the three has.

    Returns:
        Shares, shape ``(3,)``, sum 1.

    Raises:
        SpecError: There are not three primaries, one is invisible, they do not span the colours,
            or the white lies outside their gamut.
    """
    if len(primaries) != 3:
        raise SpecError(f"primaries: must be 3, got {len(primaries)}")
    columns: list[FloatArray] = []
    for primary in primaries:
        xyz = xyz_of(primary)
        if not xyz[1] > 0.0:
            raise SpecError(f"primaries: {primary.name} has no visible power")
        columns.append(xyz / xyz[1])
    matrix = np.stack(columns, axis=1)
    if np.linalg.cond(matrix) > _WORST_CONDITION:
        raise SpecError("primaries: must be of three different colours")
    shares = np.linalg.solve(matrix, white_point(white))
    if not np.all(shares >= 0.0):
        raise SpecError(f"primaries: the white {white} is outside their gamut, shares {shares}")
    return shares
