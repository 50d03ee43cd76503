# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Modes of a layer that does not vary along y and z.

Every mode has either no electric field along x (LSE) or no magnetic field along x (LSM). With
alpha the diagonal matrix of the tangential wave numbers along x over k0,

    LSE:  ([[eps]] - alpha^2) phi = mu phi
    LSM:  A (1 - alpha [[eps]]^-1 alpha) psi = mu psi

where A acts on the electric field across the walls, and mu = gamma^2 + beta^2 with gamma along z
and beta along y. Neither depends on beta, and both families stay apart exactly after truncation.
Where the permittivity is real and positive both problems are made Hermitian, so that mu is real
to the last bit. Nothing further on depends on the sign of gamma.

In conical mount a mode with mu = 0 belongs to both families, which then no longer span all fields;
for 1/mu as many digits are lost beside it. A layer of one material needs no modes there, see
`scattering.uniform_scatter`; any other one is moved off such a point, see `conical_modes`.

References:
    Li (1993), Multilayer modal method for diffraction gratings of arbitrary profile, depth, and
    permittivity, J. Opt. Soc. Am. A 10, 2581, doi:10.1364/JOSAA.10.002581.
    Li (1996), Use of Fourier series in the analysis of discontinuous periodic structures,
    J. Opt. Soc. Am. A 13, 1870, doi:10.1364/JOSAA.13.001870.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import ComplexArray, FloatArray
from .factorisation import Factors, Matrix
from .stack import Pattern, Uniform

_LEAST_MU = 1e-7
"""Closer to mu = 0 than this fewer than nine digits are left."""
_OFF = 3e-7
"""What the permittivities are raised by there, and mu with them: some 1e-6 of the phase of a
wavelength of thickness."""


@dataclass(frozen=True, eq=False)
class LseModes:
    """Modes without E_x for each of B waves, one a column.

    Attributes:
        mu: Eigenvalues, shape ``(B, n)``.
        field: phi, harmonics of E_y, shape ``(B, n, n)``.
        turned: alpha phi, which H_y is proportional to in conical mount, shape ``(B, n, n)``.
    """

    mu: Matrix
    field: Matrix
    turned: Matrix


@dataclass(frozen=True, eq=False)
class LsmModes:
    """Modes without H_x for each of B waves, one a column.

    Attributes:
        mu: Eigenvalues, shape ``(B, n)``.
        field: psi, harmonics of H_y, shape ``(B, n, n)``.
        across: A^-1 psi, which E_x is proportional to, shape ``(B, n, n)``.
        along: [[eps]]^-1 alpha psi, which E_y is proportional to in conical mount.
    """

    mu: Matrix
    field: Matrix
    across: Matrix
    along: Matrix


def lse_modes(pattern: Pattern, alpha: FloatArray, permittivity: ComplexArray) -> LseModes:
    """Return the modes of a layer that have no electric field along x.

    Args:
        pattern: The layer, without its shift.
        alpha: Wave numbers along x of all harmonics, over k0, shape ``(B, n)``.
        permittivity: Of all materials, shape ``(B, M)``.

    Returns:
        The modes.
    """
    if isinstance(pattern, Uniform):
        value = _real_if_lossless(permittivity[:, pattern.material])
        return LseModes(value[:, None] - alpha**2, _ones(alpha), _diagonal(alpha))
    factors = Factors(pattern, permittivity, alpha.shape[1])
    matrix = factors.direct - _diagonal(alpha**2)
    mu, field = np.linalg.eigh(matrix) if factors.lossless else np.linalg.eig(matrix)
    return LseModes(mu, field, alpha[:, :, None] * field)


def lsm_modes(pattern: Pattern, alpha: FloatArray, permittivity: ComplexArray) -> LsmModes:
    """Return the modes of a layer that have no magnetic field along x.

    Args:
        pattern: The layer, without its shift.
        alpha: Wave numbers along x of all harmonics, over k0, shape ``(B, n)``.
        permittivity: Of all materials, shape ``(B, M)``.

    Returns:
        The modes.
    """
    if isinstance(pattern, Uniform):
        value = _real_if_lossless(permittivity[:, pattern.material])[:, None]
        one = _ones(alpha)
        return LsmModes(value - alpha**2, one, one / value[:, :, None], _diagonal(alpha / value))
    factors = Factors(pattern, permittivity, alpha.shape[1])
    wave = alpha[:, :, None] * factors.direct_inverse * alpha[:, None, :]
    operator = np.eye(alpha.shape[1]) - wave
    if factors.lossless:
        mu, field, across = _definite(operator, factors)
    else:
        mu, field = np.linalg.eig(np.linalg.solve(factors.reciprocal, operator))
        across = factors.reciprocal @ field
    return LsmModes(mu, field, across, factors.direct_inverse @ (alpha[:, :, None] * field))


def conical_modes(
    pattern: Pattern, alpha: FloatArray, permittivity: ComplexArray
) -> tuple[LseModes, LsmModes]:
    """Return both families, so that together they span all fields.

    Args:
        pattern: The layer, without its shift.
        alpha: Wave numbers along x of all harmonics, over k0, shape ``(B, n)``.
        permittivity: Of all materials, shape ``(B, M)``.

    Returns:
        The modes; where one would have mu = 0, those of slightly higher permittivities.
    """
    lse = lse_modes(pattern, alpha, permittivity)
    shared = np.min(np.abs(lse.mu), axis=1) < _LEAST_MU
    if np.any(shared):
        permittivity = permittivity + np.where(shared, _OFF, 0.0)[:, None]
        lse = lse_modes(pattern, alpha, permittivity)
    return lse, lsm_modes(pattern, alpha, permittivity)


def _definite(operator: Matrix, factors: Factors) -> tuple[FloatArray, Matrix, Matrix]:
    """Solve operator psi = mu A^-1 psi, with A^-1 = L L^H positive definite."""
    lower = np.linalg.cholesky(factors.reciprocal)
    inverse = np.linalg.inv(lower)
    inverse_h = np.conj(np.swapaxes(inverse, -1, -2))
    values, vectors = np.linalg.eigh(inverse @ operator @ inverse_h)
    return values, inverse_h @ vectors, lower @ vectors


def _real_if_lossless(values: ComplexArray) -> Matrix:
    return values.real if np.all(values.imag == 0.0) else values


def _ones(alpha: FloatArray) -> FloatArray:
    return np.broadcast_to(np.eye(alpha.shape[1]), (*alpha.shape, alpha.shape[1]))


def _diagonal(values: Matrix) -> Matrix:
    return values[:, :, None] * np.eye(values.shape[1])
