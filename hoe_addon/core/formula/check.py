# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where on an element a formula has no value, or divides by zero."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray
from .evaluate import evaluate
from .formula import Formula
from .graph import Op

type Covers = Callable[[FloatArray, FloatArray], BoolArray]
"""Which places (x, y) count."""

type _Function = Callable[[FloatArray, FloatArray], FloatArray]

_NODES = 65
"""Places along an axis that are looked at; odd, so that the centre is one."""

_ZERO = 1e-12
"""A divisor this small, relative to its size one step of the grid away, counts as zero."""

_HALVINGS = 60
"""Steps of the search between two places where a divisor has opposite signs."""

_ZOOMS = 24
"""Steps of the search for the smallest divisor; each looks at a window 4 times smaller."""

_NEAR = (1e-5, 1e-8)
"""Distances around a place without a gradient, relative to the element, where it is looked at."""

_NEARER = (1e-8, 1e-11)
"""The same at a zero that was followed as far as digits go: one just beside the element, where the
gradient is steep and bounded, must not count."""

_ROOT = 1.1
"""A root, up to the tenth, of what has a zero between two places differs by more between them."""

_GROWTH = 1.5
"""A gradient that grows by more than this between the two distances is not bounded. A kink's
stays as it is; that of ``r^0.9`` doubles."""


_SINGULAR = {
    Op.DIVIDE: "it divides by zero",
    Op.TAN: "it has the tangent of a right angle",
    Op.LOG: "it has the logarithm of zero",
}


@dataclass(frozen=True)
class Trouble:
    """A place where a formula cannot be used.

    Attributes:
        x: In the formula's unit.
        y: The same.
        what: What happens there, as the end of a sentence.
    """

    x: float
    y: float
    what: str


def find_trouble(
    formula: Formula, corners: tuple[float, float, float, float], inside: Covers
) -> Trouble | None:
    """Look over a rectangle for a place where a formula or its gradient has no finite value.

    Every divisor is looked at too: between the places of the grid it is followed to its zero
    where it changes sign, and to its smallest size where it does not. A gradient that is only not
    defined at a kink, such as that of r at the origin, is no trouble while it stays bounded
    around; nor is the centre of a vortex such as ``phi``.

    Args:
        formula: The formula.
        corners: Left, right, lower and upper end of the rectangle, in the formula's unit.
        inside: Tells of x and y, equal shapes, which places count, same shape.

    Returns:
        The first trouble found, or None.
    """
    left, right, lower, upper = corners
    x, y = np.meshgrid(np.linspace(left, right, _NODES), np.linspace(lower, upper, _NODES))
    # The middle of a symmetric range must be zero itself, and not the rounding of a sum.
    x[np.abs(x) < 1e-12 * (right - left)] = 0.0
    y[np.abs(y) < 1e-12 * (upper - lower)] = 0.0
    size = float(np.hypot(right - left, upper - lower))
    return (
        _zero_divisor(formula, x, y, inside)
        or _first(x, y, inside(x, y) & ~np.isfinite(formula.at(x, y)), "it has no finite value")
        or _steep_place(formula, x, y, size, inside)
        or _unbounded(formula, x, y, size, inside)
    )


def _first(x: FloatArray, y: FloatArray, where: BoolArray, what: str) -> Trouble | None:
    found = np.argwhere(where)
    if not len(found):
        return None
    place = tuple(found[0].tolist())
    return Trouble(float(x[place]), float(y[place]), what)


def _divisors(formula: Formula) -> dict[int, Op]:
    """Expressions that must not reach a value, and the operation that must not get it."""
    graph = formula.graph
    found = {
        graph.nodes[place].args[-1]: graph.nodes[place].op
        for place in graph.needed(formula.value)
        if graph.nodes[place].op in _SINGULAR
    }
    return {place: op for place, op in found.items() if graph.constant(place) is None}


def _steep_place(
    formula: Formula, x: FloatArray, y: FloatArray, size: float, inside: Covers
) -> Trouble | None:
    """Follow the divisors of the gradient to their zeros, and see whether it is bounded there."""
    graph = formula.graph
    divisors = {
        graph.nodes[place].args[-1]
        for slope in formula.slopes
        for place in graph.needed(slope)
        if graph.nodes[place].op is Op.DIVIDE
        or (graph.nodes[place].op is Op.POWER and graph.nodes[place].value < 0.0)
    }
    # Those of the value itself have been followed already.
    for place in divisors - set(_divisors(formula)):
        if graph.constant(place) is not None:
            continue

        def divisor(across: FloatArray, up: FloatArray, place: int = place) -> FloatArray:
            (value,), finite = evaluate(graph, [place], across, up)
            return np.where(finite & inside(across, up), value, np.nan)

        values = divisor(x, y)
        # A root changes by a tenth at least from one place to the next, with a zero between.
        if not np.isfinite(values).any() or _variation(values) < _ROOT:
            continue
        crossing = _crossing(divisor, x, y, values, "")
        least, _ = _smallest(divisor, x, y, values)
        here = least if crossing is None else np.array((crossing.x, crossing.y))
        here = here[:1], here[1:]
        if not (formula.is_angular and np.hypot(*here)[0] == 0.0):
            trouble = _growing(formula, *here, size, _NEARER)
            if trouble is not None:
                return trouble
    return None


