# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigorous gratings where modes, orders or layers degenerate: 50 digits, invariants, Cycles."""

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from mpmath import mp, mpc, mpf
from numpy.typing import NDArray

from hoe_addon.core.rcwa import Lamellar, Layer, PlaneWaves, Repeat, Stack, Uniform, solve
from tests.hard_cases.exact_gratings import Lit, Slab, shares

DIGITS = 50

FEW = 2e-14
"""Some hundred roundings of double precision in matrices of 6 x 6."""

ROUNDING = 1e-15
"""A few roundings of the wave numbers, of which an order at a distance e of grazing keeps the part
that is over sqrt(e); and of the phase, which is the more the thicker the layer is."""

ENERGY = 1e-10
"""The promise; 1e-12 is usual."""

RECIPROCITY = 1e-8
HARMONICS = (1, 3, 11, 31)
STEPS = tuple(sign * 10.0**-k for k in range(6, 13) for sign in (1, -1))

OFF_MU = (0.0, 1e-12, -1e-9, 1e-6)

GRATING = Slab(0.7, (2.25, 4.0), (0.1, 0.6))
METAL = Slab(0.3, (1.0, -10.0), (0.0, 0.5))
GLASS, AIR, SILVER = 2.25, 1.0, -10.0

CASES: dict[str, tuple[Lit, tuple[Slab, ...]]] = {
    "conical mount": (Lit(0.3, 0.2, 0.8, GLASS, AIR), (GRATING,)),
    "classical mount": (Lit(0.3, 0.0, 0.8, GLASS, AIR), (GRATING,)),
    "theta = 0": (Lit(0.0, 0.0, 0.5, GLASS, AIR), (GRATING,)),
    "theta = 0, both first orders at grazing": (Lit(0.0, 0.0, 1.0, GLASS, AIR), (GRATING,)),
    "theta = 1e-12": (Lit(1e-12, 0.0, 0.5, GLASS, AIR), (GRATING,)),
    "azimuth 90 degrees": (Lit(0.0, 0.7, 0.5, GLASS, AIR), (GRATING,)),
    "azimuth 90 degrees, orders at grazing": (Lit(0.0, 0.6, 0.8, GLASS, AIR), (GRATING,)),
    "azimuth next to 90 degrees": (Lit(1e-12, 0.7, 0.5, GLASS, AIR), (GRATING,)),
    "mount next to classical": (Lit(0.3, 2e-9, 0.8, GLASS, AIR), (GRATING,)),
    "anomaly behind": (Lit(1.0, 0.0, 0.5, GLASS, AIR), (GRATING,)),
    "anomaly in front": (Lit(0.5, 0.0, 0.5, GLASS, AIR), (GRATING,)),
    "mode at its cut-off": (Lit(0.5, 0.0, 0.5, GLASS, AIR), (Slab(0.5, (1.0,)), GRATING)),
    "no contrast": (Lit(0.2, 0.1, 0.6, GLASS, AIR), (Slab(0.5, (3.0, 3.0), (0.1, 0.6)),)),
    "contrast of 1e-12": (
        Lit(0.2, 0.1, 0.6, GLASS, AIR),
        (Slab(0.5, (3.0, 3.000000000001), (0.1, 0.6)),),
    ),
    "no thickness": (Lit(0.2, 0.1, 0.6, GLASS, AIR), (Slab(0.0, (1.0, 4.0), (0.1, 0.6)),)),
    "thickness of 1e-12": (Lit(0.2, 0.1, 0.6, GLASS, AIR), (Slab(1e-12, (1.0, 4.0), (0.1, 0.6)),)),
    "two equal neighbours": (Lit(0.2, 0.1, 0.6, GLASS, AIR), (GRATING, GRATING, Slab(0.3, (4.0,)))),
    "stretch of no width": (
        Lit(0.2, 0.1, 0.6, GLASS, AIR),
        (Slab(0.5, (1.0, 4.0, 2.0), (0.1, 0.3, 0.3)),),
    ),
    "1000 wavelengths": (
        Lit(0.2, 0.1, 0.2, GLASS, AIR),
        (Slab(1000.0, (2.25, 4.0), (0.1, 0.6)),),
    ),
    "lossless metal": (Lit(0.2, 0.0, 0.5, AIR, GLASS), (METAL,)),
    "lossless metal, conical": (Lit(0.2, 0.3, 0.5, AIR, GLASS), (METAL,)),
    "lossless metal below": (Lit(0.2, 0.0, 0.5, AIR, SILVER), (METAL,)),
    "lossless metal, theta = 0": (Lit(0.0, 0.0, 0.5, AIR, SILVER), (METAL,)),
    "absorbing metal": (
        Lit(0.2, 0.3, 0.5, AIR, GLASS),
        (Slab(0.3, (1.0, -10.0 + 1j), (0.0, 0.5)),),
    ),
} | {
    f"anomaly behind {step:+.0e}": (Lit(1.0 + step, 0.0, 0.5, GLASS, AIR), (GRATING,))
    for step in STEPS
}
CASES |= {
    f"wave number of the layer's own along x {step:+.0e}": (
        Lit(0.5 + step, 0.3, 0.5, GLASS, AIR),
        (GRATING, Slab(0.4, (1.0,)), GRATING),
    )
    for step in OFF_MU
}
"""Three harmonics of each are compared. In the last ones alpha^2 = eps in a layer, where the modes
of both families are the same."""


