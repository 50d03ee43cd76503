# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin reliefs where their formulas divide zero by zero: numpy and Cycles against 50 digits."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

from hoe_addon.core.efficiency import kinoform
from hoe_addon.core.efficiency.profiles import Binary, Sinusoid
from tests.hard_cases.osl_values import values_of

DIGITS = 50

RELATIVE = 1e-13
"""Double precision: ten roundings of sine, quotient and square, 1e-16 each, of which those of a
small share count in full."""

RELATIVE_OSL = 2e-6
"""float32: some 30 roundings of 6e-8. The promise to the user is 2e-5."""

SMALLEST = 1e-36
"""Shares below this are subnormal in float32, or squares of what is: they have fewer digits."""

ABSOLUTE = 1e-13
"""Sums of phases of up to 20 waves: 125 rad times 1e-16, a few times."""

ABSOLUTE_OSL = 2e-6
"""The same in float32: a phase of 20 waves is rounded by 1e-6 in single pieces of the sum."""

DEEPEST = 20.0
LEVELS = (0, 2, 3, 4, 5, 7, 8, 16, 17, 63, 64, 100, 255, 256, 511, 512, 1000, 1023, 1024)
OFFSETS = (0.0, *(sign * 10.0**-k for k in range(3, 13) for sign in (1, -1)))
TURNS = (0, 1, -1, 2, 5)

type Row = tuple[float, float, float]
"""Order, phase depth in waves, and levels or what else the profile has."""


def sinc(x: mpf) -> mpf:
    return mpf(1) if x == 0 else mp.sinpi(x) / (mp.pi * x)


def upright(order: int, alpha: float, levels: float) -> mpf:
    """The formula as it is printed, its limits taken by hand."""
    x = mpf(alpha) - order
    if levels == 0:
        return sinc(x) ** 2
    below = levels * mp.sinpi(x / levels)
    kernel = mpf(1) if below == 0 else mp.sinpi(x) / below
    return (sinc(mpf(order) / levels) * kernel) ** 2


def line_integral(order: int, alpha: float, pieces: Iterable[tuple[mpf, mpf, mpf]]) -> mpf:
    """|D_m|^2 of straight pieces (width, height at the begin, rise) that follow one another."""
    total, begin = mp.mpc(0), mpf(0)
    for width, height, rise in pieces:
        turns = alpha * (height + rise / 2) - order * (begin + width / 2)
        total += width * sinc(alpha * rise - order * width) * mp.expjpi(2 * turns)
        begin += width
    return abs(total) ** 2


def walled(levels: int, width: float) -> Callable[[int, float, float], mpf]:
    def exact(order: int, alpha: float, _: float) -> mpf:
        wall = mpf(width)
        if levels == 0:
            pieces = [(1 - wall, mpf(0), 1 - wall), (wall, 1 - wall, wall - 1)]
        else:
            step = mpf(1) / levels
            pieces = []
            for k in range(levels):
                rise = step if k < levels - 1 else -k * step
                pieces += [(step - wall, k * step, mpf(0)), (wall, k * step, rise)]
        return line_integral(order, mpf(alpha), pieces)

    return exact


def binary(order: int, alpha: float, duty: float) -> mpf:
    share = mpf(duty)
    pieces = [(share, mpf(1), mpf(0)), (1 - share, mpf(0), mpf(0))]
    return line_integral(order, mpf(alpha), pieces)


def sinusoid(order: int, alpha: float, _: float) -> mpf:
    return mp.besselj(order, mp.pi * mpf(alpha)) ** 2


@dataclass(frozen=True)
class Case:
    """Rows and the three ways to their shares; `relative` where every share has all its digits."""

    rows: list[Row]
    exact: Callable[[int, float, float], mpf]
    numpy: Callable[[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]], Any]
    osl: str
    relative: bool = False


def by_level(
    orders: NDArray[np.int64], alphas: NDArray[np.float64], levels: NDArray[np.float64]
) -> NDArray[np.float64]:
    found = np.zeros(len(orders))
    for count in np.unique(levels):
        chosen = levels == count
        found[chosen] = kinoform.efficiency(orders[chosen], alphas[chosen], int(count))
    return found


def kept(rows: Iterable[Row]) -> list[Row]:
    """Depths as float32 has them, at most twenty waves, each row once."""
    known = {(m, float(np.float32(alpha)), n) for m, alpha, n in rows}
    return sorted(row for row in known if abs(row[1]) <= DEEPEST)


def at_the_order() -> list[Row]:
    """alpha - m from 0 to 1e-3 on both sides."""
    orders = (0, 1, -1, 2, 3, 8, -13, 16, 20)
    return kept((m, m + e, n) for n in LEVELS for m in orders for e in OFFSETS)


