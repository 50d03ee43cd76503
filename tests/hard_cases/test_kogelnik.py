# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two coupled waves at their extremes: numpy and Cycles against 50 digits of the equations."""

from collections.abc import Iterable
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf
from numpy.typing import NDArray

from hoe_addon.core.efficiency import kogelnik
from tests.hard_cases.osl_values import float32, values_of

DIGITS = 50

OSL_HEADERS = ("hoe_constants.h", "hoe_math.h", "hoe_volume.h")

FEW, FEW_OSL = 4e-15, 1e-6
"""Some ten roundings of shares of about 1: 2e-16 and 1e-7 each."""

ROUNDING, ROUNDING_OSL = 2e-16, 1e-7
"""Of a phase, relative, in double precision and in float32: sqrt(nu^2 + xi^2) rad of it are
rounded, and a share follows the phase by (nu / phase)^2 at most."""

LEAST = 1e-6
"""Cosines below this count as this."""

type Row = tuple[float, float, float, float, float, float]
"""cos of the light, cos of the wave (below 0: reflection), theta d, kappa d (real, imaginary) and
alpha d; each a float32."""


def solved(row: Row) -> tuple[mpf, mpf]:
    """Shares of the wave and of order 0, from the exponential of the equations' matrix.

    c_R R' = -alpha R + i kappa S and c_S S' = -(alpha - i theta) S + i kappa R over the thickness
    1, with R = 1 at the near face and S = 0 at the face that S comes from.
    """
    c_r, c_s, phase, real, imag, loss = map(mpf, row)
    kappa = mpc(real, imag)
    matrix = mp.matrix(
        [[-loss / c_r, 1j * kappa / c_r], [1j * kappa / c_s, -(loss - 1j * phase) / c_s]]
    )
    layer = mp.expm(matrix)
    if c_s > 0:
        through, wave = layer[0, 0], layer[1, 0]
    else:
        wave = -layer[1, 0] / layer[1, 1]
        through = mp.exp(matrix[0, 0] + matrix[1, 1]) / layer[1, 1]
    return abs(c_s) / c_r * abs(wave) ** 2, abs(through) ** 2


STEEP = ((0.8, 0.6), (0.7, -0.9))
UPRIGHT = ((1.0, 1.0), (1.0, -1.0), (0.7, -0.9))


def rows_of(
    nus: Iterable[float],
    xis: Iterable[float],
    cosines: Iterable[tuple[float, float]] = STEEP,
    losses: Iterable[float] = (0.0,),
    shares: Iterable[float] = (0.0,),
) -> list[Row]:
    """Rows by Kogelnik's nu (coupling), xi (dephasing), alpha d and alpha_1 over alpha."""
    rows: list[Row] = []
    for nu, xi, (c_r, c_s), loss, share in product(nus, xis, cosines, losses, shares):
        kappa = nu * np.sqrt(c_r * abs(c_s))
        numbers = (c_r, c_s, 2.0 * c_s * xi, kappa, 0.5 * share * loss, loss)
        rows.append(tuple(float32(numbers).tolist()))
    return rows


def band_edge() -> list[Row]:
    """sqrt(xi^2 - nu^2) at 0, and close to it on both sides."""
    nus = (1e-3, 1.0, 10.0, 100.0)
    steps = (0.0, *(sign * 10.0**-k for sign in (1, -1) for k in (1, 2, 4, 7)))
    return [
        row
        for nu in nus
        for xi in (nu, -nu)
        for step in steps
        for row in rows_of((nu,), (xi * (1.0 + step),), UPRIGHT)
    ]


GRAZING = (2e-6, 1e-5, 1e-3)
FAR = (1e2, 1e3, 8.1e3, 8.3e3, 1e4, 1e5, 1e6)

