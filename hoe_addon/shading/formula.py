# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas in the shader: OSL text written from the operations, never from the user's text."""

import re
from collections.abc import Callable, Mapping

from .. import resources
from ..core.formula import Formula, Graph, Node, Op
from ..model.characteristic import FormulaSpec
from ..model.characteristic.unit import metres_per_unit
from .part import ShaderPart, parameter

_WHOLE = re.compile(r"-?[0-9]+")

_LARGEST_EXPONENT = "88.0"
"""exp of more is beyond float32."""


def formula_part(spec: FormulaSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for V as a formula: its gradient.

    Args:
        spec: The formula.
        units_per_mm: Scene units in one mm.

    Returns:
        Functions with the formula's derivatives, and code that calls them.
    """
    scale = metres_per_unit(spec.unit, spec.wavelength_nm) * 1e3
    return ShaderPart(
        functions=resources.osl_path("hoe_math.h").read_text(encoding="utf-8")
        + formula_function(spec.parsed()),
        parameters=" ".join(
            (
                parameter(
                    "float", "formula_scale", "1.0", "Formula Scale", "Of 1 of V, path in mm"
                ),
                parameter(
                    "float", "formula_mm", "1.0", "Formula mm", "Of 1 scene unit, length in mm"
                ),
            )
        ),
        code=(
            "{ float along_x; float along_y; "
            "if (!hoe_formula(position[0] * formula_mm, position[1] * formula_mm, "
            "along_x, along_y)) recorded = 0; "
            "gradient = formula_scale * vector(along_x, along_y, 0.0); }"
        ),
        sockets={"formula_scale": scale, "formula_mm": 1.0 / units_per_mm},
    )


def formula_function(formula: Formula) -> str:
    """Write the gradient of a formula as an OSL function.

    OSL divides by zero without complaint, so each operation that can fail is looked at: the
    function returns 0 where the formula has no gradient, as numpy gives NaN there.

    Args:
        formula: The formula.

    Returns:
        The text of ``hoe_formula(x, y, along_x, along_y)``.
    """
    writer = _Writer(formula.graph)
    # V itself is written too, for what can fail in it; the compiler drops what is not used.
    along_x, along_y, along_r, along_phi, _ = writer.write((*formula.slopes, formula.value))
    body = list(writer.lines)
    body += [f"along_x = {along_x};", f"along_y = {along_y};"]
    if formula.is_radial:
        # A smooth function of r has no slope along r at the origin; any other has a kink there.
        body += [
            f"float radial = r > 0.0 ? {along_r} / r : 0.0;",
            f"if (r == 0.0 && {along_r} != 0.0) ok = 0;",
            "along_x += radial * x;",
            "along_y += radial * y;",
        ]
    if formula.is_angular:
        body += [
            f"float turning = r > 0.0 ? {along_phi} / r / r : 0.0;",
            "if (r == 0.0) ok = 0;",
            "along_x -= turning * y;",
            "along_y += turning * x;",
        ]
    body += ["return ok && isfinite(along_x) && isfinite(along_y);"]
    lines = "".join(f"    {line}\n" for line in body)
    return (
        "int hoe_formula(float x, float y, output float along_x, output float along_y)\n"
        f"{{\n    int ok = 1;\n    float r = hoe_hypot(x, y);\n{lines}}}\n"
    )


def value_function(name: str, formula: Formula) -> str:
    """Write a formula itself as an OSL function.

    Args:
        name: Name of the function.
        formula: The formula.

    Returns:
        The text of ``name(x, y)``, which returns 0 where the formula has no value.
    """
    writer = _Writer(formula.graph)
    (value,) = writer.write((formula.value,))
    lines = "".join(f"    {line}\n" for line in writer.lines)
    return (
        f"float {name}(float x, float y)\n"
        f"{{\n    int ok = 1;\n    float r = hoe_hypot(x, y);\n{lines}"
        f"    return ok && isfinite({value}) ? {value} : 0.0;\n}}\n"
    )


class _Writer:
    """Writes operations as statements, one variable each."""

    def __init__(self, graph: Graph) -> None:
        self.lines: list[str] = []
        self._graph = graph
        self._names: dict[int, str] = {}

    def write(self, places: tuple[int, ...]) -> list[str]:
        """Write what some expressions need, and return the name of each."""
        for place in self._graph.needed(*places):
            node = self._graph.nodes[place]
            self._names[place] = _LEAVES.get(node.op) or self._statement(node)
        return [self._names[place] for place in places]

    def _statement(self, node: Node) -> str:
        if node.op is Op.NUMBER:
            return _number(node.value)
        args = [self._names[arg] for arg in node.args]
        condition = _condition(node, args)
        if condition:
            self.lines.append(f"if (!({condition})) ok = 0;")
        text = self._power(node, args[0]) if node.op is Op.POWER else _OPERATIONS[node.op](*args)
        return self._named(text)

    def _named(self, text: str) -> str:
        name = f"t{len(self.lines)}"
        self.lines.append(f"float {name} = {text};")
        return name

    def _power(self, node: Node, base: str) -> str:
        """Write a power: whole parts by squaring, halves by a root, the rest by logarithms."""
        whole, rest = divmod(node.value, 1.0)
        factors: list[str] = []
        if rest == 0.5:
            factors.append(f"sqrt({base})")
        elif rest:
            factors.append(f"hoe_power({base}, {_number(rest)})")
        square, count = base, int(whole)
        while count:
            if count % 2:
                factors.append(square)
            count //= 2
            if count:
                square = self._named(f"{square} * {square}")
        return " * ".join(factors)


_LEAVES: Mapping[Op, str] = {Op.X: "x", Op.Y: "y", Op.R: "r"}

_OPERATIONS: Mapping[Op, Callable[..., str]] = {
    Op.PHI: "hoe_atan2(y, x)".format,
    Op.ADD: "{} + {}".format,
    Op.SUBTRACT: "{} - {}".format,
    Op.MULTIPLY: "{} * {}".format,
    Op.DIVIDE: "{} / {}".format,
    Op.NEGATE: "-{}".format,
    Op.SQRT: "sqrt({})".format,
    Op.EXP: "hoe_exp({})".format,
    Op.LOG: "hoe_log({})".format,
    Op.SIN: "hoe_sin({})".format,
    Op.COS: "hoe_cos({})".format,
    Op.TAN: "hoe_tan({})".format,
    Op.ASIN: "hoe_asin({})".format,
    Op.ACOS: "hoe_acos({})".format,
    Op.ATAN: "hoe_atan({})".format,
    Op.ATAN2: "hoe_atan2({}, {})".format,
    Op.SINH: "hoe_sinh({})".format,
    Op.COSH: "hoe_cosh({})".format,
    Op.TANH: "hoe_tanh({})".format,
    Op.ABS: "abs({})".format,
    Op.HYPOT: "hoe_hypot({}, {})".format,
    Op.MIN: "min({}, {})".format,
    Op.MAX: "max({}, {})".format,
    Op.SIGN: "{0} < 0.0 ? -1.0 : 1.0".format,
    Op.CHOOSE: "{0} > {1} ? {2} : {3}".format,
}


def _condition(node: Node, args: list[str]) -> str:
    """What must hold for the operation to have a value; empty if it always has."""
    match node.op:
        case Op.DIVIDE:
            return f"{args[1]} != 0.0"
        case Op.SIGN:
            return f"{args[0]} != 0.0"
        case Op.SQRT:
            return f"{args[0]} >= 0.0"
        case Op.POWER if node.value % 1.0:
            return f"{args[0]} >= 0.0"
        case Op.LOG:
            return f"{args[0]} > 0.0"
        case Op.ASIN | Op.ACOS:
            return f"abs({args[0]}) <= 1.0"
        case Op.EXP:
            return f"{args[0]} < {_LARGEST_EXPONENT}"
        case Op.SINH | Op.COSH:
            return f"abs({args[0]}) < {_LARGEST_EXPONENT}"
        case Op.CHOOSE:
            return f"{args[0]} != {args[1]} || {args[2]} == {args[3]}"
        case _:
            return ""


def _number(value: float) -> str:
    """A float literal that carries a float32 unchanged; negative ones in brackets."""
    text = f"{value:.9g}"
    if _WHOLE.fullmatch(text):
        text += ".0"
    return f"({text})" if value < 0.0 else text
