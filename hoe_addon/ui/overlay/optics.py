# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ways of light through the optics of a recording: back from the element to the source."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray, as_float, dot
from ...core.ray_fitting import OpticalSurface, OpticalSystem
from ...core.ray_law import diffract
from ...core.tracer import Frame
from ...core.units import m_to_mm, mm_to_m
from ...core.waves import PlaneWave, PointSource
from ...model.waves import WindowSourceSpec
from .lines import circle, path

_SPOKES = 12


@dataclass(frozen=True, eq=False)
class TracedBack:
    """Ways of n rays, all in mm.

    Attributes:
        places: From the element back to the first surface, shape ``(1 + s, n, 3)``.
        way: Unit directions in which light comes to the first surface, shape ``(n, 3)``.
    """

    places: FloatArray
    way: FloatArray


def window_system(wave: WindowSourceSpec) -> OpticalSystem:
    """Give a flat window before a point as a chain of two surfaces.

    Args:
        wave: The wave; one that converges runs the other way.

    Returns:
        The chain as light of a source in the point meets it.
    """
    window = wave.window
    normal = as_float(window.normal) / np.linalg.norm(window.normal)
    near = mm_to_m(as_float(window.position_mm))
    far = near + mm_to_m(window.thickness_mm) * normal
    wide = float(mm_to_m(window_radius_mm(wave)))
    faces = tuple(
        OpticalSurface(Frame.at(place, normal), np.inf, 0.0, wide, index)
        for place, index in ((near, window.index), (far, wave.index))
    )
    x, y, z = (float(value) for value in mm_to_m(as_float(wave.position_mm)))
    return OpticalSystem(PointSource((x, y, z), index=wave.source_index), faces)


def window_radius_mm(wave: WindowSourceSpec) -> float:
    """Half the side of the plate that is drawn for a window, which has no size of its own."""
    return 0.5 * float(np.linalg.norm(np.subtract(wave.window.position_mm, wave.position_mm)))


def traced_back(system: OpticalSystem, points_mm: FloatArray, way: FloatArray) -> TracedBack:
    """Follow light back through a chain of surfaces; apertures stop nothing.

    Args:
        system: The chain.
        points_mm: Where light arrives, shape ``(n, 3)``.
        way: Unit directions in which it arrives, shape ``(n, 3)``.

    Returns:
        Its ways; NaN from where there is none.
    """
    place, back = mm_to_m(points_mm), -way
    places = [place]
    indices = system.indices
    for number in range(len(system.surfaces) - 1, -1, -1):
        surface = system.surfaces[number]
        start, heading = surface.frame.point_to_local(place), surface.frame.vector_to_local(back)
        far = surface.shape.intersect(start, heading)
        hit = start + far[:, None] * heading
        out, _ = diffract(
            heading,
            surface.shape.normal(hit),
            np.zeros(3),
            0,
            1.0,
            indices[number + 1],
            indices[number],
            surface.index_after is None,
        )
        place, back = surface.frame.point_to_world(hit), surface.frame.vector_to_world(out)
        places.append(place)
    return TracedBack(m_to_mm(np.stack(places)), -back)


def source_ends_mm(system: OpticalSystem, back: TracedBack, length_mm: float) -> FloatArray:
    """Where light comes from before the first surface.

    Args:
        system: The chain.
        back: Its rays.
        length_mm: Length of what is drawn of a plane wave, or of a far point's rays.

    Returns:
        Places in mm, shape ``(n, 3)``.
    """
    source, first = system.source, back.places[-1]
    if isinstance(source, PlaneWave) or source.converging:
        return first - length_mm * back.way
    point = m_to_mm(as_float(source.position))
    # The rays meet in the point but for rounding; their own ends show a mistake.
    return first - dot(first - point, back.way)[:, None] * back.way


def surfaces_mm(system: OpticalSystem) -> FloatArray:
    """Draw the rims of optics, and their profiles in two planes.

    Args:
        system: The chain.

    Returns:
        Pieces, shape ``(n, 2, 3)``.
    """
    found: list[FloatArray] = []
    for surface in system.surfaces:
        frame, radius = surface.frame, surface.semi_diameter
        edge = float(surface.shape.sag(radius, 0.0))
        middle = frame.point_to_world(np.array((0.0, 0.0, edge)))
        found.append(m_to_mm(circle(middle, frame.rotation[:, 2], radius)))
        along = radius * np.linspace(-1.0, 1.0, _SPOKES + 1)
        none = np.zeros_like(along)
        sag = surface.shape.sag(along, 0.0)
        for profile in ((along, none, sag), (none, along, sag)):
            found.append(m_to_mm(path(frame.point_to_world(np.stack(profile, axis=-1)))))
    return np.concatenate(found)
