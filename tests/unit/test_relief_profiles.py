# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Profiles of thin reliefs: every way to the same amplitude agrees, and no light is lost."""

from collections.abc import Callable

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.arrays import FloatArray
from hoe_addon.core.efficiency.bessel import bessel_j
from hoe_addon.core.efficiency.profiles import Binary, Profile, Sawtooth, Sinusoid
from hoe_addon.core.efficiency.segments import Segments, Steps, joined_samples, triangle

ROUNDING = 2e-15
"""A sum of some ten numbers below 1 in double precision, with phases of up to 100 periods."""

SAMPLES = 20_160
ORDERS = np.arange(-9, 10)
DEPTHS = np.array([0.0, 0.3, 0.5, 1.0, 1.7, 7.25])[:, None]

HEIGHTS = np.array([0.0, 0.9, 0.2, -0.4, 1.3, 0.5])
BY_HEIGHT: dict[str, tuple[Profile, Callable[[FloatArray], FloatArray]]] = {
    "sawtooth": (Sawtooth(), lambda x: x),
    "sinusoid": (Sinusoid(), lambda x: 0.5 + 0.5 * np.cos(2.0 * np.pi * x)),
    "binary": (Binary(0.3), lambda x: np.where(np.abs(x - 0.5) < 0.15, 1.0, 0.0)),
    "triangle": (triangle(0.25), lambda x: np.interp(x, (0.0, 0.25, 1.0), (0.0, 1.0, 0.0))),
    "steps": (Steps(HEIGHTS), lambda x: HEIGHTS[(x * 6).astype(int)]),
    "joined": (
        joined_samples(HEIGHTS),
        lambda x: np.interp(x, np.arange(7) / 6.0, np.append(HEIGHTS, HEIGHTS[0])),
    ),
}


@pytest.mark.parametrize("name", BY_HEIGHT)
def test_amplitude_is_the_fourier_integral(name: str) -> None:
    profile, height = BY_HEIGHT[name]
    place = (np.arange(SAMPLES) + 0.5) / SAMPLES
    phase = DEPTHS[..., None] * height(place) - ORDERS[:, None] * place
    integral = np.mean(np.exp(2j * np.pi * phase), axis=-1)
    # Midpoint rule: (2 pi slope / samples)^2 / 24 with a slope of up to 9 + 7.25 * 10.2 periods.
    np.testing.assert_allclose(profile.amplitude(ORDERS, DEPTHS), integral, atol=3e-5)


@pytest.mark.parametrize("name", BY_HEIGHT)
def test_efficiency_is_the_square_and_sums_to_one(name: str) -> None:
    profile, _height = BY_HEIGHT[name]
    power = np.abs(profile.amplitude(ORDERS, DEPTHS)) ** 2
    np.testing.assert_allclose(profile.efficiency(ORDERS, DEPTHS), power, atol=ROUNDING)
    reach = 2_000
    total = np.sum(profile.efficiency(np.arange(-reach, reach + 1), DEPTHS), axis=-1)
    # As for the kinoform: 2 / pi^2 for each jump and reach.
    np.testing.assert_allclose(total, 1.0, atol=1.01 * 2.0 * 6.0 / (np.pi**2 * reach))


def test_one_straight_piece_is_the_continuous_kinoform() -> None:
    line = Segments(np.array((0.0, 1.0)), np.zeros(1), np.ones(1))
    np.testing.assert_allclose(
        line.amplitude(ORDERS, DEPTHS), Sawtooth().amplitude(ORDERS, DEPTHS), atol=ROUNDING
    )


@pytest.mark.parametrize("levels", [2, 3, 8, 100])
def test_equal_steps_are_the_kinoform_and_its_pieces(levels: int) -> None:
    """By the transform, by the sum over pieces, and by the closed form."""
    stairs = Steps((np.arange(levels) + 0.5) / levels)
    closed = Sawtooth(levels).amplitude(ORDERS, DEPTHS)
    np.testing.assert_allclose(stairs.amplitude(ORDERS, DEPTHS), closed, atol=ROUNDING)
    np.testing.assert_allclose(stairs.segments().amplitude(ORDERS, DEPTHS), closed, atol=ROUNDING)


