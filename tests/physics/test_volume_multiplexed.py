# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the sharing of light among several gratings is from the exact coupled waves."""

from dataclasses import dataclass

import numpy as np
import pytest

from hoe_addon.core.efficiency import kogelnik
from hoe_addon.core.efficiency.sharing import Taken, share_out

INDEX = 1.5
SAME = 1e-9
"""The eigenvectors of the coupled waves lose a few digits where two of them are alike."""


@dataclass(frozen=True)
class Case:
    """Gratings in one layer, light that sweeps over them, and the largest and rms errors found.

    Attributes:
        gratings: Grating vectors over 2 pi, 1/m, and amplitude of the index of each.
        thickness: Metres.
        light: Wavelength in metres and angle in the layer of each ray.
        largest: The largest error of any share, as measured and rounded up: the docs state it.
        rms: The same of the root of the mean square over all rays and shares.
    """

    gratings: tuple[tuple[tuple[float, float], float], ...]
    thickness: float
    light: tuple[np.ndarray, np.ndarray]
    largest: float
    rms: float


def mirror(wavelength: float, modulation: float) -> tuple[tuple[float, float], float]:
    return (0.0, -2.0 * INDEX / wavelength), modulation


def lines(period: float, modulation: float) -> tuple[tuple[float, float], float]:
    return (-1.0 / period, 0.0), modulation


VISIBLE = (np.linspace(420e-9, 680e-9, 521), np.zeros(521))
NARROW = (np.linspace(510e-9, 570e-9, 481), np.zeros(481))
TILTED = (np.full(401, 532e-9), np.radians(np.linspace(0.0, 20.0, 401)))

CASES = {
    "RGB mirror": Case(
        tuple(mirror(wavelength, 0.02) for wavelength in (450e-9, 532e-9, 633e-9)),
        8e-6,
        VISIBLE,
        largest=0.008,
        rms=0.001,
    ),
    "strong RGB mirror": Case(
        tuple(mirror(wavelength, 0.03) for wavelength in (450e-9, 532e-9, 633e-9)),
        8e-6,
        VISIBLE,
        largest=0.03,
        rms=0.003,
    ),
    "overlapping mirrors": Case(
        (mirror(532e-9, 0.03), mirror(542e-9, 0.03)), 8e-6, NARROW, largest=0.15, rms=0.04
    ),
    "overlapping weak transmission": Case(
        (lines(1e-6, 0.01), lines(1.1e-6, 0.01)), 9e-6, TILTED, largest=0.02, rms=0.005
    ),
    "overlapping transmission": Case(
        (lines(1e-6, 0.02), lines(1.1e-6, 0.02)), 9e-6, TILTED, largest=0.2, rms=0.05
    ),
}


def waves_of(case: Case, wavelength: float, angle: float) -> list[tuple[float, float, float]]:
    """Obliquity, dephasing and coupling of the orders +1 and -1 of each grating."""
    beta = 2.0 * np.pi * INDEX / wavelength
    rho = beta * np.array([np.sin(angle), 0.0, np.cos(angle)])
    found: list[tuple[float, float, float]] = []
    for (x, z), modulation in case.gratings:
        for order in (1.0, -1.0):
            step = 2.0 * np.pi * order * np.array([x, 0.0, z])
            theta = float(kogelnik.dephasing(rho, step, beta))
            coupled = float(kogelnik.coupling(wavelength, modulation).real)
            found.append((float((rho + step)[2] / beta), theta, coupled))
    return found


def exact(case: Case, cos_light: float, waves: list[tuple[float, float, float]]) -> np.ndarray:
    """Shares of all waves from their coupled equations, as a boundary problem in eigenvectors."""
    cosines = np.array([cos_light, *(wave[0] for wave in waves)])
    matrix = np.zeros((len(cosines), len(cosines)), dtype=complex)
    for place, (cosine, theta, coupled) in enumerate(waves, start=1):
        matrix[0, place] = 1j * coupled / cos_light
        matrix[place, 0] = 1j * coupled / cosine
        matrix[place, place] = 1j * theta / cosine
    rates, vectors = np.linalg.eig(matrix)
    # Each wave counts from the face where it is largest, so that nothing overflows.
    near = np.exp(np.minimum(-rates.real, 0.0) * case.thickness) * np.where(
        rates.real > 0.0, np.exp(-1j * rates.imag * case.thickness), 1.0
    )
    far = near * np.exp(rates * case.thickness)
    forward = cosines > 0.0
    known = np.where(forward[:, None], vectors * near, vectors * far)
    start = np.zeros(len(cosines), dtype=complex)
    start[0] = 1.0
    strength = np.linalg.solve(known, start)
    leaving = np.where(forward, (vectors * far) @ strength, (vectors * near) @ strength)
    return np.abs(cosines) / cos_light * np.abs(leaving) ** 2


def shared(case: Case, cos_light: float, waves: list[tuple[float, float, float]]) -> np.ndarray:
    alone = [
        Taken(*kogelnik.efficiencies(cos_light, cosine, theta, coupled + 0j, 0.0, case.thickness))
        for cosine, theta, coupled in waves
    ]
    pairs = [alone[place : place + 2] for place in range(0, len(alone), 2)]
    zero, given = share_out(pairs, np.ones(()))
    return np.array([zero, *(float(share) for pair in given for share in pair)])


@pytest.mark.parametrize("name", CASES)
def test_error_of_sharing(name: str) -> None:
    case = CASES[name]
    errors = []
    for wavelength, angle in zip(*case.light, strict=True):
        waves = waves_of(case, float(wavelength), float(angle))
        truth = exact(case, float(np.cos(angle)), waves)
        assert truth.sum() == pytest.approx(1.0, abs=SAME)
        errors.append(shared(case, float(np.cos(angle)), waves) - truth)
    largest = float(np.abs(errors).max())
    rms = float(np.sqrt(np.mean(np.square(errors))))
    assert largest < case.largest
    assert rms < case.rms


def test_one_wave_alone_is_exact() -> None:
    case = CASES["RGB mirror"]
    for wavelength in case.light[0][::20]:
        first = waves_of(case, float(wavelength), 0.0)[:1]
        found = kogelnik.efficiencies(1.0, *first[0], 0.0, case.thickness)
        np.testing.assert_allclose(found[::-1], exact(case, 1.0, first), atol=SAME)
