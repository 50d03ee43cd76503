# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigorous solutions beside the same physics worked out in another way, amplitudes included."""

import cmath
import math

import numpy as np
import pytest

from hoe_addon.core.rcwa import Layer, PlaneWaves, Stack, Uniform, solve, volume_layers

ROUNDING = 1e-11
"""Two ways to one number in double precision."""


@pytest.mark.parametrize("polarization", ["s", "p"])
@pytest.mark.parametrize("sine", [0.0, 0.4, 0.9])
def test_thin_films_are_those_of_the_transfer_matrix(polarization: str, sine: float) -> None:
    """Amplitudes of two films, one of them of metal, beside Abeles' matrices."""
    indices = [1.0, 2.1, 0.5 + 3.0j, 1.5]
    depths = [0.13, 0.02]
    stack = Stack([Layer(Uniform(3), depths[1]), Layer(Uniform(2), depths[0])])
    table = np.array([1.5, 1.0, 2.1, 0.5 + 3.0j]) ** 2
    azimuth = 0.7
    tangential = sine * math.cos(azimuth), sine * math.sin(azimuth)
    light = PlaneWaves.of(0.55, tangential, 0.9, table, from_front=True)
    found = solve(stack, light, 3)
    zero, place = found.place(0), "sp".index(polarization)
    r, t = abeles(indices, depths, sine, 0.55, polarization)
    assert found.reflected_jones[0, zero, place, place] == pytest.approx(r, abs=ROUNDING)
    assert found.transmitted_jones[0, zero, place, place] == pytest.approx(t, abs=ROUNDING)
    assert np.abs(found.reflected_jones[0, zero, 1 - place, place]) < ROUNDING


def abeles(
    indices: list[complex], depths: list[float], sine: float, wavelength: float, polarization: str
) -> tuple[complex, complex]:
    """Return r and t of films, light from the first medium; r_p with tangential fields along t."""
    normals = [cmath.sqrt(n**2 - sine**2) for n in indices]
    admittances = [
        q if polarization == "s" else n**2 / q for n, q in zip(indices, normals, strict=True)
    ]
    matrix = np.eye(2, dtype=np.complex128)
    for q, y, depth in zip(normals[1:-1], admittances[1:-1], depths, strict=True):
        phase = 2.0 * np.pi * q * depth / wavelength
        cosine, sin = cmath.cos(phase), cmath.sin(phase)
        matrix = matrix @ np.array([[cosine, -1j * sin / y], [-1j * y * sin, cosine]])
    b, c = matrix @ (1.0, admittances[-1])
    first = admittances[0]
    t = 2.0 * first / (first * b + c)
    if polarization == "p":
        # From tangential to whole electric fields.
        t *= indices[-1] / normals[-1] * normals[0] / indices[0]
    return (first * b - c) / (first * b + c), t


@pytest.mark.parametrize("across", [0.0, 0.4])
def test_slanted_volume_grating_is_that_of_the_differential_equation(across: float) -> None:
    """Slices that are moved copies, beside an integration of the coupled waves along z."""
    thickness, frequency_z, period, wavelength = 1.2, 1.1, 0.8, 0.6
    table = [2.25, 1.0, 2.4 + 0.02j, 0.3]
    light = PlaneWaves.of(wavelength, (0.3, across), period, table, from_front=True)
    layers = volume_layers(thickness, frequency_z, mean=2, wave=3)
    found = solve(Stack(layers), light, 7, about_zero=True)
    reflected, transmitted = integrated(light, thickness, frequency_z, 3)
    # What the layers of 1/512 fringe are off by for so strong a grating.
    np.testing.assert_allclose(found.reflected[0], reflected, atol=5e-6)
    np.testing.assert_allclose(found.transmitted[0], transmitted, atol=5e-6)


def integrated(
    light: PlaneWaves, thickness: float, frequency_z: float, highest: int
) -> tuple[np.ndarray, np.ndarray]:
    """Efficiencies by Runge-Kutta on (E_x, E_y, H_x, H_y) of all harmonics, from Maxwell."""
    back, front, mean, wave = light.permittivity[0]
    order = np.arange(-highest, highest + 1)
    count = len(order)
    alpha = np.diag(light.along[0] + order * light.step[0]).astype(np.complex128)
    beta, one, k0 = light.across[0], np.eye(count), 2.0 * np.pi / light.wavelength[0]

    def slope(z: float, fields: np.ndarray) -> np.ndarray:
        turn = np.exp(2j * np.pi * frequency_z * z)
        upper, lower = np.eye(count, k=-1) * turn, np.eye(count, k=1) / turn
        eps = mean * one + 0.5 * wave * (upper + lower)
        ex, ey, hx, hy = fields.reshape(4, count, -1)
        ez = -np.linalg.solve(eps, alpha @ hy - beta * hx)
        hz = alpha @ ey - beta * ex
        return k0 * np.concatenate(
            (
                1j * (hy + alpha @ ez),
                1j * (beta * ez - hx),
                1j * (alpha @ hz - eps @ ey),
                1j * (beta * hz + eps @ ex),
            )
        )

    fields, steps = np.eye(4 * count, dtype=np.complex128), 2000
    h = thickness / steps
    for index in range(steps):
        z = index * h
        a = slope(z, fields)
        b = slope(z + h / 2, fields + h / 2 * a)
        c = slope(z + h / 2, fields + h / 2 * b)
        d = slope(z + h, fields + h * c)
        fields = fields + h / 6 * (a + 2 * b + 2 * c + d)
    return joined(fields, np.diag(alpha).real, beta, (back, front))


def joined(
    transfer: np.ndarray, alpha: np.ndarray, beta: float, ends: tuple[complex, complex]
) -> tuple[np.ndarray, np.ndarray]:
    """Match the fields that a transfer matrix takes from the bottom to the top with plane waves."""
    count = len(alpha)
    down_back, _ = waves_of(alpha, beta, ends[0], -1.0)
    up, gamma_up = waves_of(alpha, beta, ends[1], 1.0)
    down, _ = waves_of(alpha, beta, ends[1], -1.0)
    middle = [count // 2, count + count // 2]
    system = np.concatenate((transfer @ down_back, -up), axis=1)
    answer = np.linalg.solve(system, down[:, middle])
    _, gamma_down = waves_of(alpha, beta, ends[0], -1.0)
    lit = gamma_up[count // 2].real
    sides = [(answer[2 * count :], gamma_up), (answer[: 2 * count], gamma_down)]
    reflected, transmitted = (
        gamma.real[:, None] / lit * (np.abs(a[:count]) ** 2 + np.abs(a[count:]) ** 2)
        for a, gamma in sides
    )
    return reflected, transmitted


def waves_of(
    alpha: np.ndarray, beta: float, eps: complex, sign: float
) -> tuple[np.ndarray, np.ndarray]:
    """Tangential fields of s and p plane waves of unit electric field, one a column."""
    gamma = np.sqrt(eps - alpha**2 - beta**2 + 0j)
    size, index = np.hypot(alpha, beta), np.sqrt(eps)
    tx, ty = alpha / size, beta / size
    sx, sy = -ty, tx
    kz = sign * gamma
    # H = k x E: for s, H_t = -kz t; for p with E_t = (gamma / n) t, H_t = sign n s.
    columns = [
        np.concatenate([np.diag(v) for v in (sx, sy, -kz * tx, -kz * ty)]),
        np.concatenate(
            [np.diag(v) for v in (gamma / index * tx, gamma / index * ty)]
            + [np.diag(v) for v in (sign * index * sx, sign * index * sy)]
        ),
    ]
    return np.concatenate(columns, axis=1), gamma
