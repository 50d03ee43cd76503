# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
r"""Coupled two-wave theory of thick gratings: transmission and reflection, slanted, absorbing.

The light R and one diffracted wave S run in a layer of mean index n, which is modulated as
``n + n_1 cos(K.r)`` and absorbs as ``alpha + alpha_1 cos(K.r)`` (of the amplitude, 1/m). With the
wave vectors rho of R and sigma = rho + K of S, beta = 2 pi n / lambda, z along R through the layer:

    c_R = rho_z / beta,   c_S = sigma_z / beta                        obliquities
    theta = (beta^2 - |sigma|^2) / (2 beta)                           dephasing
    kappa = pi n_1 / lambda + i alpha_1 / 2                           coupling
    c_R R' = -alpha R + i kappa S,   c_S S' = -(alpha - i theta) S + i kappa R

With a = alpha / c_R, b = (alpha - i theta) / c_S, m = (a + b) / 2, h = (b - a) / 2 and
g^2 = h^2 - kappa^2 / (c_R c_S) the matrix of the layer is
``e^{-m d} [cosh(g d) + (sinh(g d) / g) ((h, i kappa / c_R), (i kappa / c_S, -h))]``. One form so
serves all cases; cosh and sinh are divided by ``e^{Re(g) d}``, so nothing overflows.

Second derivatives and all other orders are left out: the grating has to be thick
(Klein and Cook's Q' well above 10) and weak (n_1 much below n).

References:
    Kogelnik (1969), Coupled wave theory for thick hologram gratings, Bell Syst. Tech. J. 48(9),
    2909-2947, doi:10.1002/j.1538-7305.1969.tb01198.x. His fields run as exp(+i omega t) and his
    sigma is rho - K. The waves: eqs. (21), (22); transmission without loss: eq. (43).
"""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray, as_float, dot

LEAST_OBLIQUITY = 1e-6
"""Waves nearer to the plane of the layer than this cosine are taken as having it."""

_FLAT = 1e-8
"""sinh(x) / x is 1 + x^2 / 6: closer to 0 than this it is 1 in double precision."""


def coupling(
    wavelength: ArrayLike, modulation: ArrayLike, absorption_modulation: ArrayLike = 0.0
) -> ComplexArray:
    """Return the coupling constant kappa of light with its electric field along the fringes.

    Args:
        wavelength: Vacuum wavelength, metres, shape ``(...)``.
        modulation: Amplitude n_1 of the index, broadcastable.
        absorption_modulation: Amplitude alpha_1 of the absorption of the amplitude, 1/m,
            broadcastable.

    Returns:
        kappa in 1/m, shape ``(...)``; of the other polarisation it is kappa times the cosine of
        the angle between rho and sigma, see `polarization_factor`.
    """
    real = np.pi * as_float(modulation) / as_float(wavelength)
    return np.asarray(real + 0.5j * as_float(absorption_modulation), dtype=np.complex128)


def dephasing(light: ArrayLike, grating: ArrayLike, wavenumber: ArrayLike) -> FloatArray:
    """Return theta, by closure of wave vectors.

    Args:
        light: Wave vector rho, of length beta, 1/m, shape ``(..., 3)``.
        grating: Grating vector, 2 pi over the period, times the order, 1/m, broadcastable.
        wavenumber: beta, 1/m, shape ``(...)``.

    Returns:
        ``(beta^2 - |rho + K|^2) / (2 beta)`` in 1/m, shape ``(...)``; 0 on Bragg.
    """
    rho, step = as_float(light), as_float(grating)
    # rho has the length beta: what is left has no large terms that cancel.
    return -dot(2.0 * rho + step, step) / (2.0 * as_float(wavenumber))


def polarization_factor(light: ArrayLike, diffracted: ArrayLike) -> FloatArray:
    """Return the scalar product of both polarisations in the plane of rho and K.

    Args:
        light: Wave vector rho, shape ``(..., 3)``.
        diffracted: Wave vector sigma, broadcastable.

    Returns:
        The cosine of the angle between them, shape ``(...)``.
    """
    rho, sigma = as_float(light), as_float(diffracted)
    lengths = np.sqrt(dot(rho, rho) * dot(sigma, sigma))
    return dot(rho, sigma) / np.where(lengths > 0.0, lengths, 1.0)


