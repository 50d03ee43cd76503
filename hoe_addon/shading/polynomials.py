# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Polynomials in the shader: grad V in coordinates over the normalization, by nested products."""

from collections.abc import Iterable, Mapping
from itertools import pairwise

from ..core.characteristic.zernike import jacobi_step
from ..model.characteristic import EvenRadialSpec, PolynomialSpec, ZernikeSpec
from ..model.characteristic.convert import even_radial_from, metres_per_unit
from ..model.characteristic.zernike import ORDERS
from .part import ShaderPart, parameter

_PLACE = (
    "float across = position[0] * inverse_normalization; "
    "float up = position[1] * inverse_normalization; "
)
_INVERSE = parameter(
    "float",
    "inverse_normalization",
    "1.0",
    "Inverse Normalization",
    "1 over the normalization length in scene units",
)


def even_radial_part(
    spec: EvenRadialSpec, units_per_mm: float, reach_mm: float | None = None
) -> ShaderPart:
    """The shader's part for an even polynomial of the radius.

    Args:
        spec: The polynomial.
        units_per_mm: Scene units in one mm.
        reach_mm: Length that the powers are scaled to, unless it is the normalization.

    Returns:
        Its part; the text depends on the number of coefficients only.
    """
    length_mm = reach_mm or spec.normalization_mm
    grows = length_mm / spec.normalization_mm
    slopes = even_radial_from(spec).slope_factors
    factors = [slope * grows ** (2 * place + 1) for place, slope in enumerate(slopes)]
    names = {place: f"radial_{2 * place}" for place in range(1, len(factors) + 1)}
    sums = _nested({place - 1: name for place, name in names.items()}, "square")
    return ShaderPart(
        parameters=_declared(names.values(), "Slope of the power of rho"),
        code=(
            f"{{ {_PLACE}float square = across * across + up * up; "
            f"float factor = {sums}; gradient = factor * vector(across, up, 0.0); }}"
        ),
        sockets={
            "inverse_normalization": 1.0 / (length_mm * units_per_mm),
            **{name: factors[place - 1] for place, name in names.items()},
        },
    )


def polynomial_part(
    spec: PolynomialSpec, units_per_mm: float, reach_mm: float | None = None
) -> ShaderPart:
    """The shader's part for a polynomial of x and y.

    Args:
        spec: The polynomial.
        units_per_mm: Scene units in one mm.
        reach_mm: Length that the powers are scaled to, unless it is the normalization.

    Returns:
        Its part; the text depends on the powers only.
    """
    length_mm = reach_mm or spec.normalization_mm
    grows = length_mm / spec.normalization_mm
    scale = metres_per_unit(spec.unit, spec.wavelength_nm) / (spec.normalization_mm * 1e-3)
    terms = sorted(spec.terms, key=lambda term: (term.x, term.y))
    names = {(term.x, term.y): f"term_{term.x}_{term.y}" for term in terms}
    along_x = {(i - 1, j): f"{i}.0 * {name}" for (i, j), name in names.items() if i}
    along_y = {(i, j - 1): f"{j}.0 * {name}" for (i, j), name in names.items() if j}
    return ShaderPart(
        parameters=_declared(names.values(), "Coefficient over the normalization"),
        code=(
            f"{{ {_PLACE}gradient = vector({_nested_twice(along_x)}, "
            f"{_nested_twice(along_y)}, 0.0); }}"
        ),
        sockets={
            "inverse_normalization": 1.0 / (length_mm * units_per_mm),
            **{
                names[term.x, term.y]: scale * term.coefficient * grows ** (term.x + term.y - 1)
                for term in terms
            },
        },
    )


