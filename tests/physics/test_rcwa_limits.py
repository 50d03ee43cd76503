# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws that every rigorous solution obeys, and limits where a closed form is known."""

import math

import numpy as np
import pytest

from hoe_addon.core import fresnel
from hoe_addon.core.efficiency.kinoform import efficiency
from hoe_addon.core.rcwa import (
    Lamellar,
    Layer,
    PlaneWaves,
    Polygon,
    Repeat,
    Smooth,
    Solution,
    Stack,
    Uniform,
    polygon_layers,
    solve,
)
from hoe_addon.core.rcwa.reliefs import binary, staircase, trapezoid

ENERGY = 1e-10
"""The promise. The scattering matrices are unitary to rounding, so 1e-12 is usual."""
ROUNDING = 1e-11
"""Two ways to one number in double precision, through matrices of up to 82 x 82."""
RECIPROCITY = 1e-8
LARGE = 1000.0
"""Wavelengths of a thick layer: the phase then has lost three digits."""


def total(found: Solution) -> np.ndarray:
    return found.reflected.sum(axis=1) + found.transmitted.sum(axis=1)


def random_stack(rng: np.random.Generator, layers: int) -> Stack:
    parts: list[Layer] = []
    for _ in range(layers):
        walls = np.sort(rng.random(4))
        parts.append(Layer(Lamellar(walls, (0, 1, 2, 1)), float(rng.random()) * 5, rng.random()))
        parts.append(Layer(Uniform(3), float(rng.random())))
    return Stack(parts)


