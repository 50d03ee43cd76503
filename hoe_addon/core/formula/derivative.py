# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives of a graph, as further expressions of the same graph."""

from collections.abc import Callable, Mapping

from .graph import VARIABLES, Graph, Node, Op


def derivative(graph: Graph, place: int, variable: Op) -> int:
    """Return the derivative of an expression; the other variables are held.

    Args:
        graph: The graph; the derivative is added to it.
        place: The expression.
        variable: One of ``x``, ``y``, ``r``, ``phi``.

    Returns:
        Place of the derivative.

    Raises:
        SpecError: The graph is full, or a constant has no finite value.
    """
    found: dict[int, int] = {}
    for here in graph.needed(place):
        node = graph.nodes[here]
        if node.op in VARIABLES or node.op is Op.NUMBER:
            found[here] = graph.number(1.0 if node.op is variable else 0.0)
            continue
        slopes = [found[arg] for arg in node.args]
        if all(graph.constant(slope) == 0.0 for slope in slopes):
            found[here] = graph.number(0.0)
        elif len(slopes) == 1:
            found[here] = _chain_rule(graph, here, node, found)
        else:
            found[here] = _PAIRS[node.op](graph, *node.args, *slopes)
    return found[place]


def _chain_rule(graph: Graph, here: int, node: Node, found: Mapping[int, int]) -> int:
    """Return the derivative of a function of one argument."""
    inner = node.args[0]
    if node.op is not Op.POWER:
        return graph.apply(Op.MULTIPLY, _SINGLE[node.op](graph, here, inner), found[inner])
    count, base = graph.number(node.value), graph.nodes[inner]
    if base.op is Op.ABS and node.value > 2.0:
        # |u|^n has no kink: n |u|^(n - 2) u u', and not the slope of |u|, which 0 does not have.
        inner_slope = graph.apply(Op.MULTIPLY, base.args[0], found[base.args[0]])
        factor = graph.apply(Op.MULTIPLY, count, graph.power(inner, node.value - 2.0))
        return graph.apply(Op.MULTIPLY, factor, inner_slope)
    factor = graph.apply(Op.MULTIPLY, count, graph.power(inner, node.value - 1.0))
    return graph.apply(Op.MULTIPLY, factor, found[inner])


def _negated(graph: Graph, place: int) -> int:
    return graph.apply(Op.NEGATE, place)


def _one_over(graph: Graph, place: int) -> int:
    return graph.apply(Op.DIVIDE, graph.number(1.0), place)


def _one_plus(graph: Graph, sign: Op, place: int) -> int:
    return graph.apply(sign, graph.number(1.0), graph.power(place, 2.0))


type _Single = Callable[[Graph, int, int], int]

_SINGLE: Mapping[Op, _Single] = {
    Op.NEGATE: lambda g, _, u: g.number(-1.0),
    Op.SQRT: lambda g, f, u: g.apply(Op.DIVIDE, g.number(0.5), f),
    Op.EXP: lambda g, f, u: f,
    Op.LOG: lambda g, _, u: _one_over(g, u),
    Op.SIN: lambda g, _, u: g.apply(Op.COS, u),
    Op.COS: lambda g, _, u: _negated(g, g.apply(Op.SIN, u)),
    Op.TAN: lambda g, f, u: _one_plus(g, Op.ADD, f),
    Op.ASIN: lambda g, _, u: _one_over(g, g.apply(Op.SQRT, _one_plus(g, Op.SUBTRACT, u))),
    Op.ACOS: lambda g, _, u: _negated(
        g, _one_over(g, g.apply(Op.SQRT, _one_plus(g, Op.SUBTRACT, u)))
    ),
    Op.ATAN: lambda g, _, u: _one_over(g, _one_plus(g, Op.ADD, u)),
    Op.SINH: lambda g, _, u: g.apply(Op.COSH, u),
    Op.COSH: lambda g, _, u: g.apply(Op.SINH, u),
    Op.TANH: lambda g, f, u: _one_plus(g, Op.SUBTRACT, f),
    Op.ABS: lambda g, _, u: g.apply(Op.SIGN, u),
}
"""f'(u) from the graph, the place of f(u), and the place of u."""


def _sum(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    del u, v
    return graph.apply(Op.ADD, du, dv)


def _difference(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    del u, v
    return graph.apply(Op.SUBTRACT, du, dv)


def _larger(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    return graph.apply(Op.CHOOSE, u, v, du, dv)


def _smaller(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    return graph.apply(Op.CHOOSE, v, u, du, dv)


def _product(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    left = graph.apply(Op.MULTIPLY, du, v)
    return graph.apply(Op.ADD, left, graph.apply(Op.MULTIPLY, u, dv))


def _quotient(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    # (u' - (u / v) v') / v: u / v is there already.
    whole = graph.apply(Op.DIVIDE, u, v)
    top = graph.apply(Op.SUBTRACT, du, graph.apply(Op.MULTIPLY, whole, dv))
    return graph.apply(Op.DIVIDE, top, v)


def _hypotenuse(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    left, right = graph.apply(Op.MULTIPLY, u, du), graph.apply(Op.MULTIPLY, v, dv)
    whole = graph.apply(Op.HYPOT, u, v)
    return graph.apply(Op.DIVIDE, graph.apply(Op.ADD, left, right), whole)


def _angle(graph: Graph, u: int, v: int, du: int, dv: int) -> int:
    left, right = graph.apply(Op.MULTIPLY, v, du), graph.apply(Op.MULTIPLY, u, dv)
    square = graph.apply(Op.ADD, graph.power(u, 2.0), graph.power(v, 2.0))
    return graph.apply(Op.DIVIDE, graph.apply(Op.SUBTRACT, left, right), square)


type _Pair = Callable[[Graph, int, int, int, int], int]

_PAIRS: Mapping[Op, _Pair] = {
    Op.ADD: _sum,
    Op.SUBTRACT: _difference,
    Op.MULTIPLY: _product,
    Op.DIVIDE: _quotient,
    Op.HYPOT: _hypotenuse,
    Op.ATAN2: _angle,
    Op.MAX: _larger,
    Op.MIN: _smaller,
}
"""Derivative of f(u, v) from the graph, u, v, u', v'."""