def zernike_part(spec: ZernikeSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for Zernike polynomials.

    Args:
        spec: The sum.
        units_per_mm: Scene units in one mm.

    Returns:
        Its part; the text depends on the indices only.
    """
    scale = metres_per_unit(spec.unit, spec.wavelength_nm) / (spec.normalization_mm * 1e-3)
    order, _ = ORDERS[spec.index]
    sockets: dict[str, float] = {}
    series: dict[int, dict[int, str]] = {}
    for index in sorted(spec.coefficients, key=int):
        n, m, factor = order(int(index))
        name = f"zernike_{index}"
        sockets[name] = scale * factor * spec.coefficients[index]
        series.setdefault(m, {})[(n - abs(m)) // 2] = name
    names = ", ".join(sockets)
    return ShaderPart(
        functions=_zernike_function(dict(sorted(series.items())), list(sockets)),
        parameters=_declared(sockets, "Coefficient over the normalization"),
        code=f"{{ {_PLACE}gradient = hoe_zernike(across, up, {names}); }}",
        sockets={"inverse_normalization": 1.0 / (spec.normalization_mm * units_per_mm), **sockets},
    )


def _zernike_function(series: Mapping[int, Mapping[int, str]], names: list[str]) -> str:
    """Write the gradient: Jacobi polynomials of rho^2 times harmonics, as in the core."""
    highest = max(abs(m) for m in series)
    lines = [
        "float along_x = 0.0;",
        "float along_y = 0.0;",
        "float s = 2.0 * (across * across + up * up) - 1.0;",
        # Real and imaginary part of (across + i up)^m.
        "float real_0 = 1.0;",
        "float imag_0 = 0.0;",
    ]
    for m in range(1, highest + 1):
        lines += [
            f"float real_{m} = real_{m - 1} * across - imag_{m - 1} * up;",
            f"float imag_{m} = real_{m - 1} * up + imag_{m - 1} * across;",
        ]
    lines.append(
        "float total; float rise; float below; float here; float slope_below; "
        "float slope; float next;"
    )
    for m, factors in series.items():
        lines += _jacobi_lines(abs(m), factors)
        lines += _harmonic_lines(m)
    arguments = ", ".join(f"float {name}" for name in ("across", "up", *names))
    body = "".join(f"    {line}\n" for line in lines)
    return (
        f"vector hoe_zernike({arguments})\n"
        f"{{\n{body}    return vector(along_x, along_y, 0.0);\n}}\n"
    )


def _jacobi_lines(m: int, factors: Mapping[int, str]) -> list[str]:
    """Sum a series of Jacobi polynomials and its slope, by their recurrence."""
    lines = [
        f"total = {factors.get(0, '0.0')};",
        "rise = 0.0; below = 0.0; here = 1.0; slope_below = 0.0; slope = 0.0;",
    ]
    for degree in range(1, max(factors) + 1):
        a, b, c = (f"{value:.9g}" for value in jacobi_step(m, degree))
        lines += [
            f"next = {a} * here + ({a} * s + {b}) * slope - {c} * slope_below;",
            "slope_below = slope; slope = next;",
            f"next = ({a} * s + {b}) * here - {c} * below;",
            "below = here; here = next;",
        ]
        if degree in factors:
            lines.append(f"total += {factors[degree]} * here; rise += {factors[degree]} * slope;")
    return lines


def _harmonic_lines(m: int) -> list[str]:
    """Add the gradient of the series times its harmonic."""
    power = abs(m)
    harmonic = f"{'real' if m >= 0 else 'imag'}_{power}"
    lines = [
        f"along_x += 4.0 * across * rise * {harmonic};",
        f"along_y += 4.0 * up * rise * {harmonic};",
    ]
    if m > 0:
        lines += [
            f"along_x += total * {power}.0 * real_{power - 1};",
            f"along_y -= total * {power}.0 * imag_{power - 1};",
        ]
    if m < 0:
        lines += [
            f"along_x += total * {power}.0 * imag_{power - 1};",
            f"along_y += total * {power}.0 * real_{power - 1};",
        ]
    return lines


def _declared(names: Iterable[str], words: str) -> str:
    coefficients = (
        parameter("float", name, "0.0", name.replace("_", " ").title(), words) for name in names
    )
    return " ".join((_INVERSE, *coefficients))


def _nested_twice(terms: Mapping[tuple[int, int], str]) -> str:
    rows: dict[int, dict[int, str]] = {}
    for (i, j), text in terms.items():
        rows.setdefault(i, {})[j] = text
    return _nested({i: _nested(row, "up") for i, row in rows.items()}, "across")


def _nested(factors: Mapping[int, str], name: str) -> str:
    """Write a polynomial as nested products: ``((c) * s * s + b) * s + a``."""
    if not factors:
        return "0.0"
    powers = sorted(factors, reverse=True)
    text = factors[powers[0]]
    for above, power in pairwise(powers):
        text = f"({text}){f' * {name}' * (above - power)} + {factors[power]}"
    return f"({text}){f' * {name}' * powers[-1]}"
