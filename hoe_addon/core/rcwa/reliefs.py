# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of the usual reliefs. A relief stands on the back: the ridge rises from z = 0."""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float
from ..errors import SpecError
from .profiles import Polygon, polygon_layers
from .stack import BACK, FRONT, Lamellar, Layer


def binary(
    depth: float, duty: float = 0.5, *, ridge: int = BACK, groove: int = FRONT
) -> tuple[Layer, ...]:
    """Return a rectangular relief with its ridge about x = 0.

    Args:
        depth: Metres, above 0.
        duty: Width of the ridge over the period, above 0 and below 1.
        ridge: Material of the ridge.
        groove: Material beside it.
    """
    _check(depth)
    if not 0.0 < duty < 1.0:
        raise SpecError(f"duty: must be above 0 and below 1, got {duty}")
    walls = np.array([-0.5 * duty, 0.5 * duty])
    return (Layer(Lamellar(walls, (ridge, groove)), depth),)


def sinusoid(
    depth: float, slices: int, *, ridge: int = BACK, groove: int = FRONT
) -> tuple[Layer, ...]:
    """Return a relief of height ``depth (1 + cos(2 pi x)) / 2`` in layers of equal thickness.

    Args:
        depth: From the bottom of the groove to the top of the ridge, metres, above 0.
        slices: Number of layers.
        ridge: Material of the ridge.
        groove: Material beside it.
    """
    _check(depth)
    heights = (np.arange(slices) + 0.5) / slices
    half = np.arccos(2.0 * heights - 1.0) / (2.0 * np.pi)
    return tuple(
        Layer(Lamellar(np.array([-width, width]), (ridge, groove)), depth / slices)
        for width in half
    )


def triangle(
    depth: float,
    slices: int,
    apex: float = 0.5,
    *,
    ridge: int = BACK,
    groove: int = FRONT,
) -> tuple[Layer, ...]:
    """Return a triangular relief over the whole period; the apex at 1 makes a sawtooth.

    With the apex at 1 the height grows along x as does the phase of a kinoform.

    Args:
        depth: Metres, above 0.
        slices: Number of layers.
        apex: Where the ridge is highest, in periods from the start of the period.
        ridge: Material of the ridge.
        groove: Material beside it.
    """
    _check(depth)
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [apex, depth]])
    return polygon_layers([Polygon(corners, ridge)], groove, slices)


def trapezoid(
    depth: float,
    foot: tuple[float, float],
    top: tuple[float, float],
    slices: int,
    *,
    ridge: int = BACK,
    groove: int = FRONT,
) -> tuple[Layer, ...]:
    """Return a ridge with two straight walls, slanted or overhanging.

    Args:
        depth: Metres, above 0.
        foot: Where the ridge begins and ends along x at its foot, in periods.
        top: The same at its top.
        slices: Number of layers; one is enough for upright walls.
        ridge: Material of the ridge.
        groove: Material beside it.
    """
    _check(depth)
    corners = [[foot[0], 0.0], [foot[1], 0.0], [top[1], depth], [top[0], depth]]
    return polygon_layers([Polygon(np.array(corners), ridge)], groove, slices)


def staircase(
    depth: float, levels: int, *, ridge: int = BACK, groove: int = FRONT
) -> tuple[Layer, ...]:
    """Return a kinoform of N levels of the heights ``k depth / N``, k = 0 .. N - 1, along x.

    Args:
        depth: Depth of the continuous relief that the steps follow, metres, above 0.
        levels: Number of levels N, at least 2.
        ridge: Material of the steps.
        groove: Material above them.
    """
    _check(depth)
    if levels < 2:
        raise SpecError(f"levels: must be at least 2, got {levels}")
    layers: list[Layer] = []
    for level in range(1, levels):
        width = 1.0 - level / levels
        walls = np.array([-0.5 * width, 0.5 * width])
        middle = 1.0 - 0.5 * width
        layers.append(Layer(Lamellar(walls, (ridge, groove)), depth / levels, middle))
    return tuple(layers)


def sampled(
    depth: float, heights: ArrayLike, slices: int, *, ridge: int = BACK, groove: int = FRONT
) -> tuple[Layer, ...]:
    """Return a relief of any single-valued height.

    Args:
        depth: Metres, above 0.
        heights: Heights over the depth at the places ``k / N`` of the period, in [0, 1], straight
            lines in between and round to the first; shape ``(N,)``.
        slices: About how many layers.
        ridge: Material of the ridge.
        groove: Material above it.
    """
    _check(depth)
    values = as_float(heights)
    if values.ndim != 1 or len(values) < 2:
        raise SpecError(f"heights: must be a list of 2 or more, got the shape {values.shape}")
    if not np.all((values >= 0.0) & (values <= 1.0)):
        worst = int(np.argmax(~((values >= 0.0) & (values <= 1.0))))
        raise SpecError(f"heights[{worst}]: must be from 0 to 1, got {values[worst]}")
    if np.ptp(values) == 0.0:
        raise SpecError("heights: must not all be equal")
    outline = Polygon(_outline(values, depth), ridge)
    return polygon_layers([outline], groove, slices, checked=True)


def _outline(values: FloatArray, depth: float) -> FloatArray:
    """Corners of the relief of one period, closed below at height 0."""
    places = np.arange(len(values) + 1) / len(values)
    round_to_first = np.append(values, values[0]) * depth
    upper = np.stack((places, round_to_first), axis=1)[::-1]
    return np.concatenate(([[0.0, 0.0], [1.0, 0.0]], upper))


def _check(depth: float) -> None:
    if not (np.isfinite(depth) and depth > 0.0):
        raise SpecError(f"depth: must be above 0, got {depth}")
