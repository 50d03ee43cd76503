# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scattering matrices of layers on power waves, and how they join.

At every plane the tangential fields u = (E_x, E_y) and v = (H_y, -H_x) of each harmonic are
written as the waves

    down = (y^1/2 u - y^-1/2 v) / 2,    up = (y^1/2 u + y^-1/2 v) / 2

with a real reference admittance y > 0 for each harmonic and component. The flux along +z is then
|up|^2 - |down|^2 for evanescent harmonics as well, so the scattering matrix of a lossless layer is
unitary and that of an absorbing one never above 1: nothing can grow with the thickness.

A layer is the same seen from both sides. Its parts with even and with odd electric field have
reflections R_e and R_o at a face, and S11 = S22 = (R_e + R_o) / 2, S12 = S21 = (R_e - R_o) / 2.
Both need cos(gamma d / 2), gamma sin(gamma d / 2) and sin(gamma d / 2) / gamma only, which are even
in gamma: there is no branch of a square root to choose, and a mode at its cut-off is no exception.

References:
    Li (1996), Formulation and comparison of two recursive matrix algorithms for modeling layered
    diffraction gratings, J. Opt. Soc. Am. A 13, 1024, doi:10.1364/JOSAA.13.001024.
    Kurokawa (1965), Power waves and the scattering matrix, IEEE Trans. Microw. Theory Tech. 13,
    194, doi:10.1109/TMTT.1965.1125964.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..arrays import ComplexArray, FloatArray
from .modes import LseModes, LsmModes

_FLOOR = 0.1
"""Least |eps - alpha^2| of a reference admittance, so that none is 0 or infinite."""


class Channel(Enum):
    """The fields that are solved for together."""

    ALONG = "E_y only: without a wave number along the grooves the LSE modes stand alone"
    ACROSS = "E_x only: and so do the LSM modes"
    BOTH = "conical mount; harmonics of E_x first, then those of E_y"


@dataclass(frozen=True, eq=False)
class Reference:
    """Roots of the reference admittances of the components.

    Attributes:
        across: For E_x, shape ``(B, n)``.
        along: For E_y, shape ``(B, n)``.
    """

    across: FloatArray
    along: FloatArray

    @classmethod
    def of(cls, alpha: FloatArray, back: ComplexArray, front: ComplexArray) -> "Reference":
        """Choose admittances close to those of the half spaces.

        Args:
            alpha: Wave numbers along x, shape ``(B, n)``.
            back: Permittivity of one half space, shape ``(B,)``.
            front: Permittivity of the other.
        """
        mean = (0.5 * (np.abs(back) + np.abs(front)))[:, None]
        wave = np.sqrt(np.maximum(np.abs(mean - alpha**2), _FLOOR))
        return cls(np.sqrt(mean / wave), np.sqrt(wave))

    def root(self, channel: Channel) -> FloatArray:
        """Roots for all fields of a channel, shape ``(B, n)`` or ``(B, 2 n)``."""
        if channel is Channel.ALONG:
            return self.along
        if channel is Channel.ACROSS:
            return self.across
        return np.concatenate((self.across, self.along), axis=1)


@dataclass(frozen=True, eq=False)
class Scatter:
    """Scattering matrix of a part of the stack, blocks of shape ``(B, K, K)``.

    Attributes:
        top: Down at the top face to up at the top face.
        down: Down at the top face to down at the bottom face.
        bottom: Up at the bottom face to down at the bottom face.
        up: Up at the bottom face to up at the top face.
        harmonics: Number n of harmonics; K is n, or 2 n in conical mount.
    """

    top: ComplexArray
    down: ComplexArray
    bottom: ComplexArray
    up: ComplexArray
    harmonics: int

    def moved(self, shift: float) -> "Scatter":
        """The same part moved toward +x by a share of the period."""
        if shift == 0.0:
            return self
        size = self.top.shape[1]
        turn = np.exp(-2j * np.pi * shift * _harmonic(size, self.harmonics))
        both = turn[:, None] * turn.conj()[None, :]
        top, down = self.top * both, self.down * both
        if self.bottom is self.top:
            return Scatter(top, down, top, down, self.harmonics)
        return Scatter(top, down, self.bottom * both, self.up * both, self.harmonics)


