# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of fabrication and profiles of thin reliefs against the laws that are published."""

import numpy as np
import pytest

from hoe_addon.core.efficiency import Incidence
from hoe_addon.core.efficiency.fabrication import mask_count, mask_segments, mask_steps, with_walls
from hoe_addon.core.efficiency.profiles import Binary, Sawtooth, Sinusoid
from hoe_addon.core.efficiency.relief import Kinoform
from hoe_addon.core.efficiency.segments import Segments, triangle
from hoe_addon.core.media import constant
from hoe_addon.core.orders import Branch

ROUNDING = 1e-13
"""Sums of up to a few hundred pieces with walls that are differences over a width of 0.01."""

ORDERS = np.arange(-12, 13)
DEPTHS = np.array([0.2, 0.5, 1.0, 1.3, 4.75])[:, None]


def sinc(x: object) -> np.ndarray:
    return np.sinc(np.asarray(x, dtype=np.float64))


@pytest.mark.parametrize("error", [-0.2, -0.05, 0.0, 0.01, 0.1])
def test_depth_error_of_a_blazed_relief(error: float) -> None:
    """sinc(1 - (1 + e))^2 in the first order at the design wavelength."""
    found = Sawtooth().efficiency(1, 1.0 + error)
    assert found == pytest.approx(float(sinc(error)) ** 2, abs=ROUNDING)


@pytest.mark.parametrize("width", [0.01, 0.1, 0.3])
def test_flyback_leaves_the_square_of_what_is_not_flyback(width: float) -> None:
    """McManamon et al. (1996)."""
    assert Sawtooth(0, width).efficiency(1, 1.0) == pytest.approx((1.0 - width) ** 2, abs=ROUNDING)


@pytest.mark.parametrize("levels", [2, 4, 16])
def test_walls_of_a_staircase_by_two_ways(levels: int) -> None:
    width = 0.4 / levels
    pieces = with_walls(mask_steps(levels, ()).segments(), width)
    assert pieces.pieces == 2 * levels
    closed = Sawtooth(levels, width).amplitude(ORDERS, DEPTHS)
    np.testing.assert_allclose(pieces.amplitude(ORDERS, DEPTHS), closed, atol=ROUNDING)


@pytest.mark.parametrize("errors", [(0.1,), (0.05, -0.1), (0.02, 0.0, 0.3), (-0.1, 0.1, 0.2, -0.3)])
def test_etch_errors_are_a_product_of_cosines(errors: tuple[float, ...]) -> None:
    """Each mask is a binary grating; their lines are whole fractions of each other."""
    levels = 2 ** len(errors)
    product = sinc(ORDERS / levels) ** 2 * np.ones((len(DEPTHS), 1))
    for place, error in enumerate(errors):
        share = 0.5 ** (place + 1)
        product = product * np.cos(np.pi * share * (DEPTHS * (1.0 + error) - ORDERS)) ** 2
    found = mask_steps(levels, errors).efficiency(ORDERS, DEPTHS)
    np.testing.assert_allclose(found, product, atol=ROUNDING)
    multiples = ORDERS[(ORDERS % levels == 0) & (ORDERS != 0)]
    assert not mask_steps(levels, errors).efficiency(multiples, DEPTHS).any()


def test_small_etch_errors_add_up_in_squares() -> None:
    errors = np.array((1e-3, -2e-3, 4e-3))
    loss = np.sum((np.pi * errors * 0.5 ** np.arange(1, 4)) ** 2)
    ideal = float(Sawtooth(8).efficiency(1, 1.0))
    found = float(mask_steps(8, tuple(errors)).efficiency(1, 1.0))
    # The next term is the square of the loss.
    assert 1.0 - found / ideal == pytest.approx(loss, rel=2.0 * loss + 1e-9)


def test_without_errors_the_masks_make_the_kinoform() -> None:
    for levels in (2, 8, 32):
        closed = Sawtooth(levels).amplitude(ORDERS, DEPTHS)
        for made in (mask_steps(levels, ()), mask_segments(levels, (), 0.0)):
            np.testing.assert_allclose(made.amplitude(ORDERS, DEPTHS), closed, atol=ROUNDING)


@pytest.mark.parametrize("error", [-0.2, 0.01, 0.15])
def test_duty_error_of_one_mask_is_a_binary_relief(error: float) -> None:
    """sin(pi d)^2 / pi^2 times 4 sin(pi alpha / 2)^2 in the first order; half a period aside."""
    found = mask_segments(2, (), error).efficiency(ORDERS, DEPTHS)
    expected = Binary(0.5 + error).efficiency(ORDERS, 0.5 * DEPTHS)
    np.testing.assert_allclose(found, expected, atol=ROUNDING)
    first = 4.0 / np.pi**2 * np.cos(np.pi * error) ** 2
    assert mask_segments(2, (), error).efficiency(1, 1.0) == pytest.approx(first, abs=ROUNDING)


@pytest.mark.parametrize("error", [-0.06, 0.05])
def test_duty_error_of_three_masks_is_their_product_wave(error: float) -> None:
    """The three lines one by one on a fine grid: an integral that knows no pieces."""
    samples = 80_000
    place = (np.arange(samples) + 0.5) / samples
    height = np.full(samples, 1.0 / 16.0)
    for mask in range(3):
        line = 0.5 ** (mask + 1)
        from_line = (place - line) % (2.0 * line)
        widened = (from_line < line + error / 2.0) | (from_line > 2.0 * line - error / 2.0)
        kept = (from_line > -error / 2.0) & (from_line < line + error / 2.0)
        height += line * (widened if error > 0.0 else kept)
    found = mask_segments(8, (), error).amplitude(ORDERS, DEPTHS)
    for row, depth in enumerate(DEPTHS[:, 0]):
        waves = np.exp(2j * np.pi * (depth * height - ORDERS[:, None] * place))
        # 14 edges, each found within half a sample.
        np.testing.assert_allclose(found[row], np.mean(waves, axis=1), atol=14.0 / samples)