def amplitudes(
    cos_light: ArrayLike,
    cos_diffracted: ArrayLike,
    mismatch: ArrayLike,
    coupled: ArrayLike,
    absorption: ArrayLike,
    thickness: ArrayLike,
) -> tuple[ComplexArray, ComplexArray]:
    """Return the complex amplitudes of both waves where they leave the layer.

    Args:
        cos_light: c_R, above 0, shape ``(...)``.
        cos_diffracted: c_S, above 0 for a transmission grating, below 0 for a reflection grating.
        mismatch: Dephasing theta, 1/m.
        coupled: Coupling kappa, 1/m, complex.
        absorption: alpha of the amplitude, 1/m, at least 0.
        thickness: d, metres, at least 0. All arguments broadcast.

    Returns:
        R at the far face, and S at the far face (transmission) or at the near one (reflection),
        for R = 1 at the near face; without the phases of their carriers rho and sigma.
    """
    c_r = np.maximum(as_float(cos_light), LEAST_OBLIQUITY)
    c_s = _away_from_zero(as_float(cos_diffracted))
    kappa, depth = np.asarray(coupled, dtype=np.complex128), as_float(thickness)
    loss = as_float(absorption)
    a, b = loss / c_r, (loss - 1j * as_float(mismatch)) / c_s
    mean, half = 0.5 * (a + b) * depth, 0.5 * (b - a) * depth
    # Real quotients first: nothing leaves the range of doubles where c_S is small.
    squared = half * half - (kappa * depth) * (kappa * depth / (c_r * c_s))
    root: ComplexArray = np.asarray(np.sqrt(squared), dtype=np.complex128)
    cosine, sine = _scaled_hyperbolic(root)
    into = 1j * kappa * depth / c_s
    backward = c_s < 0.0
    forward = np.exp(np.where(backward, 0.0, root.real - mean))
    through, diffracted = forward * (cosine + half * sine), forward * into * sine
    # Of a reflection grating the far face sends no S back.
    divisor = np.where(backward, cosine - half * sine, 1.0)
    passed = np.exp(-mean - root.real) / divisor
    returned = -into * sine / divisor
    return np.where(backward, passed, through), np.where(backward, returned, diffracted)


def efficiencies(
    cos_light: ArrayLike,
    cos_diffracted: ArrayLike,
    mismatch: ArrayLike,
    coupled: ArrayLike,
    absorption: ArrayLike,
    thickness: ArrayLike,
) -> tuple[FloatArray, FloatArray]:
    """Return the shares of the power in both waves; the arguments are those of `amplitudes`.

    Args:
        cos_light: c_R, above 0, shape ``(...)``.
        cos_diffracted: c_S, above 0 for a transmission grating, below 0 for a reflection grating.
        mismatch: Dephasing theta, 1/m.
        coupled: Coupling kappa, 1/m, complex.
        absorption: alpha of the amplitude, 1/m, at least 0.
        thickness: d, metres, at least 0.

    Returns:
        Shares of the diffracted wave and of order 0, shape ``(...)``; without loss their sum is 1.
    """
    through, diffracted = amplitudes(
        cos_light, cos_diffracted, mismatch, coupled, absorption, thickness
    )
    c_r = np.maximum(as_float(cos_light), LEAST_OBLIQUITY)
    slant = np.abs(_away_from_zero(as_float(cos_diffracted))) / c_r
    return slant * np.abs(diffracted) ** 2, np.abs(through) ** 2


def _away_from_zero(cosine: FloatArray) -> FloatArray:
    size = np.maximum(np.abs(cosine), LEAST_OBLIQUITY)
    return np.where(cosine < 0.0, -size, size)


def _scaled_hyperbolic(root: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return cosh(x) and sinh(x) / x, both over exp(Re x), for Re x >= 0."""
    fallen = np.exp(-2.0 * root.real)
    cos, sin = np.cos(root.imag), np.sin(root.imag)
    grown, left = 0.5 * (1.0 + fallen), -0.5 * np.expm1(-2.0 * root.real)
    cosine = grown * cos + 1j * left * sin
    flat = np.abs(root) < _FLAT
    with np.errstate(invalid="ignore"):
        sine = (left * cos + 1j * grown * sin) / np.where(flat, 1.0, root)
    return cosine, np.where(flat, 1.0, sine)