def _zero_divisor(formula: Formula, x: FloatArray, y: FloatArray, inside: Covers) -> Trouble | None:
    for place, op in _divisors(formula).items():

        def divisor(
            across: FloatArray, up: FloatArray, place: int = place, op: Op = op
        ) -> FloatArray:
            (value,), finite = evaluate(formula.graph, [place], across, up)
            value = np.where(finite & inside(across, up), value, np.nan)
            return np.cos(value) if op is Op.TAN else value

        what = _SINGULAR[op]
        values = divisor(x, y)
        if np.isfinite(values).any():
            trouble = _crossing(divisor, x, y, values, what) or _least(divisor, x, y, values, what)
            if trouble is not None:
                return trouble
    return None


def _crossing(
    divisor: _Function, x: FloatArray, y: FloatArray, values: FloatArray, what: str
) -> Trouble | None:
    """Look for a zero between neighbours of opposite sign, by halving; a jump is none."""
    places = np.stack((x, y), axis=-1)
    starts: list[FloatArray] = []
    ends: list[FloatArray] = []
    for first, second in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1, :], np.s_[1:, :])):
        across = np.sign(values[first]) * np.sign(values[second]) < 0.0
        starts.append(places[first][across])
        ends.append(places[second][across])
    start, end = np.concatenate(starts), np.concatenate(ends)
    if not len(start):
        return None
    first_size = np.abs(divisor(start[:, 0], start[:, 1]))
    sign = np.sign(divisor(start[:, 0], start[:, 1]))
    for _ in range(_HALVINGS):
        middle = 0.5 * (start + end)
        same = (np.sign(divisor(middle[:, 0], middle[:, 1])) == sign)[:, None]
        start, end = np.where(same, middle, start), np.where(same, end, middle)
    zero = np.abs(divisor(end[:, 0], end[:, 1])) <= _ZERO * first_size
    return _first(end[:, 0], end[:, 1], zero, what)


def _least(
    divisor: _Function, x: FloatArray, y: FloatArray, values: FloatArray, what: str
) -> Trouble | None:
    """Look for a zero near the smallest divisor of the grid."""
    if _variation(values) < 2.0:
        return None  # It changes too slowly to reach zero within a step.
    here, step = _smallest(divisor, x, y, values)
    return _first(here[:1], here[1:], np.abs(divisor(here[:1], here[1:])) <= _ZERO * step, what)


def _variation(values: FloatArray) -> float:
    """Return how many times its smallest size a divisor reaches one step of the grid away."""
    row, column = divmod(int(np.nanargmin(np.abs(values))), values.shape[1])
    around = np.abs(values[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2])
    least = float(np.nanmin(around))
    return float(np.nanmax(around)) / least if least > 0.0 else np.inf


def _smallest(
    divisor: _Function, x: FloatArray, y: FloatArray, values: FloatArray
) -> tuple[FloatArray, float]:
    """Follow the smallest divisor of the grid closer and closer.

    Returns its place, and the size of the divisor one step of the grid away.
    """
    low, high = np.array((x.min(), y.min())), np.array((x.max(), y.max()))
    steps = np.linspace(-1.0, 1.0, 17)
    best = np.nanargmin(np.abs(values))
    here: FloatArray = np.array((x.ravel()[best], y.ravel()[best]))
    reach = (high - low) / (_NODES - 1)
    step = 0.0
    for zoom in range(_ZOOMS):
        window = np.clip(here[:, None] + reach[:, None] * steps, low[:, None], high[:, None])
        across, up = np.broadcast_arrays(window[0], window[1][:, None])
        size = np.abs(divisor(across, up))
        if zoom == 0:
            step = float(np.nanmax(size))
        best = np.argmin(np.where(np.isfinite(size), size, np.inf))
        here = np.array((across.ravel()[best], up.ravel()[best]))
        reach = reach / 4.0
    return here, step


def _unbounded(
    formula: Formula, x: FloatArray, y: FloatArray, size: float, inside: Covers
) -> Trouble | None:
    missing = inside(x, y) & ~np.isfinite(formula.gradient(x, y)).all(axis=-1)
    if formula.is_angular:
        missing &= np.hypot(x, y) > 0.0
    return _growing(formula, x[missing], y[missing], size, _NEAR)


def _growing(
    formula: Formula,
    across: FloatArray,
    up: FloatArray,
    size: float,
    distances: tuple[float, float],
) -> Trouble | None:
    """Return the first place around which the gradient grows without bound."""
    far, near = (_largest_around(formula, across, up, distance * size) for distance in distances)
    with np.errstate(invalid="ignore"):
        bounded = np.isfinite(far) & (near <= _GROWTH * far)
    return _first(across, up, ~bounded, "its gradient has no finite value")


def _largest_around(formula: Formula, x: FloatArray, y: FloatArray, distance: float) -> FloatArray:
    """Return the largest gradient at eight places around; places off the grid's own lines."""
    angles = 0.3 + np.arange(8.0) * (np.pi / 4.0)
    around = formula.gradient(
        x[:, None] + distance * np.cos(angles), y[:, None] + distance * np.sin(angles)
    )
    # A place just outside the element may have no value: what counts is what is around inside.
    length = np.linalg.norm(around, axis=-1)
    return np.max(np.where(np.isnan(length), -np.inf, length), axis=-1, initial=-np.inf)
