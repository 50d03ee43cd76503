# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A formula as a list of operations, each on earlier ones; equal operations stand once."""

from dataclasses import dataclass
from enum import StrEnum

from ..errors import SpecError
from .constant import fold


class Op(StrEnum):
    """What a node does with its arguments."""

    NUMBER = "number"
    X = "x"
    Y = "y"
    R = "r"
    PHI = "phi"
    ADD = "add"
    SUBTRACT = "subtract"
    MULTIPLY = "multiply"
    DIVIDE = "divide"
    NEGATE = "negate"
    POWER = "power"
    """The argument to a constant exponent, which is the node's value."""
    SQRT = "sqrt"
    EXP = "exp"
    LOG = "log"
    SIN = "sin"
    COS = "cos"
    TAN = "tan"
    ASIN = "asin"
    ACOS = "acos"
    ATAN = "atan"
    ATAN2 = "atan2"
    SINH = "sinh"
    COSH = "cosh"
    TANH = "tanh"
    ABS = "abs"
    HYPOT = "hypot"
    MIN = "min"
    MAX = "max"
    SIGN = "sign"
    """Derivative of abs: -1 or 1, and not defined at 0."""
    CHOOSE = "choose"
    """(a, b, p, q): p where a > b, q where a < b; where a = b not defined unless p = q."""


SMALLEST, LARGEST = 1e-30, 1e30
"""Sizes of constants, 0 aside; float32 holds their reciprocals too."""

VARIABLES = (Op.X, Op.Y, Op.R, Op.PHI)


@dataclass(frozen=True)
class Node:
    """One operation.

    Attributes:
        op: What it does.
        args: Places of its arguments in the graph, all before its own.
        value: The number, or the exponent of a power; 0 otherwise.
    """

    op: Op
    args: tuple[int, ...] = ()
    value: float = 0.0


class Graph:
    """Operations in the order in which they can be done.

    Attributes:
        nodes: The operations; an expression is the place of its last one.
        limit: Most operations that it may hold.
    """

    def __init__(self, limit: int) -> None:
        """Make it empty.

        Args:
            limit: Most operations that it may hold.
        """
        self.nodes: list[Node] = []
        self._places: dict[Node, int] = {}
        self.limit = limit

    def number(self, value: float) -> int:
        """Return the expression of a constant.

        Args:
            value: A finite number.

        Returns:
            Its place.
        """
        return self._add(Node(Op.NUMBER, (), value + 0.0))

    def variable(self, op: Op) -> int:
        """Return the expression of one of the variables.

        Args:
            op: One of `VARIABLES`.

        Returns:
            Its place.
        """
        return self._add(Node(op))

    def constant(self, place: int) -> float | None:
        """Return the number that an expression is, or None if it depends on anything.

        Args:
            place: The expression.

        Returns:
            The number.
        """
        node = self.nodes[place]
        return node.value if node.op is Op.NUMBER else None

    def apply(self, op: Op, *args: int) -> int:
        """Return the expression of an operation, worked out or simplified where that is exact.

        Args:
            op: Any operation but a number, a variable or a power.
            args: Its arguments.

        Returns:
            Its place.

        Raises:
            SpecError: It has no finite value, or the graph is full.
        """
        constants = [self.constant(place) for place in args]
        numbers = [value for value in constants if value is not None]
        if len(numbers) == len(args):
            return self.number(fold(op.value, numbers))
        simpler = self._simpler(op, args, constants)
        return self._add(Node(op, args)) if simpler is None else simpler

    def power(self, base: int, exponent: float) -> int:
        """Return an expression to a constant power.

        Args:
            base: The expression.
            exponent: Finite.

        Returns:
            Its place.

        Raises:
            SpecError: It has no finite value, or the graph is full.
        """
        known = self.constant(base)
        if known is not None:
            return self.number(fold("power", [known, exponent]))
        if exponent == 0.0:
            return self.number(1.0)
        if exponent == 1.0:
            return base
        if exponent < 0.0:
            return self.apply(Op.DIVIDE, self.number(1.0), self.power(base, -exponent))
        if exponent == 0.5:
            return self.apply(Op.SQRT, base)
        node = self.nodes[base]
        if node.op is Op.ABS and exponent % 2.0 == 0.0:
            return self.power(node.args[0], exponent)
        return self._add(Node(Op.POWER, (base,), exponent))

    def needed(self, *places: int) -> list[int]:
        """List what has to be worked out for some expressions.

        Args:
            places: The expressions.

        Returns:
            Places in the order in which they can be worked out.
        """
        wanted = set(places)
        for place in range(max(places), -1, -1):
            if place in wanted:
                wanted.update(self.nodes[place].args)
        return sorted(wanted)

    def _simpler(self, op: Op, args: tuple[int, ...], constants: list[float | None]) -> int | None:
        """Return an equal expression that is already there, if there is one."""
        match op, constants:
            case (Op.ADD, [0.0, _]) | (Op.MULTIPLY, [1.0, _]):
                return args[1]
            case (Op.ADD | Op.SUBTRACT, [_, 0.0]) | (Op.MULTIPLY | Op.DIVIDE, [_, 1.0]):
                return args[0]
            case (Op.MULTIPLY, [0.0, _] | [_, 0.0]):
                return self.number(0.0)
            case (Op.DIVIDE, [_, 0.0]):
                raise SpecError("divides by zero")
            case (Op.SUBTRACT, [0.0, _]) | (Op.MULTIPLY, [-1.0, _]):
                return self.apply(Op.NEGATE, args[1])
            case (Op.CHOOSE, _) if args[2] == args[3]:
                return args[2]
            case _:
                return None

    def _add(self, node: Node) -> int:
        place = self._places.get(node)
        if place is None:
            if len(self.nodes) >= self.limit:
                raise SpecError(f"must need at most {self.limit} operations")
            if node.value != 0.0 and not SMALLEST <= abs(node.value) <= LARGEST:
                rule = f"must need no number beyond {SMALLEST:g} to {LARGEST:g} in size"
                raise SpecError(f"{rule}, got {node.value:g}")
            place = self._places[node] = len(self.nodes)
            self.nodes.append(node)
        return place