CASES = {
    "no coupling": rows_of((0.0,), (0.0, 1e-6, 1.0, *FAR), losses=(0.0, 1.0)),
    "far off Bragg": rows_of((1e-3, 0.1, 1.0, 10.0), FAR),
    "far off Bragg, overmodulated": rows_of((30.0, 100.0), FAR),
    "overmodulated": rows_of((10.0, 30.0, 80.0, 100.0), (0.0, 1e-3, 1.0, 30.0, 100.0, 101.0)),
    "nu and xi toward 0": rows_of((1e-6, 1e-4, 1e-2), (0.0, 1e-6, 1e-4, 1e-2), UPRIGHT),
    "edge of the band": band_edge(),
    "light along the layer": rows_of(
        (0.5, 1.0, 100.0), (0.0, 1.0, 10.0), product(GRAZING, (0.6, -0.9))
    ),
    "wave along the layer": rows_of(
        (0.5, 1.0, 100.0), (0.0, 1.0, 10.0), product((0.6, 1.0), (*GRAZING, -2e-6, -1e-3))
    ),
    "both along the layer": rows_of(
        (0.5, 1.0, 100.0), (0.0, 1.0, 10.0), product(GRAZING, (*GRAZING, -2e-6, -1e-3))
    ),
    "absorbing": rows_of(
        (0.1, 10.0, 100.0), (0.0, 1.0, 1e3), STEEP, (1e-4, 1.0, 100.0), (0.0, 0.5, 1.0)
    ),
    "modulated absorption": rows_of(
        (0.0,), (0.0, 1e-3, 1.0, 1e3), UPRIGHT, (1e-6, 1e-2, 1.0, 30.0), (0.5, 1.0)
    ),
    "absorbing, along the layer": rows_of(
        (0.1, 1.0),
        (0.0, 1.0, -1.0, 100.0),
        ((2e-6, 0.5), (1e-3, 0.5), (0.5, 2e-6), (0.5, 1e-3), (0.5, -1e-3), (0.5, -2e-6)),
        (1e-4, 0.1),
        (0.0, 1.0),
    ),
}


@cache
def expected(name: str) -> NDArray[np.float64]:
    """Shares of the wave and of order 0, shape ``(R, 2)``."""
    with mp.workdps(DIGITS + 20):
        return np.array([[float(share) for share in solved(row)] for row in CASES[name]])


def allowed(rows: list[Row], few: float, rounding: float) -> NDArray[np.float64]:
    c_r, c_s, phase, real, imag, _ = np.array(rows).T
    nu = np.hypot(real, imag) / np.sqrt(c_r * np.abs(c_s))
    xi = np.maximum(np.abs(0.5 * phase / c_s), 1e-30)
    return (few + rounding * nu * np.minimum(1.0, nu / xi))[:, None]


def by_numpy(rows: list[Row]) -> NDArray[np.float64]:
    c_r, c_s, phase, real, imag, loss = np.array(rows).T
    pair = kogelnik.efficiencies(c_r, c_s, phase, real + 1j * imag, loss, 1.0)
    return np.stack(pair, axis=1)


def by_cycles(scene: Any, rows: list[Row]) -> NDArray[np.float64]:
    text = """
float share_of(float a[], int which)
{
    float rest = 0.0;
    float wave = hoe_two_waves(a[0], a[1], a[2], a[3], a[4], a[5], rest);
    return which == 0 ? wave : rest;
}
"""
    both = [values_of(scene, f"share_of(a, {k})", rows, text, OSL_HEADERS) for k in (0, 1)]
    return np.stack(both, axis=1)


@pytest.mark.parametrize("name", CASES)
def test_numpy(name: str) -> None:
    rows = CASES[name]
    # Exponents alpha d / cos of the two waves are subtracted.
    fallen = np.array([row[5] / min(row[0], abs(row[1])) for row in rows])[:, None]
    error = np.abs(by_numpy(rows) - expected(name))
    assert np.all(error <= allowed(rows, FEW, ROUNDING) + ROUNDING * fallen)


@pytest.mark.render
@pytest.mark.parametrize("name", CASES)
def test_cycles(clean_scene: Any, name: str) -> None:
    rows = CASES[name]
    error = np.abs(by_cycles(clean_scene, rows) - expected(name))
    bound = allowed(rows, FEW_OSL, ROUNDING_OSL)
    worst = int(np.argmax(np.max(error / bound, axis=1)))
    assert np.all(error <= bound), (rows[worst], error[worst])


def beyond() -> list[Row]:
    """Light and waves nearer to the plane of the layer than float32 can use, and in it."""
    small = (0.0, 1e-30, 1e-12, 9e-7)
    cosines = [*product(small, (0.5, -0.5, *small)), *product((0.5,), small)]
    kappas, phases, losses = (0.0, 1e-3, 1.0, 100.0), (0.0, 1e-3, 1.0, 1e6), (0.0, 0.1)
    return [
        (c_r, c_s, phase, kappa, 0.0, loss)
        for (c_r, c_s), phase, kappa, loss in product(cosines, phases, kappas, losses)
    ]


def check_beyond(found: NDArray[np.float64], slack: float) -> None:
    total, loss = found.sum(axis=1), np.array([row[5] for row in beyond()])
    assert np.all(np.isfinite(found) & (found >= 0.0))
    assert np.all(total <= 1.0 + slack)
    assert np.all(total[loss == 0.0] >= 1.0 - slack)


def test_numpy_keeps_the_energy_in_the_plane_of_the_layer() -> None:
    check_beyond(by_numpy(beyond()), 1e-9)


@pytest.mark.render
def test_cycles_keeps_the_energy_in_the_plane_of_the_layer(clean_scene: Any) -> None:
    check_beyond(by_cycles(clean_scene, beyond()), FEW_OSL)
