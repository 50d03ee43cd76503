# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane waves of a half space beside the power waves of the stack."""

from dataclasses import dataclass

import numpy as np

from ..arrays import ComplexArray, FloatArray, IntArray
from .scattering import Channel, Reference

_LEAST = 1e-30
"""A grazing wave that lights the stack gets this wave number along z: the limit is reached."""


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """Orders in a half space; the arrays have the shape ``(B, n)`` unless said.

    Attributes:
        index: Refractive index, shape ``(B, 1)``.
        gamma: Wave number along z over k0; real where an order propagates.
        along: Unit vectors t in the tangent plane, shape ``(B, n, 2)``.
        gain: Components xx, xy and yy of (1 + Y)^-1, with Y the admittance over the reference.
        reference: Roots of the reference admittances, E_x then E_y, shape ``(B, n, 2)``.
        lit: Place of the order 0 among the n, in which light may come in, shape ``(B,)``.
    """

    index: ComplexArray
    gamma: ComplexArray
    along: FloatArray
    gain: tuple[ComplexArray, ComplexArray, ComplexArray]
    reference: FloatArray
    lit: IntArray

    @classmethod
    def of(
        cls,
        alpha: FloatArray,
        beta: FloatArray,
        permittivity: ComplexArray,
        reference: Reference,
        zero: IntArray,
        *,
        lit: bool,
    ) -> "HalfSpace":
        """Describe a half space.

        Args:
            alpha: Wave numbers along x over k0, shape ``(B, n)``.
            beta: Wave number along y over k0, shape ``(B,)``.
            permittivity: Shape ``(B,)``.
            reference: Reference admittances.
            zero: Place of the order 0 among the n, shape ``(B,)``.
            lit: Whether the light comes through this half space.
        """
        slope = np.broadcast_to(beta[:, None], alpha.shape)
        index: ComplexArray = np.sqrt(permittivity)[:, None]
        tangential = np.hypot(alpha, slope)
        root: ComplexArray = np.sqrt((index - tangential) * (index + tangential))
        gamma: ComplexArray = np.where(root.imag < 0.0, -root, root)
        if lit:
            rows = np.arange(len(zero))
            gamma[rows, zero] = np.maximum(gamma[rows, zero].real, _LEAST)
        straight = tangential == 0.0
        length = np.where(straight, 1.0, tangential)
        along = np.stack((np.where(straight, 1.0, alpha / length), slope / length), axis=-1)
        roots = np.stack((reference.across, reference.along), axis=-1)
        gain = _gain(gamma, alpha, slope, permittivity[:, None], roots)
        return cls(index, gamma, along, gain, roots, zero)

    @property
    def sideways(self) -> FloatArray:
        """Unit vectors s = z cross t, shape ``(B, n, 2)``."""
        return np.stack((-self.along[..., 1], self.along[..., 0]), axis=-1)

    def accept(self, waves: ComplexArray) -> ComplexArray:
        """Return (1 + Y)^-1 times vectors of shape ``(B, n, 2, ...)``."""
        extra = (...,) + (None,) * (waves.ndim - 3)
        xx, xy, yy = (part[extra] for part in self.gain)
        first, second = waves[:, :, 0], waves[:, :, 1]
        return np.stack((xx * first + xy * second, xy * first + yy * second), axis=2)

    def reflection(self, channel: Channel) -> ComplexArray:
        """Matrix (1 - Y) (1 + Y)^-1 on the fields of a channel, shape ``(B, K, K)``."""
        xx, xy, yy = self.gain
        one = np.eye(xx.shape[1])
        if channel is Channel.ALONG:
            return (2.0 * yy - 1.0)[:, :, None] * one
        if channel is Channel.ACROSS:
            return (2.0 * xx - 1.0)[:, :, None] * one
        mixed = 2.0 * xy[:, :, None] * one
        rows = (
            ((2.0 * xx - 1.0)[:, :, None] * one, mixed),
            (mixed, (2.0 * yy - 1.0)[:, :, None] * one),
        )
        return np.concatenate([np.concatenate(row, axis=2) for row in rows], axis=1)

    def incident(self) -> tuple[ComplexArray, ComplexArray]:
        """Fields u and Y u of the order 0, toward the stack, of unit amplitude.

        Returns:
            Both over the reference, shape ``(B, n, 2, 2)``: component, then polarisation.
        """
        at = (np.arange(len(self.lit)), self.lit)
        u = np.zeros((*self.along.shape, 2), dtype=np.complex128)
        v = np.zeros_like(u)
        gamma, index = self.gamma[at][:, None], self.index
        s, t, root = self.sideways[at], self.along[at], self.reference[at]
        u[*at, :, 0], v[*at, :, 0] = s * root, gamma * s / root
        u[*at, :, 1], v[*at, :, 1] = gamma / index * t * root, index * t / root
        return u, v

    def leaving(self, waves: ComplexArray) -> ComplexArray:
        """Amplitudes of s and p of fields that leave.

        Args:
            waves: (1 + Y) u over the reference, shape ``(B, n, 2, J)``.

        Returns:
            Amplitudes, shape ``(B, n, 2, J)``: polarisation of the order, then as given. That of
            p comes from the magnetic field, which is finite for an order at grazing.
        """
        u = self.accept(waves)
        v = (waves - u) * self.reference[..., None]
        u = u / self.reference[..., None]
        s = np.sum(u * self.sideways[..., None], axis=2)
        p = np.sum(v * self.along[..., None], axis=2) / self.index[:, :, None]
        return np.stack((s, p), axis=2)

    @property
    def supply(self) -> FloatArray:
        """Flux along z of light of unit amplitude in the order 0, shape ``(B,)``."""
        return self.gamma[np.arange(len(self.lit)), self.lit].real

    def power(self, amplitudes: ComplexArray) -> FloatArray:
        """Flux along z of amplitudes ``(B, n, 2, J)``, shape ``(B, n, J)``; 0 if evanescent."""
        across = self.gamma.real[:, :, None] * np.abs(amplitudes[:, :, 0]) ** 2
        weight = (np.conj(self.gamma / self.index) * self.index).real
        return across + weight[:, :, None] * np.abs(amplitudes[:, :, 1]) ** 2


def _gain(
    gamma: ComplexArray,
    alpha: FloatArray,
    beta: FloatArray,
    permittivity: ComplexArray,
    roots: FloatArray,
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return (1 + Y)^-1, free of the pole that Y has where gamma is 0.

    With M = gamma Y, adj its adjugate and det M = gamma^2 eps / (y_x y_y), the inverse is
    (gamma + adj M) / (gamma (1 + eps / (y_x y_y)) + tr M).
    """
    first, second = roots[..., 0], roots[..., 1]
    xx = (permittivity - beta**2) / first**2
    xy = alpha * beta / (first * second)
    # gamma^2 + beta^2 in place of eps - alpha^2: an order close to grazing keeps its digits.
    yy = (gamma**2 + beta**2) / second**2
    whole = gamma * (1.0 + permittivity / (first * second) ** 2) + xx + yy
    return (gamma + yy) / whole, -xy / whole, (gamma + xx) / whole