@pytest.mark.parametrize("duty", [0.5, 0.2])
def test_walls_of_a_ridge_are_a_trapezoid(duty: float) -> None:
    width = 0.1
    lower, upper = 0.5 - duty / 2.0, 0.5 + duty / 2.0
    edges = np.array((lower - 0.05, lower + 0.05, upper - 0.05, upper + 0.05, lower + 0.95))
    trapezoid = Segments(edges, np.array((0.0, 1.0, 1.0, 0.0)), np.array((1.0, 1.0, 0.0, 0.0)))
    found = with_walls(Binary(duty).segments(), width).amplitude(ORDERS, DEPTHS)
    np.testing.assert_allclose(found, trapezoid.amplitude(ORDERS, DEPTHS), atol=ROUNDING)


def test_walls_keep_the_mean_height_even_where_they_meet() -> None:
    """Walls wider than a ridge: the average over the width still holds all of it."""
    ridge = Binary(0.1).segments()
    smooth = with_walls(ridge, 0.4)
    assert np.sum(smooth.width * smooth.height) == pytest.approx(0.1, abs=ROUNDING)
    assert smooth.height.max() == pytest.approx(0.25, abs=ROUNDING)


def test_number_of_masks() -> None:
    assert [mask_count(levels) for levels in (0, 2, 3, 4, 6, 8, 1024)] == [
        *(None, 1, None, 2, None, 3, 10)
    ]


def test_sinusoid_at_its_best() -> None:
    """J_1(phi)^2 is at most .338567, at phi = 1.84118; phi is half the whole phase depth."""
    depths = np.linspace(0.0, 2.0, 200_001)
    first = Sinusoid().efficiency(1, depths)
    assert np.max(first) == pytest.approx(0.338567, abs=5e-7)
    assert np.pi * depths[np.argmax(first)] == pytest.approx(1.84118, abs=2e-5)


def test_triangle_has_the_published_first_order() -> None:
    """Magnusson and Gaylord (1978), their quotient written as two sinc without a pole."""
    signs = np.where(ORDERS % 2 == 0, 1.0, -1.0)
    expected = (sinc(DEPTHS - ORDERS / 2.0) + signs * sinc(DEPTHS + ORDERS / 2.0)) / 2.0
    found = triangle(0.5).efficiency(ORDERS, DEPTHS)
    np.testing.assert_allclose(found, expected**2, atol=ROUNDING)


def light(theta_deg: np.ndarray, index: float) -> Incidence:
    """Light in the plane of the grating vector, from a medium behind it."""
    along = index * np.sin(np.radians(theta_deg))
    one = np.ones(along.shape)
    return Incidence(
        wavelength=550e-9 * one,
        tangential=np.stack((along, 0.0 * along), axis=-1),
        from_front=one < 0.0,
        index_back=index * one,
        index_front=one,
        frequency=1e5 * one,
        place=np.zeros((*along.shape, 2)),
    )


def test_tilted_relief_is_too_deep() -> None:
    """n cos theta' - cos theta of a glass relief: at 45 degrees in air 1.2315 of the depth."""
    model = Kinoform(Sawtooth(), 550e-9, constant(1.5))
    found = model.phase_depth(light(np.array([0.0, 45.0]), 1.0))
    expected = (np.sqrt(1.5**2 - 0.5) - np.sqrt(0.5)) / 0.5
    assert found[0] == 1.0
    assert found[1] == pytest.approx(expected, abs=ROUNDING)
    shares = model.shares((Branch(1), Branch(1, reflected=True)), light(np.array([45.0]), 1.0))
    assert shares[0, 0] == pytest.approx(float(sinc(expected - 1.0)) ** 2, abs=ROUNDING)
    assert shares[0, 1] == 0.0


def test_the_side_that_the_light_comes_from_does_not_matter() -> None:
    """The same light in glass and, refracted, in air."""
    model = Kinoform(Sawtooth(8), 550e-9, constant(1.5), depth=1.1)
    theta = np.array([-60.0, 5.0, 30.0])
    in_glass = np.degrees(np.arcsin(np.sin(np.radians(theta)) / 1.5))
    branches = tuple(Branch(order) for order in range(-3, 4))
    np.testing.assert_allclose(
        model.shares(branches, light(theta, 1.0)),
        model.shares(branches, light(in_glass, 1.5)),
        atol=ROUNDING,
    )


def test_amplitudes_and_shares_agree_and_the_switch_works() -> None:
    branches = (Branch(0), Branch(1), Branch(2, reflected=True))
    for angle_dependent in (True, False):
        model = Kinoform(Sawtooth(4), 550e-9, constant(1.5), angle_dependent=angle_dependent)
        tilted = light(np.array([0.0, 50.0]), 1.0)
        power = np.abs(model.amplitudes(branches, tilted)) ** 2
        np.testing.assert_allclose(power, model.shares(branches, tilted), atol=ROUNDING)
        assert (power[0, 1] == power[1, 1]) == (not angle_dependent)
