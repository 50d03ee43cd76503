# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The relief of a thin model as a cross-section for the rigorous one, and back."""

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.fabrication import with_walls
from ...core.efficiency.profiles import Binary, Profile, Sawtooth, Sinusoid
from ...core.efficiency.segments import Segments, Steps
from ...core.errors import SpecError

SINUSOID_CORNERS = 128
"""Corners of the polygon that stands for a sinusoidal relief."""


def pieces_of(profile: Profile) -> Segments:
    """Give a relief as straight pieces.

    Args:
        profile: One period of it.

    Returns:
        Its pieces; those of a sinusoid are chords.

    Raises:
        SpecError: It has no cross-section.
    """
    match profile:
        case Segments():
            return profile
        case Steps():
            return profile.segments()
        case Sawtooth():
            return _sawtooth(profile)
        case Binary():
            edge = 0.5 * (1.0 - profile.duty)
            return _level((0.0, edge, 1.0 - edge, 1.0), (0.0, 1.0, 0.0))
        case Sinusoid():
            edges = np.linspace(0.0, 1.0, SINUSOID_CORNERS + 1)
            heights = 0.5 * (1.0 - np.cos(2.0 * np.pi * edges))
            return Segments(edges, heights[:-1], heights[1:])
        case _:
            raise SpecError(f"profile: {type(profile).__name__} has no cross-section")


def _sawtooth(profile: Sawtooth) -> Segments:
    width, levels = profile.edge_width, profile.levels
    if levels:
        stairs = Steps((np.arange(levels) + 0.5) / levels).segments()
        return with_walls(stairs, width) if width > 0.0 else stairs
    if width == 0.0:
        return Segments(np.array((0.0, 1.0)), np.zeros(1), np.ones(1))
    edges = np.array((0.0, 1.0 - width, 1.0))
    return Segments(edges, np.array((0.0, 1.0)), np.array((1.0, 0.0)))


def _level(edges: tuple[float, ...], heights: tuple[float, ...]) -> Segments:
    values = np.asarray(heights)
    return Segments(np.asarray(edges), values, values)


def outline(pieces: Segments, depth_um: float, *, on_front: bool) -> list[tuple[float, float]]:
    """Draw a relief as a closed polygon with its lowest point at height 0.

    Args:
        pieces: One period of the relief, heights in whole depths.
        depth_um: One whole depth, micrometres.
        on_front: Whether the relief hangs from the front medium instead of standing on the back.

    Returns:
        Corners x, in periods, and z, in micrometres; what is inside is the relief.
    """
    x = np.stack((pieces.edges[:-1], pieces.edges[1:]), axis=1).ravel()
    heights: FloatArray = np.stack((pieces.start, pieces.end), axis=1).ravel()
    z = (heights - heights.min()) * depth_um
    foot = 0.0
    if on_front:
        foot = float(z.max())
        z = foot - z
    upper = [(float(a), float(b)) for a, b in zip(x, z, strict=True)]
    first, last = (float(x[0]), foot), (float(x[-1]), foot)
    corners = [first, *upper, last]
    return [corner for place, corner in enumerate(corners) if corner != corners[place - 1]]
