# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigorous efficiencies beside published numbers, and beside solutions found in another way."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.rcwa import Layer, PlaneWaves, Smooth, Solution, Stack, solve, volume_layers
from hoe_addon.core.rcwa.modes import lse_modes, lsm_modes
from hoe_addon.core.rcwa.reliefs import binary, sinusoid

REFERENCE = json.loads(
    (Path(__file__).resolve().parents[1] / "reference" / "rcwa.json").read_text(encoding="utf-8")
)
SOLVERS = 1e-5
"""Two independent solvers agree to 1e-6 on numbers of five digits."""
ONE_UNIT = 1.0
"""A printed number may be cut or rounded in its last digit."""
TRUNCATION = 1e-4
"""Modes of 121 harmonics; the error falls as the third power of their number."""

INDEX, MODULATION = 1.5, 0.03
VOLUME = [INDEX**2, INDEX**2, INDEX**2, 2.0 * INDEX * MODULATION]


def share(solution: Solution, side: str, order: int, polarization: str) -> float:
    powers = getattr(solution, side)
    return float(powers[0, solution.place(order), "sp".index(polarization)])


def check_printed(solution: Solution, table: dict[str, Any]) -> None:
    for polarization in "sp":
        for side in ("reflected", "transmitted"):
            for order, value in table[polarization][side]:
                last = 10.0 ** (math.floor(math.log10(value)) - table["provenance"]["digits"] + 1)
                found = share(solution, side, order, polarization)
                assert abs(found - value) <= ONE_UNIT * last, (polarization, side, order, found)


def test_li_table_3_a_relief_100_periods_deep() -> None:
    light = PlaneWaves.of(1.0 / 1.7, (0.5, 0.0), 1.0, [2.25, 1.0], from_front=True)
    check_printed(
        solve(Stack(sinusoid(100.0, 50)), light, 41, about_zero=True), REFERENCE["li_1993_table_3"]
    )


def test_li_table_2_conical_mount() -> None:
    polar, azimuth = np.radians([61.1209, 17.1921])
    tangential = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth)
    light = PlaneWaves.of(0.5, tangential, 1.0, [4.0, 1.0], from_front=True)
    check_printed(
        solve(Stack(sinusoid(0.3, 50)), light, 41, about_zero=True), REFERENCE["li_1993_table_2"]
    )


@pytest.mark.parametrize("row", REFERENCE["binary"]["rows"], ids=lambda row: str(row["depth"]))
def test_binary_relief(row: dict[str, Any]) -> None:
    along = math.sin(math.radians(10.0))
    light = PlaneWaves.of(1.0, (along, 0.0), 1.0, [2.04**2, 1.0], from_front=True)
    found = solve(Stack(binary(row["depth"])), light, 161)
    ways = [("reflected", 0), ("reflected", -1), *(("transmitted", m) for m in (-1, 0, 1))]
    for polarization in "sp":
        values = [share(found, side, order, polarization) for side, order in ways]
        np.testing.assert_allclose(values, row[polarization], rtol=0.0, atol=SOLVERS)


@pytest.mark.parametrize("row", REFERENCE["volume_transmission"]["rows"])
def test_transmission_volume_grating(row: dict[str, Any]) -> None:
    angle = math.radians(10.21447 + row["offset_deg"])
    light = PlaneWaves.of(532e-9, (-INDEX * math.sin(angle), 0.0), 1e-6, VOLUME)
    found = solve(Stack(volume_layers(9e-6, 0.0, mean=2, wave=3)), light, 11)
    for polarization in "sp":
        assert share(found, "transmitted", 1, polarization) == pytest.approx(
            row[polarization], abs=SOLVERS
        )


