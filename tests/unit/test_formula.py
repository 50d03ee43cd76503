# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas: grammar, exact derivatives against mpmath, messages, and trouble on an element."""

from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from hoe_addon.core.formula import Formula, FormulaError
from hoe_addon.core.formula.check import find_trouble

RELATIVE = 1e-13
"""Some hundred roundings of float64 in the longest formula."""

DIGITS = 40

WHOLE = (-10.0, 10.0, -5.0, 5.0)


def polar(function: Callable[..., Any]) -> Callable[[Any, Any], Any]:
    return lambda x, y: function(x, y, mp.sqrt(x * x + y * y), mp.atan2(y, x))


EXACT: dict[str, Callable[[Any, Any], Any]] = {
    "1.5e-3*x + .5*y - 2.": polar(lambda x, y, r, p: mp.mpf(1.5e-3) * x + y / 2 - 2),
    "-x^2*y**3/7": polar(lambda x, y, r, p: -(x**2) * y**3 / 7),
    "2^-x^2": polar(lambda x, y, r, p: mp.mpf(2) ** (-(x**2))),
    "x-y-3*x/y/2": polar(lambda x, y, r, p: x - y - 3 * x / y / 2),
    "sqrt(100^2 + r^2) - 100": polar(lambda x, y, r, p: mp.sqrt(10000 + r**2) - 100),
    "r^2*cos(3*phi) + sin(r)*phi": polar(lambda x, y, r, p: r**2 * mp.cos(3 * p) + mp.sin(r) * p),
    "exp(-(x^2+2*y^2)/9)*log(5+x*y/100)": polar(
        lambda x, y, r, p: mp.exp(-(x**2 + 2 * y**2) / 9) * mp.log(5 + x * y / 100)
    ),
    "tan(x/20)*tanh(y)+sinh(x/3)-cosh(y/4)": polar(
        lambda x, y, r, p: mp.tan(x / 20) * mp.tanh(y) + mp.sinh(x / 3) - mp.cosh(y / 4)
    ),
    "asin(x/12)+acos(y/11)*atan(x*y)": polar(
        lambda x, y, r, p: mp.asin(x / 12) + mp.acos(y / 11) * mp.atan(x * y)
    ),
    "atan2(y-20,x)+hypot(x,y+2)": polar(
        lambda x, y, r, p: mp.atan2(y - 20, x) + mp.hypot(x, y + 2)
    ),
    "abs(x)^3-abs(x*y)+max(x,y,1)-min(x,2*y)": polar(
        lambda x, y, r, p: abs(x) ** 3 - abs(x * y) + max(x, y, 1) - min(x, 2 * y)
    ),
    "pow(r,2.3)+r^1.5+pow(20+x,y/5)": polar(
        lambda x, y, r, p: r ** mp.mpf(2.3) + r ** mp.mpf(1.5) + (20 + x) ** (y / 5)
    ),
    "(x+y)^-2+pi*r": polar(lambda x, y, r, p: (x + y) ** -2 + mp.pi * r),
    "r^17/1e12": polar(lambda x, y, r, p: r**17 / mp.mpf(10) ** 12),
}