def stack_of(slabs: Sequence[Slab], light: Lit) -> tuple[Stack, list[complex]]:
    materials, layers = [light.back, light.front], list[Layer]()
    for slab in slabs:
        places = tuple(range(len(materials), len(materials) + len(slab.permittivity)))
        materials += slab.permittivity
        flat = len(places) == 1
        pattern = Uniform(places[0]) if flat else Lamellar(np.array(slab.walls), places)
        layers.append(Layer(pattern, slab.thickness))
    return Stack(layers), materials


def found(
    light: Lit, slabs: Sequence[Slab], harmonics: int, **options: bool
) -> NDArray[np.float64]:
    """Shares of all orders, shape (2, K, 2), the light in wavelengths of length 1."""
    stack, materials = stack_of(slabs, light)
    waves = PlaneWaves.of(1.0, (light.along, light.across), 1.0 / light.step, materials)
    solution = solve(stack, waves, harmonics, **options)
    return np.stack((solution.reflected[0], solution.transmitted[0]))


@cache
def exact(name: str) -> NDArray[np.float64]:
    with mp.workdps(DIGITS + 20):
        return shares(*CASES[name], highest=1)


def nearest_to_grazing(light: Lit) -> float:
    """Least |n^2 - t^2| of the three orders that is not exactly 0."""
    with mp.workdps(DIGITS):
        along = [mpf(light.along) + m * mpf(light.step) for m in (-1, 0, 1)]
        sizes = [x**2 + mpf(light.across) ** 2 for x in along]
        apart = [abs(end - size) for size in sizes for end in (light.back, light.front)]
        return max(float(min(distance for distance in apart if distance > 0)), ROUNDING)


@pytest.mark.parametrize("name", CASES)
def test_against_fifty_digits(name: str) -> None:
    light, slabs = CASES[name]
    depth = sum(slab.thickness for slab in slabs)
    allowed = FEW + ROUNDING * (1.0 / math.sqrt(nearest_to_grazing(light)) + depth)
    error = np.abs(found(light, slabs, 3, about_zero=True) - exact(name))
    assert np.max(error) <= allowed


MOVED = 1e-6
"""Permittivities that are raised by 3e-7 turn the phase of a wave by 1e-6 in half a wavelength."""


@pytest.mark.parametrize("step", OFF_MU)
def test_modes_of_both_families_in_a_layer_of_stretches(step: float) -> None:
    light = Lit(0.5 + step, 0.3, 0.5, GLASS, AIR)
    slabs = (Slab(0.4, (1.0, 1.0), (0.1, 0.6)), GRATING)
    with mp.workdps(DIGITS):
        expected = shares(light, slabs, highest=1)
    answer = found(light, slabs, 3, about_zero=True)
    assert np.max(np.abs(answer - expected)) < MOVED
    np.testing.assert_allclose(answer.sum(axis=(0, 1)), 1.0, rtol=0.0, atol=ENERGY)


LOSSLESS = [name for name in CASES if name != "absorbing metal"]


@pytest.mark.parametrize("name", LOSSLESS)
def test_energy(name: str) -> None:
    light, slabs = CASES[name]
    for harmonics in HARMONICS:
        total = found(light, slabs, harmonics).sum(axis=(0, 1))
        np.testing.assert_allclose(total, 1.0, rtol=0.0, atol=ENERGY)


MICROMETRE_PERIOD = tuple(
    Slab(0.1 + 0.07 * k, (GLASS, 4.0 - 0.3 * k), (0.05 * k, 0.5 + 0.02 * k)) for k in range(8)
)


@pytest.mark.parametrize("across", [0.0, 0.3])
@pytest.mark.parametrize("copies", [1, 40])
def test_energy_of_many_layers_of_a_wide_period(copies: int, across: float) -> None:
    """2 um at 532 nm: dozens of modes, of both signs of gamma^2, through 320 layers."""
    stack, materials = stack_of(MICROMETRE_PERIOD, Lit(0.0, 0.0, 1.0, GLASS, AIR))
    layers = [Repeat(tuple(stack.layers), copies)] if copies > 1 else stack.layers
    along = np.array((0.0, 0.266, 0.5, 1.0 - 0.266, 1.0))
    waves = PlaneWaves.of(0.532, (along, across), 2.0, materials)
    for harmonics in (1, 5, 15, 31):
        solution = solve(Stack(layers), waves, harmonics)
        total = (solution.reflected + solution.transmitted).sum(axis=1)
        np.testing.assert_allclose(total, 1.0, rtol=0.0, atol=ENERGY)


