# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Coupled waves with 50 digits, as Maxwell's equations say it: no modes, no scattering matrices.

The fields (E_x, E_y, H_x, H_y) of all harmonics run through a layer by the exponential of one
matrix. With k0 = 1, time as exp(-i t), alpha and beta the wave numbers along x and y, and
A = [[1 / eps]]^-1 (the inverse rule, E_x being the field across the walls):

    E_x' = i (H_y + alpha E_z)       H_x' = i (alpha H_z - [[eps]] E_y)
    E_y' = i (beta E_z - H_x)        H_y' = i (beta H_z + A E_x)
    E_z = [[eps]]^-1 (beta H_x - alpha H_y)      H_z = alpha E_y - beta E_x
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mpmath import mp, mpc, mpf
from numpy.typing import NDArray


@dataclass(frozen=True)
class Slab:
    """A layer: permittivities from each wall to the next, and the thickness in wavelengths."""

    thickness: float
    permittivity: tuple[complex, ...]
    walls: tuple[float, ...] = (0.0,)


@dataclass(frozen=True)
class Lit:
    """Light from the half space behind: x and y components of n s, and wavelength over period."""

    along: float
    across: float
    step: float
    back: complex
    front: complex


def shares(light: Lit, slabs: Sequence[Slab], highest: int) -> NDArray[np.float64]:
    """Return the power of each order over that of the light.

    Args:
        light: The light.
        slabs: From the back to the front.
        highest: Highest order that is kept.

    Returns:
        Shares, shape ``(2, 2 highest + 1, 2)``: reflected and transmitted, order, polarisation of
        the light (s, then p).
    """
    orders = range(-highest, highest + 1)
    waves = [(mpf(light.along) + m * mpf(light.step), mpf(light.across)) for m in orders]
    through = mp.eye(4 * len(waves))
    for slab in slabs:
        through = _layer(slab, waves) * through
    returned = [_wave(light.back, *at, -1, kind) for kind in "sp" for at in waves]
    passed = [_wave(light.front, *at, 1, kind) for kind in "sp" for at in waves]
    count = len(waves)
    left = mp.matrix(4 * count, 4 * count)
    for column in range(2 * count):
        went = through * _spread(returned[column], column % count, count)
        stays = _spread(passed[column], column % count, count)
        for row in range(4 * count):
            left[row, column], left[row, 2 * count + column] = -went[row], stays[row]
    found = np.zeros((2, count, 2))
    for place, kind in enumerate("sp"):
        lit = _wave(light.back, *waves[highest], 1, kind)
        answer = mp.lu_solve(left, through * _spread(lit, highest, count))
        for side, basis in enumerate((returned, passed)):
            for order in range(count):
                parts = [
                    [answer[2 * count * side + at] * x for x in basis[at]]
                    for at in (order, count + order)
                ]
                total = [first + second for first, second in zip(*parts, strict=True)]
                found[side, order, place] = abs(float(_flux(total) / _flux(lit)))
    return found


def _layer(slab: Slab, waves: Sequence[tuple[mpf, mpf]]) -> mp.matrix:
    """Matrix that takes the fields through a layer."""
    count = len(waves)
    direct, across = _toeplitz(slab, count), _toeplitz(slab, count, reciprocal=True) ** -1
    inverse, alpha, beta = direct**-1, mp.diag([a for a, _ in waves]), waves[0][1]
    one = mp.eye(count)
    blocks = {
        (0, 2): beta * alpha * inverse,
        (0, 3): one - alpha * inverse * alpha,
        (1, 2): beta * beta * inverse - one,
        (1, 3): -beta * inverse * alpha,
        (2, 0): -beta * alpha,
        (2, 1): alpha * alpha - direct,
        (3, 0): across - beta * beta * one,
        (3, 1): beta * alpha,
    }
    matrix = mp.matrix(4 * count, 4 * count)
    for (down, right), block in blocks.items():
        for i in range(count):
            for j in range(count):
                matrix[down * count + i, right * count + j] = 1j * block[i, j]
    return mp.expm(matrix * (2 * mp.pi * mpf(slab.thickness)))


def _toeplitz(slab: Slab, count: int, *, reciprocal: bool = False) -> mp.matrix:
    """Matrix of the Fourier coefficients of the permittivity, or of 1 over it."""
    ends = [*slab.walls[1:], slab.walls[0] + 1.0]

    def coefficient(m: int) -> mpc:
        total = mpc(0)
        for value, begin, end in zip(slab.permittivity, slab.walls, ends, strict=True):
            width = mpf(end) - mpf(begin)
            wave = width if m == 0 else mp.sinpi(m * width) / (mp.pi * m)
            part = wave * mp.expjpi(-m * (mpf(begin) + mpf(end)))
            total += part / mpc(value) if reciprocal else part * mpc(value)
        return total

    known = {m: coefficient(m) for m in range(1 - count, count)}
    return mp.matrix([[known[i - j] for j in range(count)] for i in range(count)])


def _wave(permittivity: complex, alpha: mpf, beta: mpf, way: int, kind: str) -> list[mpc]:
    """(E_x, E_y, H_x, H_y) of a plane wave that runs up (1) or down (-1)."""
    eps = mpc(permittivity)
    gamma = mp.sqrt(eps - alpha**2 - beta**2)
    gamma = way * (-gamma if gamma.imag < 0 else gamma)
    size = mp.sqrt(alpha**2 + beta**2)
    x, y = (-beta / size, alpha / size) if size else (mpf(0), mpf(1))
    # k x (x, y, 0), and the other one from E = -k x H / eps.
    if kind == "s":
        return [x, y, -gamma * y, gamma * x]
    return [gamma * y / eps, -gamma * x / eps, x, y]


def _flux(fields: Sequence[mpc]) -> mpf:
    ex, ey, hx, hy = fields
    return mp.re(ex * mp.conj(hy) - ey * mp.conj(hx))


def _spread(fields: Sequence[mpc], order: int, count: int) -> mp.matrix:
    column = mp.matrix(4 * count, 1)
    for component in range(4):
        column[component * count + order] = fields[component]
    return column