def _harmonic(size: int, harmonics: int) -> FloatArray:
    return (np.arange(size) % harmonics).astype(np.float64)


def layer_scatter(
    lse: LseModes | None,
    lsm: LsmModes | None,
    depth: FloatArray,
    beta: FloatArray,
    reference: Reference,
) -> Scatter:
    """Return the scattering matrix of one layer, for the fields that its modes are given for.

    Args:
        lse: Modes without E_x, for the channels ALONG and BOTH.
        lsm: Modes without H_x, for the channels ACROSS and BOTH.
        depth: Thickness times k0, shape ``(B,)``.
        beta: Wave number along y over k0, shape ``(B,)``; read in conical mount only.
        reference: Reference admittances.

    Returns:
        The matrix.

    Raises:
        ValueError: If no modes are given.
    """
    if lse is not None and lsm is not None:
        return _symmetric(*_both(lse, lsm, depth, beta), reference, Channel.BOTH)
    if lsm is not None:
        return _symmetric(*_across(lsm, depth), reference, Channel.ACROSS)
    if lse is None:
        raise ValueError("no modes")
    return _symmetric(*_along(lse, depth), reference, Channel.ALONG)


def uniform_scatter(
    permittivity: ComplexArray,
    alpha: FloatArray,
    depth: FloatArray,
    beta: FloatArray,
    reference: Reference,
) -> Scatter:
    """Return the scattering matrix of a layer of one material in conical mount.

    With M = ((eps - beta^2, alpha beta), (alpha beta, eps - alpha^2)), v' = i M u and
    u' = i adj(M) v / eps: any electric field of one harmonic is a mode.

    Args:
        permittivity: Shape ``(B,)``, not 0.
        alpha: Wave numbers along x over k0, shape ``(B, n)``.
        depth: Thickness times k0, shape ``(B,)``.
        beta: Wave number along y over k0, shape ``(B,)``.
        reference: Reference admittances.

    Returns:
        The matrix, channel BOTH.
    """
    value, slope = permittivity[:, None], beta[:, None]
    along, mixed, across = value - alpha**2, alpha * slope, value - slope**2
    cosine, short, _ = _waves(along, beta, depth)

    def blocks(xx: ComplexArray, xy: ComplexArray, yy: ComplexArray) -> ComplexArray:
        on, off, last = (part[:, :, None] * np.eye(part.shape[1]) for part in (xx, xy, yy))
        return np.block([[on, off], [off, last]])

    c, s = cosine[:, 0], 1j * short[:, 0]
    same, q = blocks(c, 0.0 * c, c), s / value
    even = same, blocks(across * s, mixed * s, along * s)
    odd = blocks(along * q, -mixed * q, across * q), same
    return _symmetric(even, odd, reference, Channel.BOTH)


type _Fields = tuple[ComplexArray, ComplexArray]


def _symmetric(even: _Fields, odd: _Fields, reference: Reference, channel: Channel) -> Scatter:
    """Join the parts with even and with odd electric field."""
    root = reference.root(channel)[:, :, None]
    first = _reflection(even[0] * root, even[1] / root)
    second = _reflection(odd[0] * root, odd[1] / root)
    back, through = 0.5 * (first + second), 0.5 * (first - second)
    return Scatter(back, through, back, through, reference.along.shape[1])


def _reflection(u: ComplexArray, v: ComplexArray) -> ComplexArray:
    """Return (u + v) (u - v)^-1, with columns brought to one size first."""
    into = u - v
    scale = 1.0 / np.max(np.abs(into), axis=1, keepdims=True)
    turned = np.linalg.solve(
        np.swapaxes(into * scale, -1, -2), np.swapaxes((u + v) * scale, -1, -2)
    )
    return np.swapaxes(turned, -1, -2)