ROOT_LAW = 0.05
"""Beside an anomaly every share moves with the root of the step. At a step of 1e-6 the next term is
1e-3 of that; at 1e-12 one rounding of the wave number (1e-16) is 1e-2 of it."""


@pytest.mark.parametrize("harmonics", [3, 21])
@pytest.mark.parametrize("across", [0.0, 0.3])
@pytest.mark.parametrize("slab", [GRATING, METAL])
def test_no_jump_at_an_anomaly(slab: Slab, across: float, harmonics: int) -> None:
    at = math.sqrt(GLASS - across**2) - 0.5

    def shares_at(along: float) -> NDArray[np.float64]:
        light = Lit(along, across, 0.5, GLASS, AIR)
        return found(light, (slab,), harmonics, about_zero=True)

    middle = shares_at(at)
    for side in (1.0, -1.0):
        slopes = [
            (shares_at(at + side * step) - middle) / math.sqrt(step)
            for step in 10.0 ** np.arange(-12, -5)
        ]
        largest = np.max(np.abs(slopes[3]))
        assert largest > 0.1
        for slope in slopes:
            assert np.max(np.abs(slope - slopes[3])) <= ROOT_LAW * largest


@pytest.mark.parametrize("slab", [GRATING, METAL])
@pytest.mark.parametrize("across", [0.0, 0.3])
def test_reciprocity_next_to_an_anomaly(slab: Slab, across: float) -> None:
    """Orders 0 reflected, and +1 reflected close to grazing, sent back."""
    for step in (1e-3, 1e-6, 1e-9):
        there = Lit(math.sqrt(GLASS - across**2) - 0.5 - step, across, 0.5, GLASS, AIR)
        stack, materials = stack_of((slab,), there)
        forth = solve(stack, PlaneWaves.of(1.0, (there.along, across), 2.0, materials), 21)
        for order in (0, 1):
            sent = (-(there.along + order * 0.5), -across)
            back = solve(stack, PlaneWaves.of(1.0, sent, 2.0, materials), 21)
            first = forth.reflected[0, forth.place(order)]
            second = back.reflected[0, back.place(order)]
            # Sums over polarisations of the order are not reciprocal one by one, their sum is.
            assert abs(first.sum() - second.sum()) < RECIPROCITY


def airy(light: Lit, eps: complex, thickness: float, kind: str) -> mpf:
    """Share that one layer reflects."""
    size = mpf(light.along) ** 2 + mpf(light.across) ** 2
    media = [mpc(light.back), mpc(eps), mpc(light.front)]
    gammas = [mp.sqrt(value - size) for value in media]
    y = [g / (e if kind == "p" else 1) for g, e in zip(gammas, media, strict=True)]
    first, second = ((y[k] - y[k + 1]) / (y[k] + y[k + 1]) for k in (0, 1))
    turn = mp.expj(4 * mp.pi * gammas[1] * mpf(thickness))
    return abs((first + second * turn) / (1 + first * second * turn)) ** 2


@pytest.mark.parametrize("thickness", [0.0, 1e-9, 0.3, 1000.0])
@pytest.mark.parametrize("permittivity", [2.25, 4.0, 1.2, -10.0, -10.0 + 1j])
@pytest.mark.parametrize("harmonics", [1, 11])
def test_layers_without_contrast_are_airys(
    permittivity: complex, thickness: float, harmonics: int
) -> None:
    """Up to and past the critical angle, in the plane of the grating and out of it."""
    slabs = (Slab(thickness, (permittivity, permittivity), (0.2, 0.7)),)
    for size in (0.0, 1e-9, 0.6, 0.999999, 1.000001, 1.3, 1.499999):
        for x, y in ((1.0, 0.0), (0.0, 1.0), (0.6, -0.8)):
            light = Lit(size * x, size * y, 0.37, GLASS, AIR)
            answer = found(light, slabs, harmonics)[0].sum(axis=0)
            slope = 1.0 / math.sqrt(min(abs(GLASS - size**2), abs(AIR - size**2), 1.0))
            with mp.workdps(DIGITS):
                expected = [float(airy(light, permittivity, thickness, kind)) for kind in "sp"]
            allowed = FEW + 20.0 * ROUNDING * (slope + thickness)
            np.testing.assert_allclose(answer, expected, rtol=0.0, atol=allowed)