def at_turns() -> list[Row]:
    """alpha - m at multiples of N, with small and with large alpha."""
    wholes = (0, 1, 2, 7, 20)
    return kept(
        (a - k * n, a + e, n) for n in LEVELS[1:] for a in wholes for k in TURNS for e in OFFSETS
    )


def order_zero() -> list[Row]:
    return kept((0, a + e, n) for n in LEVELS for a in range(-20, 21, 4) for e in OFFSETS[::2])


def multiples() -> list[Row]:
    """Orders that are multiples of N carry nothing, but for the order 0."""
    return kept(
        (k * n, a, n) for n in LEVELS[1:] for k in TURNS[1:] for a in np.linspace(0, 20, 23)
    )


def deep() -> list[Row]:
    draw = np.random.default_rng(7)
    return kept(
        (int(m), a, n)
        for n in LEVELS
        for m, a in zip(draw.integers(-40, 41, 60), draw.uniform(0, DEEPEST, 60), strict=True)
    )


def profile_rows(last: float) -> list[Row]:
    orders = (0, 1, -1, 2, 5, -8, 16, 40, -1024)
    wholes = (0.0, 0.5, 1.0, 2.0, 2.5, 8.0, 19.0, 20.0)
    return kept((m, a + e, last) for m in orders for a in wholes for e in OFFSETS[::3])


CASES = {
    "alpha - m = 0 and beside it": Case(
        at_the_order(), upright, by_level, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", True
    ),
    "alpha - m = k N and beside it": Case(
        at_turns(), upright, by_level, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", True
    ),
    "m = 0": Case(
        order_zero(), upright, by_level, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", True
    ),
    "m a multiple of N": Case(
        multiples(), upright, by_level, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", True
    ),
    "alpha up to 20": Case(
        deep(), upright, by_level, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", True
    ),
    "continuous with walls": Case(
        profile_rows(0.0),
        walled(0, 0.07),
        lambda m, a, _: kinoform.efficiency(m, a, 0, 0.07),
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 0, 0.07)",
    ),
    "two levels with walls": Case(
        profile_rows(0.0),
        walled(2, 0.2),
        lambda m, a, _: kinoform.efficiency(m, a, 2, 0.2),
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 2, 0.2)",
    ),
    "eight levels that are all wall": Case(
        profile_rows(0.0),
        walled(8, 0.125),
        lambda m, a, _: kinoform.efficiency(m, a, 8, 0.125),
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 8, 0.125)",
    ),
    "binary": Case(
        [row for duty in (0.25, 0.5, 0.75) for row in profile_rows(duty)],
        binary,
        lambda m, a, d: np.choose(
            np.rint(4 * d - 1).astype(int), [Binary(k).efficiency(m, a) for k in (0.25, 0.5, 0.75)]
        ),
        "hoe_binary_efficiency((int)a[0], a[1], a[2])",
    ),
    "sinusoid": Case(
        profile_rows(0.0),
        sinusoid,
        lambda m, a, _: Sinusoid().efficiency(m, a),
        "hoe_sinusoid_efficiency((int)a[0], abs(a[1]))",
    ),
}


@cache
def expected(name: str) -> list[mpf]:
    case = CASES[name]
    with mp.workdps(DIGITS):
        return [case.exact(int(m), a, last) for m, a, last in case.rows]


def check(name: str, found: NDArray[np.float64], relative: float, absolute: float) -> None:
    case = CASES[name]
    with mp.workdps(DIGITS):
        for row, answer, exact in zip(case.rows, found.tolist(), expected(name), strict=True):
            if case.relative and exact == 0:
                assert answer == 0.0, row
            elif case.relative:
                small = 0.0 if relative == RELATIVE else SMALLEST
                assert abs(mpf(answer) - exact) <= relative * exact + small, (row, answer)
            else:
                assert abs(mpf(answer) - exact) <= absolute, (row, answer)


@pytest.mark.parametrize("name", CASES)
def test_numpy(name: str) -> None:
    case = CASES[name]
    orders, alphas, last = (np.array(column) for column in zip(*case.rows, strict=True))
    check(name, np.asarray(case.numpy(orders, alphas, last)), RELATIVE, ABSOLUTE)


@pytest.mark.render
@pytest.mark.parametrize("name", CASES)
def test_cycles(clean_scene: Any, name: str) -> None:
    case = CASES[name]
    check(name, values_of(clean_scene, case.osl, case.rows), RELATIVE_OSL, ABSOLUTE_OSL)
