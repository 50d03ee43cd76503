# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random texts as formulas: a clear error or finite numbers, soon, and no code is ever run."""

import builtins
import os
import random
import time

import numpy as np
import pytest

from hoe_addon.core.formula import Formula, FormulaError
from hoe_addon.core.formula.check import find_trouble

COUNT = 20_000
SLOWEST = 1.0
"""s for one text, to read it and to look over an element."""

SIGNS = (
    "x y r phi pi sin cos tan sqrt exp log abs min max pow hypot atan2 asin acos atan sinh cosh "
    "tanh ( ) ( ) + - * / ^ ** , 0 1 2 3 0.5 1e9 1e-9 1e308 1e-308 nan inf -inf 1e999 64 65 .5 5. "
    "__import__ __class__ eval exec os system lambda import x.y x[0] ' \" ; : = == \\ \n \t # % & "
    "| ~ ! @ $ { } [ ] ² é ∞ \u200b \x00 \uff11 \u03c0 0x10 1_000 1j 1e5e5 .. ..5 ---- **** ()"
)

WORDS = tuple(SIGNS.split(" "))

GOOD = (
    "sqrt(100^2+r^2)-100",
    "0.3*r*sin(phi)+r/9",
    "exp(-(r/7)^2)*2+log(20+x)",
    "asin(x/20)*4+acos(y/25)",
    "max(x,y,0)/5-min(x,2*y)",
    "pow(r,1.5)/40+x**3",
    "tan(x/15)*3/(2+cos(y/3))",
)


def some_formula(rng: random.Random, depth: int) -> str:
    if depth == 0:
        return rng.choice(("x", "y", "r", "phi", "pi", "0", "2", "0.5", "64", "1e-20", "1e20"))
    inner = some_formula(rng, depth - 1)
    function = rng.choice(("sin", "tan", "log", "exp", "sqrt", "acos", "abs", "cosh", "tanh"))
    return rng.choice(
        (
            f"{inner}{rng.choice('+-*/^')}{some_formula(rng, depth - 1)}",
            f"({inner}){rng.choice('+-*/^')}({some_formula(rng, rng.randrange(depth))})",
            f"{function}({inner})",
            f"-({inner})",
            f"{rng.choice(('min', 'max', 'hypot', 'atan2', 'pow'))}({inner},x)",
        )
    )


def some_text(rng: random.Random) -> str:
    kind = rng.randrange(6)
    if kind == 5:
        return some_formula(rng, rng.randrange(1, 6))
    if kind == 0:
        return "".join(rng.choice(WORDS) for _ in range(rng.randrange(12)))
    if kind == 1:
        return " ".join(rng.choice(WORDS[:45]) for _ in range(rng.randrange(1, 30)))
    if kind == 2:
        return "".join(
            chr(rng.choice((rng.randrange(128), rng.randrange(0x11000)))) for _ in "12345678"
        )
    if kind == 3:
        sign = rng.choice(("(", "-", "+", "sin(", "x^", "2**", "1/", "min(x,", "((x)+"))
        deep = rng.choice((3, 20, 59, 60, 61, 62, 63, 90)) if rng.random() < 0.9 else 900
        return sign * deep + "x" + ")" * rng.randrange(deep + 2)
    text = list(rng.choice(GOOD))
    for _ in range(rng.randrange(1, 5)):
        place = rng.randrange(len(text) + 1)
        text[place : place + rng.randrange(3)] = rng.choice(WORDS)
    return "".join(text)


@pytest.fixture
def no_code(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        pytest.fail("a formula's text was run")

    for owner, name in ((builtins, "eval"), (builtins, "exec"), (os, "system")):
        monkeypatch.setattr(owner, name, refuse)


@pytest.mark.usefixtures("no_code")
@pytest.mark.slow
def test_twenty_thousand_texts() -> None:
    rng = random.Random(20260101)
    x, y = np.meshgrid(np.linspace(-9.0, 9.0, 9), np.linspace(-9.0, 9.0, 9))
    read = refused = looked_over = 0
    for _ in range(COUNT):
        text = some_text(rng)
        start = time.perf_counter()
        try:
            formula = Formula.read(text)
        except FormulaError as error:
            refused += 1
            message = str(error)
            assert message.startswith(f"column {error.column}: ")
            assert 1 <= error.column <= len(text) + 1
            assert len(message) < 400
            assert message.isprintable()
        else:
            read += 1
            value, gradient = formula.at(x, y), formula.gradient(x, y)
            assert value.shape == x.shape
            assert gradient.shape == (*x.shape, 2)
            assert not np.isinf(value).any()
            assert not np.isinf(gradient).any()
            assert np.isfinite(value[np.isfinite(gradient[..., 0])]).all()
            if read % 10 == 0:
                looked_over += 1
                find_trouble(formula, (-9.0, 9.0, -9.0, 9.0), lambda a, b: np.isfinite(a + b))
        assert time.perf_counter() - start < SLOWEST, text
    # Both outcomes must really come up.
    assert refused > COUNT / 2
    assert read > COUNT / 20
    assert looked_over > COUNT / 200


def test_the_longest_formulas_stay_quick() -> None:
    rng = random.Random(1)
    texts = (
        "+".join(f"sin({n / 7}*x*y)" for n in range(1, 75)),
        "*".join(f"(x+{n})" for n in range(1, 130)),
        "/".join(f"(x*y+{n + 200})" for n in range(1, 95)),
        "sqrt(1+" * 59 + "r^2" + ")" * 59,
        "x" + "".join(f"{rng.choice('+-*')}max(x,{n}*y)" for n in range(1, 80)),
    )
    for text in texts:
        start = time.perf_counter()
        formula = Formula.read(text[:2000])
        find_trouble(formula, (-9.0, 9.0, -9.0, 9.0), lambda a, b: np.isfinite(a + b))
        assert time.perf_counter() - start < SLOWEST, text
