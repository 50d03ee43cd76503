# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Graphs worked out in numpy."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray
from .graph import Graph, Node, Op


def evaluate(
    graph: Graph, places: Sequence[int], x: FloatArray, y: FloatArray
) -> tuple[list[FloatArray], BoolArray]:
    """Work out expressions at points.

    Args:
        graph: The graph.
        places: The expressions.
        x: In the formula's unit of length, shape ``(...)``.
        y: The same, shape ``(...)``.

    Returns:
        The values, each of shape ``(...)``, and whether every operation on the way to them had a
        finite value, shape ``(...)``.
    """
    needed = graph.needed(*places)
    last_use = {arg: here for here in needed for arg in graph.nodes[here].args}
    known: dict[int, FloatArray] = {}
    finite = np.ones(np.broadcast_shapes(x.shape, y.shape), dtype=np.bool_)
    with np.errstate(all="ignore"):
        for here in needed:
            node = graph.nodes[here]
            value = _value(node, [known[arg] for arg in node.args], x, y)
            finite &= np.isfinite(value)
            known[here] = value
            # What no later operation needs is let go: a graph may be long, and a grid large.
            for arg in set(node.args):
                if last_use[arg] == here and arg not in places:
                    del known[arg]
    return [np.broadcast_to(known[place], finite.shape) for place in places], finite


def _value(node: Node, args: list[FloatArray], x: FloatArray, y: FloatArray) -> FloatArray:
    match node.op:
        case Op.NUMBER:
            return np.asarray(node.value)
        case Op.X:
            return x
        case Op.Y:
            return y
        case Op.R:
            return np.hypot(x, y)
        case Op.PHI:
            return np.arctan2(y, x)
        case Op.POWER:
            return np.power(args[0], node.value)
        case _:
            return _FUNCTIONS[node.op](*args)


def _sign(u: FloatArray) -> FloatArray:
    return np.where(u == 0.0, np.nan, np.sign(u))


def _choose(a: FloatArray, b: FloatArray, p: FloatArray, q: FloatArray) -> FloatArray:
    tie = np.where(p == q, p, np.nan)
    return np.where(a > b, p, np.where(a < b, q, tie))


_FUNCTIONS: Mapping[Op, Any] = {
    Op.ADD: np.add,
    Op.SUBTRACT: np.subtract,
    Op.MULTIPLY: np.multiply,
    Op.DIVIDE: np.divide,
    Op.NEGATE: np.negative,
    Op.SQRT: np.sqrt,
    Op.EXP: np.exp,
    Op.LOG: np.log,
    Op.SIN: np.sin,
    Op.COS: np.cos,
    Op.TAN: np.tan,
    Op.ASIN: np.arcsin,
    Op.ACOS: np.arccos,
    Op.ATAN: np.arctan,
    Op.ATAN2: np.arctan2,
    Op.SINH: np.sinh,
    Op.COSH: np.cosh,
    Op.TANH: np.tanh,
    Op.ABS: np.abs,
    Op.HYPOT: np.hypot,
    Op.MIN: np.minimum,
    Op.MAX: np.maximum,
    Op.SIGN: _sign,
    Op.CHOOSE: _choose,
}