def _waves(
    mu: FloatArray | ComplexArray, beta: FloatArray, depth: FloatArray
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return cos, sin / gamma and gamma sin of gamma d / 2, all times exp(i gamma d / 2).

    The factor keeps evanescent modes of any depth finite; it is one per column and drops out.
    """
    root: ComplexArray = np.sqrt(mu - beta[:, None] ** 2 + 0j)
    gamma: ComplexArray = np.where(root.imag < 0.0, -root, root)
    turn = 1j * gamma * depth[:, None]
    change: ComplexArray = np.expm1(turn)
    small = np.abs(turn) < 1e-12
    ratio: ComplexArray = np.where(small, 1.0, change / np.where(small, 1.0, turn))
    cosine, sine = 1.0 + 0.5 * change, 0.5 * depth[:, None] * ratio
    return cosine[:, None, :], sine[:, None, :], (gamma**2)[:, None, :] * sine[:, None, :]


def _along(modes: LseModes, depth: FloatArray) -> tuple[_Fields, _Fields]:
    cosine, short, long = _waves(modes.mu, np.zeros_like(depth), depth)
    field = modes.field
    return (field * cosine, 1j * field * long), (1j * field * short, field * cosine)


def _across(modes: LsmModes, depth: FloatArray) -> tuple[_Fields, _Fields]:
    cosine, short, long = _waves(modes.mu, np.zeros_like(depth), depth)
    u, v = modes.across, modes.field
    return (u * cosine, 1j * v * short), (1j * u * long, v * cosine)


def _both(
    lse: LseModes, lsm: LsmModes, depth: FloatArray, beta: FloatArray
) -> tuple[_Fields, _Fields]:
    slope, none = beta[:, None, None], np.zeros_like(lse.field)
    u1 = np.concatenate((none, lse.field), axis=1)
    v1 = np.concatenate((slope * lse.turned, lse.mu[:, None, :] * lse.field), axis=1)
    u2 = np.concatenate((lsm.mu[:, None, :] * lsm.across, -slope * lsm.along), axis=1)
    v2 = np.concatenate((lsm.field, none), axis=1)
    cosine1, short1, long1 = _waves(lse.mu, beta, depth)
    cosine2, short2, long2 = _waves(lsm.mu, beta, depth)
    even = (
        np.concatenate((u1 * cosine1, u2 * cosine2), axis=2),
        1j * np.concatenate((v1 * short1, v2 * long2), axis=2),
    )
    odd = (
        1j * np.concatenate((u1 * long1, u2 * short2), axis=2),
        np.concatenate((v1 * cosine1, v2 * cosine2), axis=2),
    )
    return even, odd


def star(upper: Scatter, lower: Scatter) -> Scatter:
    """Join two parts, the first above the second.

    Args:
        upper: The part that light from the top meets first.
        lower: The part below it.

    Returns:
        The scattering matrix of both.
    """
    size = upper.top.shape[1]
    loop = np.eye(size) - upper.bottom @ lower.top
    right = np.concatenate((upper.down, upper.bottom @ lower.up), axis=2)
    inside = np.linalg.solve(loop, right)
    from_top, from_bottom = inside[:, :, :size], inside[:, :, size:]
    return Scatter(
        upper.top + upper.up @ (lower.top @ from_top),
        lower.down @ from_top,
        lower.bottom + lower.down @ from_bottom,
        upper.up @ (lower.up + lower.top @ from_bottom),
        upper.harmonics,
    )


def repeated(part: Scatter, count: int, step: float) -> Scatter:
    """Join copies of one part, each moved along x against the one above it, by doubling.

    Args:
        part: The topmost copy.
        count: Number of copies, at least 1.
        step: How far each copy is moved toward +x against the one above, in periods.

    Returns:
        The scattering matrix of all.
    """
    result = part
    # The digits of the count after its first, from the highest: double, then add one where 1.
    done = 1
    for digit in bin(count)[3:]:
        result = star(result, result.moved(step * done))
        done *= 2
        if digit == "1":
            result = star(result, part.moved(step * done))
            done += 1
    return result
