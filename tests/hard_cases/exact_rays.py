# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves and the ray law with 50 digits, from documents as they are written."""

from collections.abc import Sequence
from typing import Any

from mpmath import mp, mpf

DIGITS = 50

type Vector = list[mpf]


def exact(values: Sequence[float]) -> Vector:
    """Take numbers as the binary fractions that they are."""
    return [mpf(float(value)) for value in values]


def less(first: Vector, second: Vector) -> Vector:
    """First minus second."""
    return [a - b for a, b in zip(first, second, strict=True)]


def along(first: Vector, second: Vector) -> mpf:
    """Scalar product."""
    return sum((a * b for a, b in zip(first, second, strict=True)), mpf(0))


def times(factor: mpf, vector: Vector) -> Vector:
    """A vector, scaled."""
    return [factor * value for value in vector]


def length(vector: Vector) -> mpf:
    """Its length."""
    return mpf(mp.sqrt(along(vector, vector)).real)


def unit(vector: Vector) -> Vector:
    """Scaled to length 1."""
    return times(1 / length(vector), vector)


def without(vector: Vector, axis: Vector) -> Vector:
    """The part at a right angle to a unit vector."""
    return less(vector, times(along(vector, axis), axis))


def wave(document: dict[str, Any], point_mm: Sequence[float]) -> Vector:
    """The wave's n s at a point.

    Args:
        document: The wave; an extended source is a rectangle, square to z, of which the point at
            the shares in ``draws`` sends.
        point_mm: The point.

    Returns:
        Three numbers.
    """
    place = exact(point_mm)
    match document["kind"]:
        case "plane":
            away = exact(document["direction"])
        case "point":
            away = less(place, exact(document["position_mm"]))
        case "extended":
            away = less(place, _drawn(document))
        case "astigmatic":
            away = _from_arc(document, place)
        case _:
            away = _behind_window(document, place)
    sign = -1 if document.get("beam") == "converging" else 1
    return times(sign * mpf(float(document.get("index", 1.0))), unit(away))


def gradient(recording: dict[str, Any], point_mm: Sequence[float]) -> Vector:
    """The recording's n_O s_O - n_R s_R at a point."""
    return less(wave(recording["object"], point_mm), wave(recording["reference"], point_mm))


def diffracted(
    incident: Sequence[float],
    vector: Vector,
    steps: mpf,
    indices: tuple[float, float],
    *,
    reflected: bool,
) -> tuple[mpf, Vector | None]:
    """The ray law on the plane z = 0.

    Args:
        incident: Direction of travel, of any length.
        vector: What `gradient` returned.
        steps: The order times the wavelength over that of the recording.
        indices: Those of the back, z < 0, and of the front.
        reflected: Whether the order goes back.

    Returns:
        (n' cos')^2, and the unit direction, or None for an evanescent order.
    """
    heading = unit(exact(incident))
    forward = heading[2] >= 0
    before, behind = exact(indices) if forward else exact(indices)[::-1]
    leaving = before if reflected else behind
    tangent = [before * heading[axis] + steps * vector[axis] for axis in (0, 1)]
    squared = leaving**2 - along(tangent, tangent)
    if squared < 0:
        return squared, None
    onward = 1 if forward != reflected else -1
    return squared, times(1 / leaving, [*tangent, onward * mp.sqrt(squared)])


def _drawn(document: dict[str, Any]) -> Vector:
    halves = times(mpf(1) / 2, exact(document["shape"]["size_mm"]))
    shares = exact(document["draws"])
    centre = exact(document["position_mm"])
    return [
        *(centre[axis] + (2 * shares[axis] - 1) * halves[axis] for axis in (0, 1)),
        centre[2],
    ]


def _from_arc(document: dict[str, Any], place: Vector) -> Vector:
    """From the arc's point in the half plane of the place, or beyond the line, to the place."""
    first, second = exact(document["first_mm"]), exact(document["second_mm"])
    chief = unit(less(second, first))
    line = unit(without(exact(document["line_direction"]), chief))
    across = without(less(place, first), line)
    side = 1 if along(across, chief) > 0 else -1
    arc = times(side * length(less(second, first)), unit(across))
    return less(less(place, first), arc)


def _behind_window(document: dict[str, Any], place: Vector) -> Vector:
    """The direction by Snell's law, whose invariant n sin is found by halving an interval."""
    window = document["window"]
    axis = unit(exact(window.get("normal", (0, 0, 1))))
    source, face = exact(document["position_mm"]), exact(window["position_mm"])
    thickness = mpf(float(window.get("thickness_mm", 0.0)))
    layers = [
        (along(less(face, source), axis), mpf(float(document.get("source_index", 1.0)))),
        (thickness, mpf(float(window.get("index", 1.0)))),
        (along(less(place, face), axis) - thickness, mpf(float(document.get("index", 1.0)))),
    ]
    present = [(thick, index) for thick, index in layers if thick > 0]
    sideways = without(less(place, source), axis)
    reach = length(sideways)
    if reach == 0:
        return axis
    low, high = mpf(0), mpf(1)
    lowest = min(index for _thick, index in present)
    # The cosine in the layer of lowest index is halved, so that grazing rays keep their digits.
    for _ in range(4 * DIGITS):
        middle = (low + high) / 2
        if _lateral(present, _invariant_squared(lowest, middle)) > reach:
            low = middle
        else:
            high = middle
    squared = _invariant_squared(lowest, high)
    index = layers[2][1]
    tangent = mp.sqrt(squared / (index**2 - squared))
    return [a + tangent * b for a, b in zip(axis, unit(sideways), strict=True)]


def _invariant_squared(index: mpf, cosine: mpf) -> mpf:
    return index**2 * (1 - cosine) * (1 + cosine)


def _lateral(layers: list[tuple[mpf, mpf]], squared: mpf) -> mpf:
    return sum((thick * mp.sqrt(squared / (index**2 - squared)) for thick, index in layers), mpf(0))