@pytest.mark.parametrize("text", EXACT)
def test_value_and_gradient_against_mpmath(text: str, rng: np.random.Generator) -> None:
    x, y = rng.uniform(-10.0, 10.0, 25), rng.uniform(-10.0, 10.0, 25)
    formula, exact = Formula.read(text), EXACT[text]
    value, gradient = formula.at(x, y), formula.gradient(x, y)
    with mp.workdps(DIGITS):
        for k in range(len(x)):
            place = (mp.mpf(x[k]), mp.mpf(y[k]))
            want = exact(*place)
            along = (mp.diff(exact, place, (1, 0)), mp.diff(exact, place, (0, 1)))
            size = float(1 + abs(want))
            assert abs(value[k] - want) <= RELATIVE * size
            slope = float(1 + abs(along[0]) + abs(along[1]))
            assert abs(gradient[k, 0] - along[0]) <= RELATIVE * slope * 10
            assert abs(gradient[k, 1] - along[1]) <= RELATIVE * slope * 10


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2**-1", 0.5),
        ("-2*-3", 6.0),
        ("6/3/2", 1.0),
        ("7-4-2", 1.0),
        ("+-+1", -1.0),
        ("1e2 + .5E+1", 105.0),
        ("min(3,1,2)", 1.0),
        ("hypot(3, 4)", 5.0),
        ("atan2(1,-1)*4/pi", 3.0),
        ("pow(2, 10)", 1024.0),
        ("a*_b", 6.0),
    ],
)
def test_grammar(text: str, value: float) -> None:
    formula = Formula.read(text, {"a": 2.0, "_b": 3.0})
    assert float(formula.at(0.3, 0.7)) == pytest.approx(value, rel=1e-15)
    assert np.array_equal(formula.gradient(0.3, 0.7), [0.0, 0.0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "column 1: must have a number or a name, not the end"),
        ("x + ", "column 5: must have a number or a name, not the end"),
        ("x y", 'column 3: must not go on with "y"'),
        ("2x", 'column 2: must not go on with "x"'),
        ("(x", 'column 3: must have ")" here, not the end'),
        ("x)", 'column 2: must not go on with ")"'),
        ("z+1", 'column 1: unknown name "z" (known: x, y, r, phi, pi, sqrt, '),
        ("1+sine(x)", 'column 3: unknown function "sine" (known: sqrt, exp, log, sin'),
        ("x(2)", 'column 1: unknown function "x"'),
        ("sin x", 'column 1: function "sin" must be followed by "("'),
        ("atan2(x)", 'column 1: function "atan2" takes 2 arguments, got 1'),
        ("sin(x,y)", 'column 1: function "sin" takes 1 argument, got 2'),
        ("min(x)", 'column 1: function "min" takes 2 to 16 arguments, got 1'),
        ("x/0", "column 2: divides by zero"),
        ("1+x/(2-2)", "column 4: divides by zero"),
        ("log(0)", "column 1: log(0) has no finite value"),
        ("sqrt(-1)", "column 1: sqrt(-1) has no finite value"),
        ("(0-8)^0.5", "column 6: power(-8, 0.5) has no finite value"),
        ("exp(1000)", "column 1: exp(1000) has no finite value"),
        ("1e400", "column 1: must need no number beyond 1e-30 to 1e+30 in size, got inf"),
        ("1e-40*x", "column 1: must need no number beyond 1e-30 to 1e+30 in size, got 1e-40"),
        ("x^65", "column 2: an exponent must be at most 64 in size"),
        ("x.real", "column 2: '.' has no meaning in a formula"),
        ("x²", "column 2: '\\xb2' has no meaning in a formula"),
        ("__import__('os').system('true')", 'column 12: "\'" has no meaning'),
        ("x\x00", "column 2: '\\x00' has no meaning"),
        ("(" * 70 + "x" + ")" * 70, "column 61: must be nested at most 60 deep"),
        ("-" * 70 + "x", "column 61: must be nested at most 60 deep"),
        ("x^" * 70 + "x", "column 122: must be nested at most 60 deep"),
        ("x" * 2001, "column 2001: must have at most 2000 characters"),
        ("+".join(f"sin({n}*x)" for n in range(160)), "must need at most 400 operations"),
    ],
)
def test_mistakes_are_named_with_their_column(text: str, message: str) -> None:
    with pytest.raises(FormulaError) as caught:
        Formula.read(text)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "text", ["r^2", "r^4-3*r^2", "cos(r)", "sqrt(1+r^2)", "exp(-r^2/2)", "r^1.5", "x^2+r^3+2*x"]
)
def test_smooth_functions_of_r_have_a_gradient_at_the_origin(text: str) -> None:
    slope = 2.0 if text.endswith("2*x") else 0.0
    assert np.array_equal(Formula.read(text).gradient(0.0, 0.0), [slope, 0.0])


@pytest.mark.parametrize("text", ["r", "sqrt(x^2+y^2)", "hypot(x,y)", "phi", "abs(x)", "max(x,y)"])
def test_a_kink_has_no_gradient(text: str) -> None:
    formula = Formula.read(text)
    assert float(formula.at(0.0, 0.0)) == 0.0
    assert np.isnan(formula.gradient(0.0, 0.0)).all()
    assert np.isfinite(formula.gradient(1e-9, -2e-9)).all()


