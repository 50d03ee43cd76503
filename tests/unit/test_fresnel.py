# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fresnel reflectance: textbook limits, reciprocity, exactness."""

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.fresnel import reflectance_p, reflectance_s, reflectance_unpolarised

RELATIVE = 1e-13
"""A dozen roundings; the smallest cosines are met through 1 - cos."""


def exact(cosine: float, n_in: float, n_out: float) -> tuple[mpf, mpf]:
    c, n, k = mpf(cosine), mpf(n_in), mpf(n_out)
    squared = 1 - (n / k) ** 2 * (1 - c**2)
    if squared < 0:
        return mpf(1), mpf(1)
    out = mp.sqrt(squared)
    r_s = (n * c - k * out) / (n * c + k * out)
    r_p = (k * c - n * out) / (k * c + n * out)
    return r_s**2, r_p**2


def test_meets_50_digits(rng: np.random.Generator) -> None:
    cosines = np.concatenate([rng.uniform(0, 1, 200), 10.0 ** rng.uniform(-8, 0, 100)])
    n_in = rng.uniform(1.0, 2.0, 300)
    n_out = np.where(rng.random(300) < 0.3, n_in * (1 + 1e-7), rng.uniform(1.0, 2.0, 300))
    answers_s = reflectance_s(cosines, n_in, n_out)
    answers_p = reflectance_p(cosines, n_in, n_out)
    with mp.workdps(50):
        for row, case in enumerate(zip(cosines, n_in, n_out, strict=True)):
            expected_s, expected_p = exact(*map(float, case))
            assert abs(answers_s[row] - expected_s) <= RELATIVE * expected_s
            # r_p passes through 0 at Brewster's angle; there the bound is absolute in r_p / r_s.
            slack = RELATIVE * mp.sqrt(expected_p * expected_s) + RELATIVE * expected_p
            assert abs(answers_p[row] - expected_p) <= slack + RELATIVE**2


def test_normal_incidence() -> None:
    assert reflectance_unpolarised(1.0, 1.0, 1.5) == pytest.approx(0.04, rel=RELATIVE)
    assert reflectance_unpolarised(1.0, 1.5, 1.0) == pytest.approx(0.04, rel=RELATIVE)


def test_brewster_angle() -> None:
    cosine = np.cos(np.arctan(1.5))
    assert reflectance_p(cosine, 1.0, 1.5) < RELATIVE**2
    assert reflectance_s(cosine, 1.0, 1.5) == pytest.approx((1.25 / 3.25) ** 2, rel=RELATIVE)


def test_grazing_and_beyond_the_critical_angle() -> None:
    for law in (reflectance_s, reflectance_p, reflectance_unpolarised):
        assert law(0.0, 1.0, 1.5) == pytest.approx(1.0, rel=RELATIVE)
        assert law(np.cos(np.radians(42.0)), 1.5, 1.0) == 1.0
        assert law(np.cos(np.radians(41.7)), 1.5, 1.0) < 1.0
        np.testing.assert_array_equal(law([0.0, 0.5, 1.0], 1.5, 1.5), 0.0)


def test_reciprocity_range_and_mean(rng: np.random.Generator) -> None:
    cos_in = rng.uniform(0.0, 1.0, 500)
    n_in, n_out = rng.uniform(1.0, 1.5, 500), rng.uniform(1.5, 2.0, 500)
    cos_out = np.sqrt(1.0 - (n_in / n_out) ** 2 * (1.0 - cos_in**2))
    there = reflectance_unpolarised(cos_in, n_in, n_out)
    np.testing.assert_allclose(there, reflectance_unpolarised(cos_out, n_out, n_in), rtol=1e-9)
    assert ((there >= 0.0) & (there <= 1.0)).all()
    s, p = reflectance_s(cos_in, n_in, n_out), reflectance_p(cos_in, n_in, n_out)
    np.testing.assert_allclose(there, 0.5 * (s + p), rtol=RELATIVE)
    np.testing.assert_array_equal(there, reflectance_unpolarised(-cos_in, n_in, n_out))


@pytest.mark.parametrize("shape", [(), (6,), (2, 3), (2, 3, 1)])
def test_shapes(shape: tuple[int, ...]) -> None:
    assert reflectance_unpolarised(np.full(shape, 0.5), 1.0, 1.5).shape == shape


def test_nan_stays_nan() -> None:
    assert np.isnan(reflectance_unpolarised([np.nan, 0.5], 1.0, 1.5)).tolist() == [True, False]
