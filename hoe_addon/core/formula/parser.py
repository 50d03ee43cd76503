# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From words to a graph: the grammar of formulas.

From loose to tight: ``+ -``, ``* /``, a sign before a term, ``^`` (or ``**``), which is taken
from right to left: ``-x^2`` is ``-(x^2)``, and ``2^3^2`` is ``2^9``.
"""

import math
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager

from ..errors import SpecError
from .error import FormulaError
from .graph import Graph, Op
from .tokens import Kind, Token, tokens

MAX_DEPTH = 60
"""Most brackets, signs and powers inside one another."""

MAX_EXPONENT = 64.0
"""Largest constant exponent in size."""

FUNCTIONS: Mapping[str, tuple[Op, int, int]] = {
    "sqrt": (Op.SQRT, 1, 1),
    "exp": (Op.EXP, 1, 1),
    "log": (Op.LOG, 1, 1),
    "sin": (Op.SIN, 1, 1),
    "cos": (Op.COS, 1, 1),
    "tan": (Op.TAN, 1, 1),
    "asin": (Op.ASIN, 1, 1),
    "acos": (Op.ACOS, 1, 1),
    "atan": (Op.ATAN, 1, 1),
    "atan2": (Op.ATAN2, 2, 2),
    "sinh": (Op.SINH, 1, 1),
    "cosh": (Op.COSH, 1, 1),
    "tanh": (Op.TANH, 1, 1),
    "abs": (Op.ABS, 1, 1),
    "hypot": (Op.HYPOT, 2, 2),
    "pow": (Op.POWER, 2, 2),
    "min": (Op.MIN, 2, 16),
    "max": (Op.MAX, 2, 16),
}
"""Operation of each function, and how few and how many arguments it takes."""

VARIABLES: Mapping[str, Op] = {"x": Op.X, "y": Op.Y, "r": Op.R, "phi": Op.PHI}
CONSTANTS: Mapping[str, float] = {"pi": math.pi}

_SHOWN = 40
_SUMS = {"+": Op.ADD, "-": Op.SUBTRACT}
_PRODUCTS = {"*": Op.MULTIPLY, "/": Op.DIVIDE}


def parse(text: str, constants: Mapping[str, float], graph: Graph) -> int:
    """Read a formula.

    Args:
        text: The formula.
        constants: The user's own names, none of them one of ours.
        graph: Where its operations go.

    Returns:
        Place of the whole expression in the graph.

    Raises:
        FormulaError: The text breaks a rule; the message says where.
    """
    parser = _Parser(tokens(text), {**CONSTANTS, **constants}, graph)
    return parser.whole()


class _Parser:
    def __init__(self, words: list[Token], constants: Mapping[str, float], graph: Graph) -> None:
        self._words = words
        self._next = 0
        self._depth = 0
        self._constants = constants
        self._graph = graph

    def whole(self) -> int:
        """Read all words as one expression."""
        place = self._sum()
        word = self._words[self._next]
        if word.kind is not Kind.END:
            raise FormulaError(word.column, f"must not go on with {_said(word)}")
        return place

    def _sum(self) -> int:
        return self._chain(_SUMS, self._product)

    def _product(self) -> int:
        return self._chain(_PRODUCTS, self._signed)

    def _chain(self, signs: Mapping[str, Op], part: Callable[[], int]) -> int:
        """Read parts with signs between them, from left to right."""
        place = part()
        while (word := self._words[self._next]).text in signs:
            self._next += 1
            right = part()
            with self._at(word):
                place = self._graph.apply(signs[word.text], place, right)
        return place

    def _signed(self) -> int:
        word = self._words[self._next]
        if word.text not in _SUMS:
            return self._power()
        self._next += 1
        with self._deeper(word):
            place = self._signed()
        with self._at(word):
            return self._graph.apply(Op.NEGATE, place) if word.text == "-" else place

    def _power(self) -> int:
        base = self._atom()
        word = self._words[self._next]
        if word.text != "^":
            return base
        self._next += 1
        with self._deeper(word):
            exponent = self._signed()
        return self._raised(word, base, exponent)

    def _raised(self, word: Token, base: int, exponent: int) -> int:
        graph = self._graph
        fixed = graph.constant(exponent)
        with self._at(word):
            if fixed is None:
                log = graph.apply(Op.LOG, base)
                return graph.apply(Op.EXP, graph.apply(Op.MULTIPLY, exponent, log))
            if abs(fixed) > MAX_EXPONENT:
                raise SpecError(f"an exponent must be at most {MAX_EXPONENT:g} in size")
            return graph.power(base, fixed)

    def _atom(self) -> int:
        word = self._words[self._next]
        self._next += 1
        if word.kind is Kind.NUMBER:
            with self._at(word):
                return self._graph.number(float(word.text))
        if word.kind is Kind.NAME:
            return self._named(word)
        if word.text != "(":
            raise FormulaError(word.column, f"must have a number or a name, not {_said(word)}")
        with self._deeper(word):
            place = self._sum()
        self._take(")")
        return place

    def _named(self, word: Token) -> int:
        called = self._words[self._next].text == "("
        if called and word.text in FUNCTIONS:
            return self._call(word)
        if called:
            raise self._unknown(word, "function", FUNCTIONS)
        with self._at(word):
            if word.text in VARIABLES:
                return self._graph.variable(VARIABLES[word.text])
            if word.text in self._constants:
                return self._graph.number(self._constants[word.text])
        if word.text in FUNCTIONS:
            raise FormulaError(word.column, f'function "{word.text}" must be followed by "("')
        raise self._unknown(word, "name", {**VARIABLES, **self._constants, **FUNCTIONS})

    def _unknown(self, word: Token, what: str, known: Mapping[str, object]) -> FormulaError:
        rule = f"unknown {what} {_said(word)} (known: {', '.join(known)})"
        return FormulaError(word.column, rule)

    def _call(self, word: Token) -> int:
        op, fewest, most = FUNCTIONS[word.text]
        opening = self._take("(")
        args: list[int] = []
        with self._deeper(opening):
            args.append(self._sum())
            while self._words[self._next].text == ",":
                self._next += 1
                args.append(self._sum())
        self._take(")")
        if not fewest <= len(args) <= most:
            count = str(fewest) if fewest == most else f"{fewest} to {most}"
            what = "argument" if most == 1 else "arguments"
            rule = f'function "{word.text}" takes {count} {what}, got {len(args)}'
            raise FormulaError(word.column, rule)
        if op is Op.POWER:
            return self._raised(word, *args)
        with self._at(word):
            if op not in (Op.MIN, Op.MAX):
                return self._graph.apply(op, *args)
            place = args[0]
            for right in args[1:]:
                place = self._graph.apply(op, place, right)
            return place

    def _take(self, sign: str) -> Token:
        word = self._words[self._next]
        if word.text != sign or word.kind is not Kind.SIGN:
            raise FormulaError(word.column, f'must have "{sign}" here, not {_said(word)}')
        self._next += 1
        return word

    @contextmanager
    def _at(self, word: Token) -> Generator[None]:
        """Say where in the text a rule of the graph is broken."""
        try:
            yield
        except FormulaError:
            raise
        except SpecError as error:
            raise FormulaError(word.column, str(error)) from error

    @contextmanager
    def _deeper(self, word: Token) -> Generator[None]:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise FormulaError(word.column, f"must be nested at most {MAX_DEPTH} deep")
        yield
        self._depth -= 1


def _said(word: Token) -> str:
    if word.kind is Kind.END:
        return word.text
    return f'"{word.text}"' if len(word.text) <= _SHOWN else f'"{word.text[:_SHOWN]}..."'
