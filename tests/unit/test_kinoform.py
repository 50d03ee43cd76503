# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinoform orders against 50 digits, a numerical Fourier integral, and the sum rule."""

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core import media
from hoe_addon.core.efficiency.kinoform import amplitude, efficiency, phase_depth
from hoe_addon.core.errors import SpecError

RELATIVE = 1e-13
"""Ten roundings of sine, quotient and square."""
LEVELS = [0, 2, 3, 4, 5, 7, 8, 16, 63, 256, 1024]
OFFSETS = [0.0, *(sign * 10.0**-k for k in range(3, 13) for sign in (1, -1))]


def exact(order: int, alpha: float, levels: int) -> mpf:
    """Return the efficiency with 50 digits, from the exact limits at the singular points."""
    x = mpf(alpha) - order

    def sinc(value: mpf) -> mpf:
        return mpf(1) if value == 0 else mp.sinpi(value) / (mp.pi * value)

    if levels == 0:
        return sinc(x) ** 2
    below = levels * mp.sinpi(x / levels)
    kernel = mpf(1) if below == 0 else mp.sinpi(x) / below
    return (sinc(mpf(order) / levels) * kernel) ** 2


def check(order: int, alpha: float, levels: int) -> None:
    expected = exact(order, alpha, levels)
    answer = float(efficiency(order, alpha, levels))
    if expected == 0:
        assert answer == 0.0, (order, alpha, levels)
    else:
        assert abs(answer / expected - 1) < RELATIVE, (order, alpha, levels)


@pytest.mark.parametrize("levels", LEVELS)
def test_near_each_removable_singularity(levels: int) -> None:
    period = levels or 4
    orders = {0, 1, -1, 2, -3, period, -period, 2 * period, period + 1, 1 - period}
    with mp.workdps(50):
        for order in sorted(orders):
            for turns in (0, 1, -1, 2):
                for offset in OFFSETS:
                    check(order, order + turns * period + offset, levels)


@pytest.mark.parametrize("levels", LEVELS)
def test_random_depths_up_to_twenty(levels: int, rng: np.random.Generator) -> None:
    orders = rng.integers(-40, 41, 300)
    depths = rng.uniform(0.0, 20.0, 300)
    with mp.workdps(50):
        for order, alpha in zip(orders, depths, strict=True):
            check(int(order), float(alpha), levels)


def test_whole_depths_near_every_order(rng: np.random.Generator) -> None:
    """The rest of alpha is taken before the order: alpha - m alone would round it away."""
    with mp.workdps(50):
        for order in (-7, 0, 1, 9, 1000):
            for offset in OFFSETS:
                for whole in (0, 1, 2, 8, 20):
                    check(order, whole + offset, 0)
                    check(order, whole + offset, 8)


@pytest.mark.parametrize("levels", [2, 3, 8, 1024])
def test_multiples_of_the_levels_carry_exactly_nothing(levels: int) -> None:
    turns = np.array([-5, -1, 1, 2, 7])
    assert not efficiency(turns * levels, np.linspace(0.0, 20.0, 101)[:, None], levels).any()


def test_design_depth_is_exact() -> None:
    assert efficiency(1, 1.0, 0) == 1.0
    assert efficiency([0, 2, -1], 1.0, 0).tolist() == [0.0, 0.0, 0.0]
    assert efficiency(0, 0.0, 8) == 1.0


@pytest.mark.parametrize("levels", [0, 2, 3, 8, 17])
@pytest.mark.parametrize("alpha", [0.0, 0.3, 1.0, 1.7, 8.0, 12.4])
def test_all_orders_sum_to_one(levels: int, alpha: float) -> None:
    reach = 200_000
    total = float(np.sum(efficiency(np.arange(-reach, reach + 1), alpha, levels)))
    # A jump of height h <= 2 adds h / (2 pi m): the orders left out carry, over both tails,
    # at most 2 / pi^2 per jump and per reach. One period has one jump per level.
    assert abs(total - 1.0) < 1.01 * 2.0 * max(levels, 1) / (np.pi**2 * reach)