@pytest.mark.parametrize("row", REFERENCE["volume_reflection"]["rows"])
def test_reflection_volume_grating(row: dict[str, Any]) -> None:
    """The listed number belongs to a staircase; our layers follow the wave itself."""
    wavelength, period, thickness = row["wavelength_nm"] * 1e-9, 0.177333e-6, 7.98e-6
    light = PlaneWaves.of(wavelength, (0.0, 0.0), np.inf, VOLUME)
    steps = REFERENCE["volume_reflection"]["layers_per_fringe"]
    count = round(thickness / period) * steps
    waves = np.cos(2.0 * np.pi * (np.arange(steps) + 0.5) / steps)
    kinds = [Smooth((2, 3), np.array([[1.0], [wave]], dtype=np.complex128)) for wave in waves]
    staircase = [Layer(kinds[k % steps], thickness / count) for k in range(count)]
    assert share(solve(Stack(staircase), light, 1), "reflected", 0, "s") == pytest.approx(
        row["staircase"], abs=SOLVERS
    )
    layers = volume_layers(thickness, 1.0 / period, mean=2, wave=3, plane=True)
    exact = reflectance_by_ode(wavelength, period, thickness)
    for polarization in "sp":
        found = share(solve(Stack(layers), light, 1), "reflected", 0, polarization)
        assert found == pytest.approx(exact, abs=1e-6)  # residual error of 64 layers a fringe


def reflectance_by_ode(wavelength: float, period: float, thickness: float) -> float:
    """Reflectance of flat fringes: E'' = -k^2 eps E, by Runge-Kutta from the far face."""
    wave_number, count = 2.0 * math.pi / wavelength, 20_000
    step = thickness / count

    def slope(z: float, e: complex, d: complex) -> tuple[complex, complex]:
        fringe = math.cos(2.0 * math.pi * z / period)
        return d, -(wave_number**2) * (INDEX**2 + 2.0 * INDEX * MODULATION * fringe) * e

    e, d = 1.0 + 0j, 1j * wave_number * INDEX
    for index in range(count):
        z = thickness - index * step
        a1, b1 = slope(z, e, d)
        a2, b2 = slope(z - step / 2, e - step / 2 * a1, d - step / 2 * b1)
        a3, b3 = slope(z - step / 2, e - step / 2 * a2, d - step / 2 * b2)
        a4, b4 = slope(z - step, e - step * a3, d - step * b3)
        e, d = (
            e - step / 6 * (a1 + 2 * a2 + 2 * a3 + a4),
            d - step / 6 * (b1 + 2 * b2 + 2 * b3 + b4),
        )
    forward, backward = e + d / (1j * wave_number * INDEX), e - d / (1j * wave_number * INDEX)
    return abs(backward / forward) ** 2


@pytest.mark.parametrize("ridge", [2.25, 12.0, (0.22 + 6.71j) ** 2, -40.0])
def test_modes_are_those_of_the_exact_dispersion_equation(ridge: complex) -> None:
    """Rytov's equation of a lamellar layer, for fields along and across the walls.

    Botten et al. (1981), The dielectric lamellar diffraction grating, Optica Acta 28, 413,
    doi:10.1080/713820571.
    """
    duty, step, along, highest = 0.4, 0.7, 0.23, 60
    table = np.array([[ridge, 1.0]], dtype=np.complex128)
    alpha = along + step * np.arange(-highest, highest + 1)[None, :]
    pattern = binary(1.0, duty)[0].pattern
    for weights, modes in (
        ((1.0, 1.0), lse_modes(pattern, alpha, table).mu[0]),
        ((ridge, 1.0), lsm_modes(pattern, alpha, table).mu[0]),
    ):
        # The guided modes; a metal adds spurious ones of huge mu, which every truncation has.
        best = modes[np.argsort(np.abs(modes - max(1.0, complex(ridge).real)))][:3]
        for mu in best.astype(np.complex128):
            root = newton(mu, ridge, weights, duty, step, along)
            assert abs(mu - root) < TRUNCATION * (1.0 + abs(root)), (ridge, weights, mu, root)


def newton(
    start: complex,
    ridge: complex,
    weights: tuple[complex, complex],
    duty: float,
    step: float,
    along: float,
) -> complex:
    period = 2.0 * np.pi / step

    def residual(mu: complex) -> complex:
        first, second = np.sqrt(ridge - mu + 0j), np.sqrt(1.0 - mu + 0j)
        one, two = first * duty * period, second * (1.0 - duty) * period
        ratio = (first * weights[1]) / (second * weights[0])
        mixed = 0.5 * (ratio + 1.0 / ratio) * np.sin(one) * np.sin(two)
        return np.cos(one) * np.cos(two) - mixed - np.cos(along * period)

    mu = start
    for _ in range(20):
        h = 1e-6 * max(1.0, abs(mu))
        mu -= residual(mu) * 2.0 * h / (residual(mu + h) - residual(mu - h))
    return mu
