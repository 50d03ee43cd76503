# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions of the core against mpmath: value and gradient of every kind."""

import math
from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from hoe_addon.core.arrays import dot
from hoe_addon.core.characteristic import (
    EvenRadial,
    FormulaPattern,
    LinearGrating,
    PlanarPattern,
    Polynomial,
    RadialGrating,
    SplinePattern,
    Zernike,
    ZernikeTerm,
)
from hoe_addon.core.characteristic.zernike import fringe, noll
from hoe_addon.core.errors import SpecError
from hoe_addon.core.formula import Formula
from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.spline import Spline2D

WAVELENGTH = 532e-9
REACH = 9e-3
RADIUS = 0.013

RELATIVE = 2e-13
"""Some hundred roundings of float64, relative to the size of the terms."""

HIGH_DEGREE = 1e-11
"""Degree 60 has slopes of 60^2 at the rim, and its recurrence 30 steps."""

READ_OUT = 1e-12
"""rad: the ray law forth and back again, some thousand roundings."""

DIGITS = 40

EVEN = EvenRadial(wavelength=WAVELENGTH, coefficients=(-3e-4, 2e-5, 1e-6, -4e-7), radius=RADIUS)
POLYNOMIAL = Polynomial(
    wavelength=WAVELENGTH,
    coefficients={(0, 0): 1.0, (1, 0): 2e-4, (2, 3): -3e-4, (0, 5): 1e-4, (7, 1): 5e-4},
    radius=RADIUS,
)
ZERNIKE = Zernike(
    wavelength=WAVELENGTH,
    terms=(
        ZernikeTerm(0, 0, 3e-4),
        ZernikeTerm(1, -1, 2e-4),
        ZernikeTerm(2, 0, -4e-4),
        ZernikeTerm(6, 4, 5e-5),
        ZernikeTerm(7, -3, 4e-5),
        ZernikeTerm(8, 0, 1e-5),
    ),
    radius=RADIUS,
)
FORMULA = FormulaPattern(
    wavelength=WAVELENGTH,
    formula=Formula.read("sqrt(100^2+(x-3)^2+y^2)-cos(r/4)"),
    scale=1e-3,
    length=1e-3,
)
SPLINE = SplinePattern(
    wavelength=WAVELENGTH,
    spline=Spline2D.through(
        np.random.default_rng(1).normal(size=(9, 8)) * 1e-4, (-0.01, -0.01), (0.0031, 0.0027)
    ),
)


def exact_even(x: Any, y: Any) -> Any:
    rho = (x * x + y * y) / mp.mpf(RADIUS) ** 2
    return sum(mp.mpf(c) * rho**k for k, c in enumerate(EVEN.coefficients, 1))


def exact_polynomial(x: Any, y: Any) -> Any:
    return sum(
        mp.mpf(c) * (x / mp.mpf(RADIUS)) ** i * (y / mp.mpf(RADIUS)) ** j
        for (i, j), c in POLYNOMIAL.coefficients.items()
    )