def random_light(
    rng: np.random.Generator, period: float, count: int = 6, front: bool = False
) -> PlaneWaves:
    """Half of it in classical mount; from the back also beyond the critical angle."""
    index = 1.0 if front else 1.5
    size, azimuth = index * rng.random(count), 2.0 * np.pi * rng.random(count)
    azimuth[: count // 2] = 0.0
    tangential = size * np.cos(azimuth), size * np.sin(azimuth)
    return PlaneWaves.of(1.0, tangential, period, [2.25, 1.0, 6.0, 3.0], from_front=front)


@pytest.mark.parametrize("front", [False, True])
@pytest.mark.parametrize("period", [0.7, 2.0, 5.0, 20.0])
@pytest.mark.parametrize("layers", [1, 4])
def test_lossless_energy_at_every_truncation(
    rng: np.random.Generator, layers: int, period: float, front: bool
) -> None:
    stack, light = random_stack(rng, layers), random_light(rng, period, front=front)
    for harmonics in (1, 3, 5, 11, 21, 41):
        np.testing.assert_allclose(total(solve(stack, light, harmonics)), 1.0, atol=ENERGY)


def test_energy_of_layers_a_thousand_wavelengths_thick(rng: np.random.Generator) -> None:
    pattern = Lamellar(np.array([-0.2, 0.2]), (2, 1))
    light = random_light(rng, 2.3)
    whole = solve(Stack([Layer(pattern, LARGE)]), light, 21)
    np.testing.assert_allclose(total(whole), 1.0, atol=ENERGY)
    halves = solve(Stack([Repeat((Layer(pattern, LARGE / 2),), 2)]), light, 21)
    np.testing.assert_allclose(halves.transmitted, whole.transmitted, atol=LARGE * ROUNDING)


def test_absorbing_layers_absorb(rng: np.random.Generator) -> None:
    light = random_light(rng, 1.3)
    table = light.permittivity.copy()
    table[:, 2] = (0.22 + 6.71j) ** 2
    lossy = PlaneWaves(
        light.wavelength, light.along, light.across, light.step, light.from_front, table
    )
    for harmonics in (1, 5, 21):
        rest = total(solve(random_stack(rng, 2), lossy, harmonics))
        assert np.all((rest > 0.0) & (rest < 1.0))


@pytest.mark.parametrize("reflected", [False, True])
@pytest.mark.parametrize("front", [False, True])
@pytest.mark.parametrize("absorption", [0.0, 0.3])
def test_reciprocity(
    rng: np.random.Generator, front: bool, reflected: bool, absorption: float
) -> None:
    """Light sent back along an order returns with the same amplitudes, transposed."""
    layers = [Layer(Lamellar(np.array([0.1, 0.3, 0.8]), (0, 1, 2)), 0.7), Layer(Uniform(3), 0.2)]
    stack = Stack([*layers, *trapezoid(0.4, (0.0, 0.5), (0.4, 0.7), 5)])
    table = [2.25, 1.0, 6.0 + absorption * 1j, 3.0]
    period, tangential = 1.4, (0.31, 0.27)
    light = PlaneWaves.of(1.0, tangential, period, table, from_front=front)
    there = solve(stack, light, 9)  # few: reciprocity must not wait for convergence
    power, jones = (
        (there.reflected, there.reflected_jones)
        if reflected
        else (there.transmitted, there.transmitted_jones)
    )
    side = front if reflected else not front
    compared = 0
    for place in np.flatnonzero(power[0].sum(axis=1) > 0.0):
        order = int(there.orders[place])
        sent = (-(tangential[0] + order / period), -tangential[1])
        light = PlaneWaves.of(1.0, sent, period, table, from_front=side)
        back = solve(stack, light, 9)
        answer = back.reflected_jones if reflected else back.transmitted_jones
        ends = [
            math.sqrt((1.0 if from_front else 2.25) - along**2 - tangential[1] ** 2)
            for from_front, along in ((front, tangential[0]), (side, sent[0]))
        ]
        place_back = back.place(order)
        forth = jones[0, place] * math.sqrt(ends[1] / ends[0])
        home = answer[0, place_back] * math.sqrt(ends[0] / ends[1])
        np.testing.assert_allclose(np.abs(home), np.abs(forth.T), atol=RECIPROCITY)
        compared += 1
    assert compared >= 2


@pytest.mark.parametrize("across", [0.0, 0.3])
def test_overhanging_profile_is_its_mirror_image(across: float) -> None:
    points = np.array([[0.0, 0.0], [0.4, 0.0], [1.1, 0.4], [0.9, 0.6], [0.5, 0.3]])
    mirrored = points * (-1.0, 1.0)
    table = [2.25, 1.0, 4.0]
    results = []
    for outline, along in ((points, 0.35), (mirrored, -0.35)):
        stack = Stack(polygon_layers([Polygon(outline, 2)], 1, 12))
        light = PlaneWaves.of(0.6, (along, across), 1.0, table, from_front=True)
        results.append(solve(stack, light, 31))
    first, second = results
    np.testing.assert_allclose(second.reflected[:, ::-1], first.reflected, atol=ROUNDING)
    np.testing.assert_allclose(second.transmitted[:, ::-1], first.transmitted, atol=ROUNDING)
    # It is no symmetric profile: the same light on the mirror image gives something else.
    assert np.abs(first.transmitted[:, ::-1] - first.transmitted).max() > 1e-2


@pytest.mark.parametrize("front", [False, True])
@pytest.mark.parametrize("layers", [(), binary(0.4, ridge=1), binary(1e-14, ridge=0)])
def test_no_relief_is_fresnel(layers: tuple[Layer, ...], front: bool) -> None:
    index_in, index_out = (1.0, 1.5) if front else (1.5, 1.0)
    sines = np.array([0.0, 1e-12, 0.3, 0.6, 0.66, 0.67, 0.9, 0.9999, 1.0])
    for azimuth in np.radians([0.0, 30.0, 90.0, 180.0, 250.0]):
        tangential = index_in * sines * np.cos(azimuth), index_in * sines * np.sin(azimuth)
        light = PlaneWaves.of(1.0, tangential, 1.7, [2.25, 1.0], from_front=front)
        found = solve(Stack(layers), light, 5)
        cosines = np.sqrt(1.0 - sines**2)
        for place, formula in enumerate((fresnel.reflectance_s, fresnel.reflectance_p)):
            expected = formula(cosines, index_in, index_out)
            # At grazing the reflectance has an infinite slope, and cos(90 deg) only 8 digits.
            np.testing.assert_allclose(
                found.reflected[:, found.place(0), place], expected, atol=1e-7
            )
            steep = sines < 0.99
            np.testing.assert_allclose(
                found.reflected[steep, found.place(0), place], expected[steep], atol=ROUNDING
            )
        assert not np.any(np.delete(found.reflected, found.place(0), axis=1) > ROUNDING)


def test_equal_layers_and_layers_without_contrast(rng: np.random.Generator) -> None:
    """Every eigenvalue is double in the conical mount of a layer that does not vary."""
    light = random_light(rng, 1.9)
    same = solve(Stack([Layer(Lamellar(np.array([0.1, 0.6]), (2, 2)), 0.8)]), light, 11)
    plain = solve(Stack([Layer(Uniform(2), 0.8)]), light, 11)
    np.testing.assert_allclose(same.reflected, plain.reflected, atol=ROUNDING)
    np.testing.assert_allclose(same.transmitted, plain.transmitted, atol=ROUNDING)


@pytest.mark.slow
def test_thin_limit_is_the_kinoform_formula() -> None:
    """A staircase of 4 levels, its orders over all that is transmitted, as the period grows."""
    alpha, levels, index = 0.9, 4, 1.5
    depth = alpha / (index - 1.0)
    expected = efficiency([0, 1, 2], alpha, levels)
    errors = []
    for period, harmonics in ((8.0, 61), (16.0, 101), (32.0, 181), (64.0, 301)):
        light = PlaneWaves.of(1.0, (0.0, 0.0), period, [index**2, 1.0])
        powers = solve(Stack(staircase(depth, levels)), light, harmonics).transmitted.mean(axis=2)
        middle = harmonics // 2  # at normal incidence
        found = powers[0, middle : middle + 3] / powers.sum()
        errors.append(np.abs(found - expected).max())
    assert errors[0] > 0.02
    assert np.all(np.diff(errors) < 0.0)
    # The scalar formula leaves out a field of about a wavelength at every wall.
    assert errors[-1] < 0.012


@pytest.mark.parametrize("across", [0.0, 0.3])
def test_order_at_grazing_is_the_limit(across: float) -> None:
    """A Rayleigh anomaly: efficiencies are continuous, with an infinite slope."""
    exact = 1.0 / math.sqrt(1.0 - across**2)
    results = []
    for change in (0.0, 1e-14, -1e-14, 1e-6):
        light = PlaneWaves.of(
            1.0, (0.0, across), exact * (1.0 + change), [2.25, 1.0], from_front=True
        )
        found = solve(Stack(binary(0.7, 0.4)), light, 21)
        np.testing.assert_allclose(total(found), 1.0, atol=ENERGY)
        results.append(found)
    # The slope goes with the root of the distance.
    for other, change in zip(results[1:], (1e-14, 1e-14, 1e-6), strict=True):
        moved = np.abs(other.transmitted - results[0].transmitted).max()
        assert moved < 5.0 * math.sqrt(change)


def test_azimuth_and_normal_incidence_are_no_exceptions() -> None:
    """Along the grooves, and at normal incidence seen from every azimuth."""
    stack, table = Stack(binary(0.7, 0.3)), [2.25, 1.0]
    tiny = 1e-7
    straight = solve(stack, PlaneWaves.of(1.0, (0.0, 0.0), 1.4, table), 21)
    along = solve(stack, PlaneWaves.of(1.0, (0.0, tiny), 1.4, table), 21)
    # Along the grooves s and p change places: p then has its field along y.
    np.testing.assert_allclose(along.transmitted[..., ::-1], straight.transmitted, atol=10.0 * tiny)
    grooves = solve(stack, PlaneWaves.of(1.0, ([0.0, 1e-9], 0.8), 1.4, table), 21)
    np.testing.assert_allclose(grooves.transmitted[0], grooves.transmitted[1], atol=1e-7)
    np.testing.assert_allclose(grooves.transmitted[0], grooves.transmitted[0, ::-1], atol=ROUNDING)
    np.testing.assert_allclose(total(grooves), 1.0, atol=ENERGY)


@pytest.mark.slow
def test_metal_across_the_walls_converges_with_few_harmonics() -> None:
    """Gold: with the inverse rule the error falls quickly, and both polarisations agree."""
    light = PlaneWaves.of(1.0, (0.5, 0.0), 1.0, [(0.22 + 6.71j) ** 2, 1.0], from_front=True)
    stack = Stack(binary(1.0))

    def found(harmonics: int) -> np.ndarray:
        return solve(stack, light, harmonics).span(-1, 0).reflected[0, :, 1]

    best = found(301)
    errors = [np.abs(found(harmonics) - best).max() for harmonics in (21, 41, 81)]
    # Laurent's rule in place of the inverse rule is off by more than 0.2 at 41 harmonics.
    assert errors[0] < 0.01
    assert errors[1] < 0.006
    assert errors[2] < 0.003


def test_smooth_and_cut_permittivity_agree() -> None:
    """A cosine as one smooth layer, and as many stretches of constant permittivity."""
    count, amplitude = 200, 0.5
    places = (np.arange(count) + 0.5) / count
    steps = 2.25 + amplitude * np.cos(2.0 * np.pi * places)
    table = [2.25, 1.0, 2.25, amplitude, *steps]
    light = PlaneWaves.of(0.7, (0.2, 0.3), 0.9, table)
    series = np.array([[0.0, 1.0, 0.0], [0.5, 0.0, 0.5]], dtype=np.complex128)
    smooth = Stack([Layer(Smooth((2, 3), series), 0.8)])
    cut = Stack([Layer(Lamellar(np.arange(count) / count, tuple(range(4, 4 + count))), 0.8)])
    one, two = solve(smooth, light, 21), solve(cut, light, 21)
    # The stretches weaken the cosine by pi^2 / (6 count^2) = 4e-5.
    np.testing.assert_allclose(one.transmitted, two.transmitted, atol=1e-4)


@pytest.mark.parametrize("across", [0.0, 0.3])
def test_what_a_metal_half_space_does_not_reflect_goes_into_it(across: float) -> None:
    light = PlaneWaves.of(1.0, (0.5, across), 1.0, [(0.5 + 3.0j) ** 2, 1.0], from_front=True)
    for layers in ((), binary(0.2, ridge=1), (Layer(Uniform(1), 0.3),)):
        np.testing.assert_allclose(total(solve(Stack(layers), light, 5)), 1.0, atol=ENERGY)