def test_a_point_without_value_is_nan_and_spoils_no_other() -> None:
    x = np.array([[-1.0, 0.0, 4.0]])
    formula = Formula.read("sqrt(x)+1/x")
    assert np.isnan(formula.at(x, 0.0)[0, :2]).all()
    assert formula.at(x, 0.0)[0, 2] == 2.25
    gradient = formula.gradient(x, 0.0)
    assert np.isnan(gradient[0, :2]).all()
    assert gradient[0, 2].tolist() == [0.25 - 0.0625, 0.0]


def test_there_is_no_gradient_where_there_is_no_value() -> None:
    # The derivative, 1/x, is finite there.
    assert np.isnan(Formula.read("log(x)").gradient(-2.0, 0.0)).all()
    assert np.isnan(Formula.read("max(log(x), 7)").gradient(-2.0, 0.0)).all()


def everywhere(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.isfinite(x + y)


@pytest.mark.parametrize(
    "text",
    [
        "r",
        "r/3+abs(x-1.7)",
        "max(x,y)",
        "phi*3",
        "r*phi",
        "1/(x^2+1e-6)",
        "1/((x-1.234)^2+1e-4)",
        "1/(2+sin(x*y))",
        "1/(1+exp(50*x))",
        "log(x+10.001)",
        "tan(x/7)",
        "sqrt((x-1.2)^2)",
        "exp(x^2)",
    ],
)
def test_nothing_is_found_where_there_is_no_trouble(text: str) -> None:
    assert find_trouble(Formula.read(text), WHOLE, everywhere) is None


@pytest.mark.parametrize(
    ("text", "what", "on"),
    [
        ("1/x", "it divides by zero", lambda x, y: x == 0),
        ("1/(x-1.234)", "it divides by zero", lambda x, y: abs(x - 1.234) < 1e-12),
        ("1/(x-1.234)^2", "it divides by zero", lambda x, y: abs(x - 1.234) < 1e-5),
        (
            "1/((x-1)^2+(y+2.2)^2)",
            "it divides by zero",
            lambda x, y: np.hypot(x - 1, y + 2.2) < 1e-5,
        ),
        ("3/(r-4.3)", "it divides by zero", lambda x, y: abs(np.hypot(x, y) - 4.3) < 1e-12),
        ("sin(r)/r", "it divides by zero", lambda x, y: x == y == 0),
        ("tan(x)", "it has the tangent of a right angle", lambda x, y: abs(np.cos(x)) < 1e-12),
        ("log(r)", "it has the logarithm of zero", lambda x, y: x == y == 0),
        ("log((y-.77)^2)", "it has the logarithm of zero", lambda x, y: abs(y - 0.77) < 1e-5),
        ("sqrt(x)", "it has no finite value", lambda x, y: x < 0),
        ("asin(x/9)", "it has no finite value", lambda x, y: abs(x) > 9),
        ("exp(x^4)", "it has no finite value", lambda x, y: abs(x) > 5),
        ("r^0.5", "its gradient has no finite value", lambda x, y: x == y == 0),
        ("r^0.9", "its gradient has no finite value", lambda x, y: x == y == 0),
        ("sqrt(10-x)", "its gradient has no finite value", lambda x, y: x == 10),
    ],
)
def test_trouble_is_found_where_it_is(text: str, what: str, on: Callable[..., bool]) -> None:
    trouble = find_trouble(Formula.read(text), WHOLE, everywhere)
    assert trouble is not None
    assert trouble.what == what
    assert on(trouble.x, trouble.y)
    assert abs(trouble.x) <= 10.0
    assert abs(trouble.y) <= 5.0


def test_trouble_outside_of_the_outline_does_not_count() -> None:
    formula = Formula.read("1/(r-10.5)")
    assert find_trouble(formula, WHOLE, everywhere) is not None
    assert find_trouble(formula, WHOLE, lambda x, y: np.hypot(x / 10, y / 5) <= 1) is None
