# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Zernike polynomials."""

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..errors import SpecError
from .planar import PlanarPattern, check_finite, check_positive


@dataclass(frozen=True)
class ZernikeTerm:
    """One polynomial and how much of it there is.

    Attributes:
        n: Radial degree, at least 0.
        m: Azimuthal frequency, at most n in size, n - m even: ``R cos(m phi)`` where it is 0 or
            more, ``R sin(|m| phi)`` where it is negative.
        amplitude: Its factor, metres; R is 1 at rho = 1.
    """

    n: int
    m: int
    amplitude: float

    def __post_init__(self) -> None:
        """Check the fields."""
        if self.n < 0 or abs(self.m) > self.n or (self.n - self.m) % 2:
            raise SpecError(f"m: must be at most n in size, n - m even, got {self.n}, {self.m}")
        check_finite("amplitude", (self.amplitude,))


@dataclass(frozen=True, kw_only=True, eq=False)
class Zernike(PlanarPattern):
    """A sum of Zernike polynomials; beyond rho = 1 the same polynomials go on.

    Each is a Jacobi polynomial of rho^2 times a harmonic polynomial, the real or imaginary part
    of ``(u + i v)^m``: both are smooth at the origin and both are worked out by stable
    recurrences, so that high degrees keep their digits.

    Attributes:
        terms: The polynomials.
        radius: Radius where rho is 1, metres, above 0.

    References:
        Noll (1976), "Zernike polynomials and atmospheric turbulence", J. Opt. Soc. Am. 66(3),
        207-211, doi:10.1364/JOSA.66.000207; the Jacobi form: Born and Wolf, Principles of Optics,
        section 9.2 and appendix VII.
    """

    terms: tuple[ZernikeTerm, ...]
    radius: float

    def __post_init__(self) -> None:
        """Check the radius."""
        super().__post_init__()
        check_positive("radius", self.radius)

    def value(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return V; see `PlanarPattern`."""
        u, v = x / self.radius, y / self.radius
        total = np.zeros(np.broadcast_shapes(u.shape, v.shape))
        for m, series in self.series().items():
            radial, _ = _jacobi_sum(abs(m), series, 2.0 * (u * u + v * v) - 1.0)
            harmonic, _, _ = _harmonic(m, u, v)
            total = total + radial * harmonic
        return total

    def slopes(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return its derivatives; see `PlanarPattern`."""
        u, v = x / self.radius, y / self.radius
        along_x = np.zeros(np.broadcast_shapes(u.shape, v.shape))
        along_y = np.zeros_like(along_x)
        for m, series in self.series().items():
            radial, rise = _jacobi_sum(abs(m), series, 2.0 * (u * u + v * v) - 1.0)
            harmonic, harmonic_u, harmonic_v = _harmonic(m, u, v)
            # The argument is 2 rho^2 - 1, whose derivative along u is 4 u.
            along_x = along_x + radial * harmonic_u + 4.0 * u * rise * harmonic
            along_y = along_y + radial * harmonic_v + 4.0 * v * rise * harmonic
        return along_x / self.radius, along_y / self.radius

    def series(self) -> dict[int, list[float]]:
        """Return the amplitudes sorted by azimuthal frequency.

        Returns:
            By m: the factors of the Jacobi polynomials of degree 0, 1, ..., metres.
        """
        found: dict[int, list[float]] = {}
        for term in self.terms:
            degree = (term.n - abs(term.m)) // 2
            row = found.setdefault(term.m, [])
            row.extend([0.0] * (degree + 1 - len(row)))
            row[degree] += term.amplitude
        return dict(sorted(found.items()))


def jacobi_step(m: int, degree: int) -> tuple[float, float, float]:
    """Return the recurrence of the Jacobi polynomials ``P_k^(0, m)``.

    Args:
        m: Their second parameter, at least 0.
        degree: k, at least 1.

    Returns:
        (a, b, c) of ``P_k(s) = (a s + b) P_{k-1}(s) - c P_{k-2}(s)``; c is 0 for k = 1.

    References:
        Abramowitz and Stegun, 22.7.1, with alpha = 0.
    """
    if degree == 1:
        return (m + 2) / 2.0, -m / 2.0, 0.0
    twice = 2 * degree + m
    below = 2 * degree * (degree + m) * (twice - 2)
    return (
        (twice - 1) * twice * (twice - 2) / below,
        -(twice - 1) * m * m / below,
        2 * (degree - 1) * (degree + m - 1) * twice / below,
    )


def _jacobi_sum(m: int, series: list[float], s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return sum of c_k P_k^(0, m)(s), and its derivative by s."""
    before, here = np.zeros_like(s), np.ones_like(s)
    rise_before, rise = np.zeros_like(s), np.zeros_like(s)
    total, total_rise = series[0] * here, np.zeros_like(s)
    for degree, amplitude in enumerate(series[1:], start=1):
        a, b, c = jacobi_step(m, degree)
        rise_before, rise = rise, a * here + (a * s + b) * rise - c * rise_before
        before, here = here, (a * s + b) * here - c * before
        total, total_rise = total + amplitude * here, total_rise + amplitude * rise
    return total, total_rise


def _harmonic(m: int, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return Re (u + i v)^m, or Im (u + i v)^|m| for negative m, and its derivatives."""
    if m == 0:
        shape = np.broadcast_shapes(u.shape, v.shape)
        return np.ones(shape), np.zeros(shape), np.zeros(shape)
    power = abs(m)
    below = (u + 1j * v) ** (power - 1)
    whole = below * (u + 1j * v)
    if m > 0:
        return whole.real, power * below.real, -power * below.imag
    return whole.imag, power * below.imag, power * below.real


def noll(j: int) -> tuple[int, int, float]:
    """Return the polynomial of an index in Noll's order.

    Args:
        j: The index, at least 1.

    Returns:
        n, m (negative for a sine, the odd indices), and the factor that makes its rms over the
        unit disk 1.

    References:
        Noll (1976), doi:10.1364/JOSA.66.000207, table I.
    """
    n = (math.isqrt(8 * j - 7) - 1) // 2
    place = j - n * (n + 1) // 2 - 1
    m = 2 * ((place + 1) // 2) if n % 2 == 0 else 2 * (place // 2) + 1
    if m == 0:
        return n, 0, math.sqrt(n + 1.0)
    return n, (m if j % 2 == 0 else -m), math.sqrt(2.0 * (n + 1.0))


FRINGE_TERMS = 37


def fringe(j: int) -> tuple[int, int, float]:
    """Return the polynomial of an index in the fringe order of the University of Arizona.

    Args:
        j: The index, 1 to 37. Index 37 is the twelfth power of the radius, out of its turn, as in
            the program FRINGE.

    Returns:
        n, m (negative for a sine), and the factor 1: each polynomial is 1 at its largest.

    References:
        Wyant and Creath (1992), "Basic wavefront aberration theory for optical metrology", in
        Applied Optics and Optical Engineering XI, chapter 1.
    """
    if j == FRINGE_TERMS:
        return 12, 0, 1.0
    row = math.isqrt(j - 1)
    place = j - row * row - 1
    m = row - place // 2
    return 2 * row - m, (m if place % 2 == 0 else -m), 1.0