@pytest.mark.parametrize("levels", [0, 2, 3, 4, 8, 9])
def test_amplitude_is_the_fourier_integral(levels: int) -> None:
    """The phase is that of steps sampled at their middle."""
    samples = 20_160  # a multiple of each number of levels: the jumps fall between samples
    place = (np.arange(samples) + 0.5) / samples
    step = place if levels == 0 else (np.floor(place * levels) + 0.5) / levels
    cut_off = 2e-6  # midpoint rule: (2 pi (|m| + alpha) / samples)^2 / 24 at |m| + alpha = 20
    for alpha in (0.0, 0.4, 1.0, 2.3, 7.5):
        for order in range(-9, 10):
            integral = np.mean(np.exp(2j * np.pi * (alpha * step - order * place)))
            assert abs(amplitude(order, alpha, levels) - integral) < cut_off


def test_staircase_from_level_zero_differs_by_a_phase_without_order() -> None:
    samples, levels, alpha = 20_160, 4, 0.7
    place = (np.arange(samples) + 0.5) / samples
    step = np.floor(place * levels) / levels
    orders = np.arange(-5, 6)
    waves = np.exp(2j * np.pi * (alpha * step - orders[:, None] * place))
    expected = amplitude(orders, alpha, levels) * np.exp(-1j * np.pi * alpha / levels)
    np.testing.assert_allclose(np.mean(waves, axis=1), expected, atol=2e-6)


def test_amplitude_and_efficiency_agree(rng: np.random.Generator) -> None:
    orders, depths = rng.integers(-9, 10, (40, 1)), rng.uniform(-3.0, 20.0, 50)
    for levels in (0, 2, 5, 8):
        power = np.abs(amplitude(orders, depths, levels)) ** 2
        assert power.shape == (40, 50)
        np.testing.assert_allclose(power, efficiency(orders, depths, levels), atol=1e-15)


def test_many_levels_tend_to_the_continuous_relief() -> None:
    orders, depths = np.arange(-3, 5)[:, None], np.linspace(0.0, 4.0, 41)
    # The first correction is of the order of (pi m / N)^2.
    np.testing.assert_allclose(
        amplitude(orders, depths, 4096), amplitude(orders, depths, 0), atol=2e-5
    )


def test_nan_depth_gives_nan() -> None:
    assert np.isnan(efficiency(1, [np.nan, 1.0], 8)).tolist() == [True, False]
    assert np.isnan(efficiency(1, [np.inf, 1.0], 0)).tolist() == [True, False]


@pytest.mark.parametrize("levels", [1, -1, -8])
def test_bad_levels(levels: int) -> None:
    for law in (efficiency, amplitude):
        with pytest.raises(SpecError, match=f"^levels: must be .* got {levels}$"):
            law(1, 1.0, levels)


def test_phase_depth_without_dispersion() -> None:
    depth = phase_depth(np.array([550e-9, 275e-9]), 550e-9, media.constant(1.5))
    np.testing.assert_allclose(depth, [1.0, 2.0], rtol=RELATIVE)


def test_phase_depth_with_dispersion() -> None:
    glass = media.by_name("fused silica")
    wavelengths = np.array([450e-9, 532e-9, 633e-9])
    rise = (glass.index(wavelengths) - 1.0) / (float(glass.index(532e-9)) - 1.0)
    depth = phase_depth(wavelengths, 532e-9, glass)
    np.testing.assert_allclose(depth, rise * 532e-9 / wavelengths, rtol=RELATIVE)
    assert depth[1] == 1.0


def test_relief_without_a_step_is_refused() -> None:
    with pytest.raises(SpecError, match=r"^relief: index must not be 1 at the design wavelength"):
        phase_depth(532e-9, 532e-9, media.by_name("air"))


