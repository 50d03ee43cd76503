# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Matrices of a layer's permittivity on the Fourier harmonics of x.

Two factorisation rules are needed: where a jumping permittivity meets a field that is smooth, the
product's coefficients are those of the truncated convolution (Laurent's rule); where the product is
smooth though both factors jump, as for the component across the walls, the convolution matrix of
the reciprocal permittivity is inverted instead (inverse rule).

References:
    Li (1996), Use of Fourier series in the analysis of discontinuous periodic structures,
    J. Opt. Soc. Am. A 13, 1870, doi:10.1364/JOSAA.13.001870.
"""

from functools import cached_property

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..errors import SpecError
from .stack import Lamellar, Smooth

type Matrix = FloatArray | ComplexArray
"""Real where that is enough: the linear algebra then takes half the time."""

_EVEN = 1e-14
"""A coefficient whose imaginary part is below this is real: the pattern is even in x."""
_SINGULAR = 1e14
"""Condition from which on nothing is left of the digits of an inverse."""


class SingularError(SpecError):
    """Permittivities of both signs cancel in the mean, so that there are no modes."""


class Factors:
    """Matrices of one layer, real where the permittivity is real and even in x.

    Attributes:
        lossless: Whether every permittivity is real and above 0.
    """

    def __init__(
        self, pattern: Lamellar | Smooth, permittivity: ComplexArray, harmonics: int
    ) -> None:
        """Take the Fourier coefficients.

        Args:
            pattern: The layer, without its shift.
            permittivity: Of all materials, shape ``(B, M)``.
            harmonics: Number n of harmonics.
        """
        own = permittivity[:, list(pattern.materials)]
        shares = pattern.coefficients(harmonics - 1)
        even = bool(np.all(np.abs(shares.imag) < _EVEN))
        real = bool(np.all(own.imag == 0.0))
        self._basis = shares.real if even else shares
        self._values = own.real if real else own
        self._jumps = isinstance(pattern, Lamellar)
        self._count = harmonics
        if self._jumps:
            self.lossless = real and bool(np.all(own.real > 0.0))
        else:
            # The mean less the most that all other harmonics together can take away.
            mean = (own @ shares[:, harmonics - 1]).real
            others = np.abs(shares).sum(axis=1) - np.abs(shares[:, harmonics - 1])
            self.lossless = real and bool(np.all(mean > np.abs(own) @ others))

    @cached_property
    def direct(self) -> Matrix:
        """Matrix [[eps]] of Laurent's rule, shape ``(B, n, n)``."""
        return _toeplitz(self._values @ self._basis, self._count)

    @cached_property
    def direct_inverse(self) -> Matrix:
        """Inverse of `direct`.

        Raises:
            SingularError: If there is none.
        """
        try:
            inverse = np.linalg.inv(self.direct)
        except np.linalg.LinAlgError as error:
            raise SingularError(self._singular()) from error
        size = _row_sum(self.direct) * _row_sum(inverse)
        if self.lossless or np.all(size < _SINGULAR):
            return inverse
        raise SingularError(self._singular())

    def _singular(self) -> str:
        return (
            f"harmonics: the permittivities of a layer average to zero with {self._count} of them;"
            " harmonics or indices must be changed"
        )

    @cached_property
    def reciprocal(self) -> Matrix:
        """What takes D_x to E_x: [[1 / eps]], or `direct_inverse` where nothing jumps."""
        if not self._jumps:
            return self.direct_inverse
        return _toeplitz((1.0 / self._values) @ self._basis, self._count)


def _row_sum(matrices: Matrix) -> FloatArray:
    """Largest row sum of each matrix, a norm."""
    return np.abs(matrices).sum(axis=-1).max(axis=-1)


def _toeplitz(series: Matrix, count: int) -> Matrix:
    """Return the matrices T[i, j] = c[i - j] of series with m = -(n - 1) .. n - 1."""
    index = np.arange(count)
    return series[..., index[:, None] - index[None, :] + count - 1]