def test_transform_and_pieces_agree_in_blocks(rng: np.random.Generator) -> None:
    """More numbers than one block of work, in shapes that broadcast both ways."""
    stairs = Steps(rng.uniform(0.0, 1.0, 4096))
    orders, depths = np.array([[0], [3], [-5000]]), rng.uniform(0.0, 5.0, (300, 1, 1))
    found = stairs.amplitude(orders, depths)
    assert found.shape == (300, 3, 1)
    expected = stairs.segments().amplitude(orders, depths)
    # The transform of 4096 numbers, and phases of 5000 periods.
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_multiples_of_the_steps_get_exactly_nothing() -> None:
    stairs = Steps(HEIGHTS)
    assert not stairs.efficiency(6 * np.array([-3, -1, 1, 2]), DEPTHS).any()
    assert stairs.efficiency(0, 0.0) == pytest.approx(1.0, abs=ROUNDING)


def test_half_duty_has_exactly_no_even_orders() -> None:
    assert not Binary(0.5).efficiency(np.array([-4, -2, 2, 6]), DEPTHS).any()
    assert Binary(0.5).efficiency(0, 0.5) == 0.0


def test_half_duty_is_the_relief_of_two_levels_at_twice_the_depth() -> None:
    """Its two levels lie at 1/4 and 3/4 of alpha."""
    found = Binary(0.5).efficiency(ORDERS, 0.5 * DEPTHS)
    np.testing.assert_allclose(found, Sawtooth(2).efficiency(ORDERS, DEPTHS), atol=ROUNDING)


def test_bessel_against_fifty_digits() -> None:
    with mp.workdps(50):
        for order in (0, 1, -1, 2, 7, -30, 100):
            for z in (0.0, 1e-9, 9.99e-4, 1e-3, 0.3, 1.84118, 20.0, 62.8, -3.0, 314.0):
                expected, found = mp.besselj(order, mpf(z)), float(bessel_j(order, z))
                if abs(expected) < mpf("1e-290"):
                    assert abs(found) < 1e-280
                    continue
                # Near a zero in z, the rounding of the recurrence against its largest members.
                assert abs(found - expected) < 1e-13 * max(abs(expected), mpf("0.02")), (order, z)
                if abs(order) >= abs(z):
                    assert abs(found / expected - 1) < 1e-12, (order, z)


def test_bessel_of_nan_is_nan_alone() -> None:
    assert np.isnan(bessel_j(1, [np.nan, 0.5, 0.0])).tolist() == [True, False, False]


@pytest.mark.parametrize("profile", [Sinusoid(), Binary(0.3), triangle(0.3), Sawtooth()])
def test_flat_relief_leaves_the_light_alone(profile: Profile) -> None:
    power = profile.efficiency(ORDERS, 0.0)
    np.testing.assert_allclose(power, np.where(ORDERS == 0, 1.0, 0.0), atol=ROUNDING)


@pytest.mark.parametrize("offset", [0.0, 1e-12, -1e-9, 1e-6, -1e-3])
def test_singular_points_of_a_triangle(offset: float) -> None:
    """alpha at m / 2, where each piece is a sinc at 0 or at a whole number."""
    with mp.workdps(50):
        for order in (0, 1, 2, 5, -4):
            alpha = abs(order) / 2 + offset
            x, y = mpf(alpha) - mpf(order) / 2, mpf(alpha) + mpf(order) / 2
            parts = [mpf(1) if p == 0 else mp.sinpi(p) / (mp.pi * p) for p in (x, y)]
            expected = ((parts[0] + (-1) ** order * parts[1]) / 2) ** 2
            found = float(triangle(0.5).efficiency(order, alpha))
            assert abs(found - expected) < ROUNDING
