# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Luminance and colour of scene-linear pictures."""

import math

import numpy as np
import pytest

from hoe_addon.core.photometry import Photometry, luminance, measure

REC709_LUMINANCE = (0.2126, 0.7152, 0.0722)
"""ITU-R BT.709, printed to four digits."""

REC709_UV = {
    "white": ((1, 1, 1), (0.1978, 0.4683)),
    "red": ((1, 0, 0), (0.4507, 0.5229)),
    "green": ((0, 1, 0), (0.1250, 0.5625)),
    "blue": ((0, 0, 1), (0.1754, 0.1579)),
}
"""CIE 1976 u'v' from the chromaticities of ITU-R BT.709, u' = 4x / (-2x + 12y + 3), to 4 digits."""

PRINTED = 6e-5
"""Half a unit of the fourth digit, and the rounding of the primaries' own digits."""


def test_luminance_of_the_primaries() -> None:
    np.testing.assert_allclose(luminance(np.eye(3), 1.0), REC709_LUMINANCE, atol=PRINTED)


def test_white_has_the_luminance_of_the_unit() -> None:
    assert float(luminance(np.ones(3), 123.0)) == pytest.approx(123.0, rel=1e-12)


def test_luminance_is_linear_and_keeps_the_shape(rng: np.random.Generator) -> None:
    pixels = rng.uniform(-0.1, 2.0, size=(4, 5, 3))
    one = luminance(pixels, 1.0)
    assert one.shape == (4, 5)
    np.testing.assert_allclose(luminance(3.0 * pixels, 50.0), 150.0 * one, rtol=1e-12)


def test_single_precision_pictures_are_summed_in_double() -> None:
    """A mean of 10^6 equal float32 values is that value, to float64."""
    pixels = np.full((1000, 1000, 3), 0.1, dtype=np.float32)
    value = float(np.float32(0.1))
    assert measure(pixels, 1.0).mean_cd_m2 == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("name", REC709_UV)
def test_colour_of_a_plain_picture(name: str) -> None:
    rgb, wanted = REC709_UV[name]
    found = measure(np.broadcast_to(np.array(rgb, dtype=np.float64), (2, 3, 3)), 100.0)
    assert (found.u_prime, found.v_prime) == pytest.approx(wanted, abs=PRINTED)
    assert found.uniformity == pytest.approx(1.0, rel=1e-12)


def test_mean_least_and_greatest(rng: np.random.Generator) -> None:
    pixels = rng.uniform(0.0, 1.0, size=(7, 9, 3))
    found, values = measure(pixels, 100.0), luminance(pixels, 100.0)
    assert found.mean_cd_m2 == pytest.approx(values.mean())
    assert (found.min_cd_m2, found.peak_cd_m2) == (values.min(), values.max())
    assert found.uniformity == found.min_cd_m2 / found.peak_cd_m2


def test_colour_is_that_of_the_mean_light() -> None:
    """Bright red and dark blue: the colour of their sum, not the mean of two colours."""
    pixels = np.array([[9.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    both, mixed = measure(pixels, 1.0), measure(pixels.sum(axis=0, keepdims=True), 1.0)
    assert (both.u_prime, both.v_prime) == pytest.approx((mixed.u_prime, mixed.v_prime))


def test_a_part_of_a_picture_is_a_list_of_pixels(rng: np.random.Generator) -> None:
    pixels = rng.uniform(size=(6, 6, 3))
    mask = np.zeros((6, 6), dtype=np.bool_)
    mask[2:4, 1:5] = True
    assert measure(pixels[mask], 1.0) == measure(pixels[2:4, 1:5], 1.0)


def test_black_has_no_colour_and_no_uniformity() -> None:
    found = measure(np.zeros((2, 2, 3)), 100.0)
    assert (found.mean_cd_m2, found.peak_cd_m2) == (0.0, 0.0)
    assert math.isnan(found.u_prime)
    assert math.isnan(found.v_prime)
    assert found.uniformity == 0.0


def test_uniformity_of_given_numbers() -> None:
    assert Photometry(5.0, 2.0, 8.0, 0.2, 0.5).uniformity == 0.25