def oblique(index: float, t: float) -> mpf:
    """Phase depth at the design wavelength from the path difference itself, with 50 digits."""
    n, along = mpf(index), mpf(t)
    air = mp.sqrt(1 - along**2) if along < 1 else mpf(0)
    return (mp.sqrt(n**2 - along**2) - air) / (n - 1)


@pytest.mark.parametrize("index", [1.0001, 1.5, 2.4])
def test_oblique_depth_is_the_path_difference(index: float) -> None:
    beyond = 0.5 * (1.0 + index)
    with mp.workdps(50):
        for t in (0.0, 1e-8, 0.1, 0.7, 0.999, 1.0 - 1e-9, 1.0, beyond):
            depth = float(phase_depth(532e-9, 532e-9, media.constant(index), [0.6 * t, 0.8 * t]))
            along = float(np.hypot(0.6 * t, 0.8 * t))
            # A rounding of t moves the small root of air, or of the relief, by t / root of it.
            root = min(abs(1 - along**2), abs(index**2 - along**2)) ** 0.5
            allowed = RELATIVE / (index - 1.0) * (1.0 + 1e-3 / max(root, 1e-8))
            assert abs(depth - oblique(index, along)) < allowed, (index, t)


def test_along_the_normal_nothing_changes() -> None:
    glass = media.by_name("fused silica")
    wavelengths = np.linspace(400e-9, 700e-9, 31)
    straight = phase_depth(wavelengths, 532e-9, glass)
    found = phase_depth(wavelengths, 532e-9, glass, np.zeros((31, 2)))
    np.testing.assert_array_equal(found, straight)


def test_depth_grows_with_the_angle_and_goes_to_0_beyond_the_relief() -> None:
    relief = media.constant(1.5)
    t = np.array([0.0, 0.3, 0.6, 0.9, 1.0])
    depth = phase_depth(532e-9, 532e-9, relief, np.stack((t, 0.0 * t), axis=-1))
    assert np.all(np.diff(depth) > 0.0)
    assert phase_depth(532e-9, 532e-9, relief, [1.4999, 0.0]) < 0.05
    assert phase_depth(532e-9, 532e-9, relief, [0.0, 1.6]) == 0.0


def test_oblique_light_does_not_mend_a_relief_without_a_step() -> None:
    with pytest.raises(SpecError, match=r"^relief: index must not be 1 at the design wavelength"):
        phase_depth(532e-9, 532e-9, media.by_name("air"), [0.5, 0.0])


@pytest.mark.parametrize("levels", [0, 2, 3, 8, 9])
@pytest.mark.parametrize("share", [0.25, 1.0])
def test_walls_are_the_fourier_integral_of_straight_lines(levels: int, share: float) -> None:
    """Against the box average of the profile, sampled: an integral that knows no formula."""
    samples = 20_160
    width = share / (levels or 10)
    place = (np.arange(samples) + 0.5) / samples
    step = place if levels == 0 else (np.floor(place * levels) + 0.5) / levels
    span = round(width * samples)
    kernel = np.zeros(samples)
    kernel[np.arange(-(span // 2), span - span // 2)] = 1.0 / span
    smooth = np.fft.irfft(np.fft.rfft(step) * np.fft.rfft(kernel), samples)
    orders = np.arange(-9, 10)
    for alpha in (0.4, 1.0, 2.3):
        waves = np.exp(2j * np.pi * (alpha * smooth - orders[:, None] * place))
        found = amplitude(orders, alpha, levels, span / samples)
        # An even or odd number of samples in the box shifts it by half a sample at most.
        assert np.max(np.abs(found - np.mean(waves, axis=1))) < 2.0 * np.pi * 11.3 / samples
        np.testing.assert_allclose(
            np.abs(found) ** 2, efficiency(orders, alpha, levels, span / samples), atol=1e-14
        )