def exact_term(term: ZernikeTerm, x: Any, y: Any, radius: float = RADIUS) -> Any:
    """By the factorials of the textbook, which lose all digits in floats but not here."""
    rho, phi, m = mp.hypot(x, y) / mp.mpf(radius), mp.atan2(y, x), abs(term.m)
    radial = mp.mpf(0)
    for k in range((term.n - m) // 2 + 1):
        below = mp.factorial(k) * mp.factorial((term.n + m) // 2 - k)
        below *= mp.factorial((term.n - m) // 2 - k)
        radial += (-1) ** k * mp.factorial(term.n - k) / below * rho ** (term.n - 2 * k)
    turn = mp.cos(m * phi) if term.m >= 0 else mp.sin(m * phi)
    return mp.mpf(term.amplitude) * radial * turn


def exact_zernike(x: Any, y: Any) -> Any:
    return sum(exact_term(term, x, y) for term in ZERNIKE.terms)


def exact_formula(x: Any, y: Any) -> Any:
    a, b = 1000 * x, 1000 * y
    return (mp.sqrt(10000 + (a - 3) ** 2 + b**2) - mp.cos(mp.hypot(a, b) / 4)) / 1000


def exact_spline(x: Any, y: Any) -> Any:
    """By the basis function's own pieces, over all coefficients."""

    def basis(t: Any) -> Any:
        t = abs(t)
        if t >= 2:
            return mp.mpf(0)
        return (2 - t) ** 3 / 6 if t >= 1 else mp.mpf(2) / 3 - t * t + t**3 / 2

    spline = SPLINE.spline
    return sum(
        mp.mpf(float(value))
        * basis((x - mp.mpf(spline.origin[0])) / mp.mpf(spline.pitch[0]) - i)
        * basis((y - mp.mpf(spline.origin[1])) / mp.mpf(spline.pitch[1]) - j)
        for j, row in enumerate(spline.coefficients)
        for i, value in enumerate(row)
    )


def exact_radial(x: Any, y: Any) -> Any:
    return mp.mpf(WAVELENGTH) * 600000 * mp.hypot(x, y)


KINDS: dict[str, tuple[PlanarPattern, Callable[[Any, Any], Any]]] = {
    "even_radial": (EVEN, exact_even),
    "polynomial": (POLYNOMIAL, exact_polynomial),
    "zernike": (ZERNIKE, exact_zernike),
    "formula": (FORMULA, exact_formula),
    "spline": (SPLINE, exact_spline),
    "radial": (RadialGrating(wavelength=WAVELENGTH, frequency=600e3), exact_radial),
}


def points(rng: np.random.Generator, count: int) -> np.ndarray:
    return np.concatenate(
        (rng.uniform(-REACH, REACH, (count, 2)), rng.uniform(-1e-3, 1e-3, (count, 1))), axis=1
    )


@pytest.mark.parametrize("kind", KINDS)
def test_value_and_gradient_against_mpmath(kind: str, rng: np.random.Generator) -> None:
    pattern, exact = KINDS[kind]
    places = points(rng, 15)
    value, gradient = pattern.function(places), pattern.gradient(places)
    assert gradient.shape == places.shape
    assert np.array_equal(gradient[:, 2], np.zeros(len(places)))
    with mp.workdps(DIGITS):
        for k, (x, y, _) in enumerate(places.tolist()):
            place = (mp.mpf(x), mp.mpf(y))
            assert abs(value[k] - exact(*place)) <= RELATIVE * float(1e-3 + abs(value[k]))
            for axis, order in enumerate(((1, 0), (0, 1))):
                want = mp.diff(exact, place, order)
                assert abs(gradient[k, axis] - want) <= RELATIVE * (1.0 + abs(gradient[k, axis]))


@pytest.mark.parametrize(("n", "m"), [(30, 0), (30, -30), (31, 17), (60, 2), (60, -14), (59, 1)])
def test_high_zernike_degrees_keep_their_digits(n: int, m: int, rng: np.random.Generator) -> None:
    term = ZernikeTerm(n, m, 1.0)
    pattern = Zernike(wavelength=WAVELENGTH, terms=(term,), radius=1.0)
    phi, rho = rng.uniform(0, 2 * np.pi, 12), np.sqrt(rng.uniform(0, 1, 12))
    rho[:2] = 1.0, 1e-9
    places = np.stack((rho * np.cos(phi), rho * np.sin(phi), 0 * rho), axis=-1)
    value, gradient = pattern.function(places), pattern.gradient(places)
    with mp.workdps(80):
        for k, (x, y, _) in enumerate(places.tolist()):
            place = (mp.mpf(x), mp.mpf(y))
            assert abs(value[k] - exact_term(term, *place, 1.0)) < HIGH_DEGREE
            if k == 1:
                continue
            for axis, order in enumerate(((1, 0), (0, 1))):
                want = mp.diff(lambda a, b: exact_term(term, a, b, 1.0), place, order)
                assert abs(gradient[k, axis] - want) < HIGH_DEGREE * n * n


def test_zernike_gradient_is_finite_at_the_origin() -> None:
    for n in range(7):
        for m in range(-n, n + 1, 2):
            pattern = Zernike(wavelength=1.0, terms=(ZernikeTerm(n, m, 1.0),), radius=1.0)
            gradient = pattern.gradient((0.0, 0.0, 0.0))
            assert np.isfinite(gradient).all()
            assert bool(np.any(gradient)) == (abs(m) == 1)


def test_noll_order_is_that_of_the_paper() -> None:
    # Noll (1976), table I: even indices are cosines.
    table = "00 11 1-1 20 2-2 22 3-1 31 3-3 33 40 42 4-2 44 4-4 51 5-1 53 5-3 55 5-5 60"
    assert " ".join(f"{n}{m}" for n, m, _ in map(noll, range(1, 23))) == table
    assert noll(4)[2] == pytest.approx(math.sqrt(3.0))
    assert noll(5)[2] == pytest.approx(math.sqrt(6.0))
    assert len({noll(j)[:2] for j in range(1, 497)}) == 496
    assert noll(496)[0] == 30


def test_noll_polynomials_are_orthonormal() -> None:
    # Exact quadrature: Gauss in rho^2, evenly spaced in the azimuth.
    nodes, weights = np.polynomial.legendre.leggauss(12)
    rho, weights = np.sqrt(0.5 * (nodes + 1.0)), 0.5 * weights
    phi = 2.0 * np.pi * np.arange(32) / 32
    places = np.stack(
        np.broadcast_arrays(rho[:, None] * np.cos(phi), rho[:, None] * np.sin(phi), 0.0), axis=-1
    )
    values = []
    for j in range(1, 46):
        n, m, factor = noll(j)
        term = ZernikeTerm(n, m, factor)
        values.append(Zernike(wavelength=1.0, terms=(term,), radius=1.0).function(places))
    products = np.einsum("iab,jab,a->ij", values, values, weights) / 32
    assert np.allclose(products, np.eye(45), atol=1e-12)


def test_fringe_order_is_that_of_arizona() -> None:
    listed = {
        1: (0, 0),
        2: (1, 1),
        3: (1, -1),
        4: (2, 0),
        5: (2, 2),
        6: (2, -2),
        7: (3, 1),
        8: (3, -1),
        9: (4, 0),
        10: (3, 3),
        11: (3, -3),
        12: (4, 2),
        16: (6, 0),
        17: (4, 4),
        25: (8, 0),
        26: (5, 5),
        35: (9, -1),
        36: (10, 0),
        37: (12, 0),
    }
    assert {j: fringe(j)[:2] for j in listed} == listed
    assert len({fringe(j)[:2] for j in range(1, 38)}) == 37
    for j in range(1, 38):
        n, m, factor = fringe(j)
        phi = 0.0 if m >= 0 else np.pi / 2 / abs(m)
        pattern = Zernike(wavelength=1.0, terms=(ZernikeTerm(n, m, factor),), radius=1.0)
        assert pattern.function((np.cos(phi), np.sin(phi), 0.0)) == pytest.approx(1.0, abs=1e-12)


def test_kinks_and_places_off_the_grid_are_not_recorded() -> None:
    radial, _ = KINDS["radial"]
    assert np.isnan(radial.gradient((0.0, 0.0, 1.0))).all()
    assert radial.function((0.0, 0.0, 1.0)) == 0.0
    assert np.isnan(SPLINE.gradient((0.0118, 0.0, 0.0))).all()
    kink = FormulaPattern(wavelength=1.0, formula=Formula.read("abs(x)+y"), scale=1.0, length=1.0)
    assert np.isnan(kink.gradient((0.0, 0.3, 0.0))).all()


@pytest.mark.parametrize("kind", KINDS)
def test_a_ray_returns_by_the_reverse_order(kind: str, rng: np.random.Generator) -> None:
    pattern, _ = KINDS[kind]
    places = points(rng, 1000)
    gradient = pattern.gradient(places)
    cos = rng.uniform(0.8, 1.0, 1000)
    phi = rng.uniform(0, 2 * np.pi, 1000)
    sin = np.sqrt(1.0 - cos**2)
    ray = np.stack((sin * np.cos(phi), sin * np.sin(phi), cos), axis=-1)
    normal = np.array((0.0, 0.0, 1.0))
    out, status = diffract(ray, normal, gradient, 1, 1.1, 1.0, 1.5, False)
    again, _ = diffract(out, normal, gradient, -1, 1.1, 1.5, 1.0, False)
    back, _ = diffract(-out, normal, gradient, 1, 1.1, 1.5, 1.0, False)
    met = status == Status.OK
    assert met.mean() > 0.5
    assert np.abs(again[met] - ray[met]).max() < READ_OUT
    # Time reversal: the light walked backward obeys the same order.
    assert np.abs(back[met] + ray[met]).max() < READ_OUT
    assert np.abs(dot(out[met], out[met]) - 1.0).max() < READ_OUT


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: LinearGrating((1.0, math.nan)), "frequency: must be two finite numbers"),
        (lambda: RadialGrating(wavelength=0.0, frequency=1.0), "wavelength: must be above 0"),
        (lambda: RadialGrating(wavelength=1.0, frequency=math.inf), "frequency[0]: must be finite"),
        (
            lambda: EvenRadial(wavelength=1.0, coefficients=(1.0, math.nan), radius=1.0),
            "coefficients[1]: must be finite, got nan",
        ),
        (
            lambda: Polynomial(wavelength=1.0, coefficients={(1, 0): 1.0}, radius=-1.0),
            "radius: must be above 0, got -1.0",
        ),
        (lambda: ZernikeTerm(3, 2, 1.0), "m: must be at most n in size, n - m even, got 3, 2"),
        (lambda: ZernikeTerm(1, 3, 1.0), "m: must be at most n in size"),
    ],
)
def test_bad_values_are_refused(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SpecError) as caught:
        make()
    assert str(caught.value).startswith(message)
