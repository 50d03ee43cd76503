# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The exact shape of a hologram, its facets for a renderer, and the error that facets add.

Two kinds of error are stated as an angle in radians:

- Formula: the shader moves each hit from the facet to the true surface, so directions are exact.
  What is left is parallax: the ray goes on from the facet, at a distance d from the true
  surface. Stated is d times the larger of the curvature and one over the width: the turn of the
  normal, or of the line of sight from one width away, over that distance.
- Mesh: at an incidence of up to 45 degrees, a displacement d of the facet moves the hit by at most
  sqrt(2) d. With the error e of the interpolated normal, the curvature k, the indices n and n' and
  the largest normal part g and change |dg/dx| of the recorded gradient, the direction is off by
  ``sqrt(2) ((n + n' + g) (e + k d) + sqrt(2) |dg/dx| d)``, for order +-1 at the recording
  wavelength. d and e are those of flat against curved triangles, plus an estimate of what the
  curved triangles miss.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import msgspec
import numpy as np

from ..core.arrays import FloatArray, dot
from ..core.pattern import Pattern
from ..core.shapes import MeshShape, Plane, Shape
from ..core.shapes.refine import (
    Departure,
    facet_departure,
    largest_curvature,
    patch_departure,
    refined,
)
from ..core.shapes.tessellate import departure_from, ellipse_mesh, rectangle_mesh
from ..core.units import m_to_mm, mm_to_m, nm_to_m
from .convert import pattern_from
from .hologram import HologramSpec
from .medium import medium_from
from .mesh_surface import MeshSurface
from .pattern import PatternSpec
from .surface import FormulaSurface

DIRECTION_ERROR = 1e-4
"""Radians: refinement goes on until the stated error is below."""

MAX_TRIANGLES = 200_000
"""Refinement stops here, whatever the error is."""

_FEWEST_CELLS = 8
_MORE_CROSSINGS = 3
"""After the first; a sphere or a conic has one more, an asphere may have a few."""

_BEYOND_MM = 1e-6
_STEP = 1e-4
"""Step of the differences that give the change of the gradient, as a share of the mesh."""


@dataclass(frozen=True, eq=False)
class ElementMesh:
    """The facets of an element.

    Attributes:
        mesh: Triangles with smooth normals, metres.
        direction_error: Stated error of directions in radians; see the module.
        parts: Into how many parts each edge of the document's mesh was split.
    """

    mesh: MeshShape
    direction_error: float
    parts: int = 1


@dataclass(frozen=True)
class _Optics:
    """What the error of a mesh depends on, besides the mesh; equal where it is written alike."""

    text: bytes
    pattern: PatternSpec = field(compare=False)
    indices: float


def element_shape(spec: HologramSpec) -> Shape:
    """Make the exact surface of a hologram.

    Args:
        spec: The hologram.

    Returns:
        Its shape in metres; for a mesh that is to be refined, the refined one.
    """
    if isinstance(spec.surface, MeshSurface):
        return element_mesh(spec).mesh
    return spec.surface.core_shape()


def first_hit(
    spec: HologramSpec, origin_mm: FloatArray, direction: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Find where rays first meet an element, inside its outline.

    Args:
        spec: The hologram.
        origin_mm: Start points in its frame, mm, shape ``(R, 3)``.
        direction: Unit directions of travel, shape ``(R, 3)``.

    Returns:
        Distances in mm, shape ``(R,)``, and points in mm, shape ``(R, 3)``; NaN for a miss.
    """
    shape = element_shape(spec)
    distance = m_to_mm(shape.intersect(mm_to_m(origin_mm), direction))
    hit = _hit_mm(spec, shape, origin_mm, direction, distance)
    for _ in range(_MORE_CROSSINGS):
        # A ray may cross the shape outside the element first, such as the far side of a bowl.
        beside = np.flatnonzero(np.isfinite(distance) & ~spec.surface.covers(hit))
        if beside.size == 0:
            break
        passed = distance[beside] + _BEYOND_MM
        start, way = origin_mm[beside] + passed[:, None] * direction[beside], direction[beside]
        distance[beside] = passed + m_to_mm(shape.intersect(mm_to_m(start), way))
        hit[beside] = _hit_mm(spec, shape, origin_mm[beside], way, distance[beside])
    met = np.isfinite(distance) & spec.surface.covers(hit)
    return np.where(met, distance, np.nan), np.where(met[:, None], hit, np.nan)


def _hit_mm(
    spec: HologramSpec,
    shape: Shape,
    origin_mm: FloatArray,
    direction: FloatArray,
    distance: FloatArray,
) -> FloatArray:
    hit = origin_mm + distance[:, None] * direction
    if not isinstance(spec.surface, MeshSurface):
        x, y, _ = np.moveaxis(mm_to_m(hit), -1, 0)
        hit[:, 2] = m_to_mm(shape.sag(x, y))
    return hit


def element_mesh(spec: HologramSpec, direction_error: float = DIRECTION_ERROR) -> ElementMesh:
    """Make the facets of a hologram, refined until they are good enough.

    Args:
        spec: The hologram.
        direction_error: Stated error to reach, radians.

    Returns:
        The facets; their stated error is larger than asked for when more triangles than
        `MAX_TRIANGLES` would be needed, or the mesh is too coarse to tell its curved surface.
    """
    surface = spec.surface
    if not isinstance(surface, MeshSurface):
        return _tessellated(surface, direction_error)
    media = (spec.media.back, spec.media.front)
    wavelength = nm_to_m(spec.pattern.wavelength_nm)
    indices = sum(float(medium_from(medium).index(wavelength)) for medium in media)
    optics = _Optics(msgspec.json.encode(spec.pattern), spec.pattern, indices)
    return _refined(surface.core_shape(), surface.refine, optics, direction_error)


def facet_error(mesh: MeshShape, departure: Departure, pattern: Pattern, indices: float) -> float:
    """Turn the departure of facets into an error of directions.

    Args:
        mesh: The mesh.
        departure: How far its facets are from the smooth surface.
        pattern: What is recorded.
        indices: Sum of the indices of both media.

    Returns:
        Radians; see the module for the formula.
    """
    gradient = np.nan_to_num(pattern.gradient(mesh.vertices))
    normal_part = float(np.max(np.abs(dot(gradient, mesh.normals))))
    turn = departure.angle + largest_curvature(mesh) * departure.displacement
    moved = np.sqrt(2.0) * _change(mesh, pattern) * departure.displacement
    return float(np.sqrt(2.0) * ((indices + normal_part) * turn + moved))


def _change(mesh: MeshShape, pattern: Pattern) -> float:
    """Return the largest change of the gradient over a length, per metre."""
    step = _STEP * float(np.max(np.ptp(mesh.vertices, axis=0)))
    columns: list[FloatArray] = []
    for axis in np.eye(3):
        ahead, back = (pattern.gradient(mesh.vertices + side * step * axis) for side in (0.5, -0.5))
        columns.append((ahead - back) / step)
    squares = np.sum(np.stack(columns) ** 2, axis=(0, 2))
    return float(np.sqrt(np.max(np.nan_to_num(squares))))


@lru_cache(maxsize=8)
def _refined(
    given: MeshShape, refine: bool, optics: _Optics, direction_error: float
) -> ElementMesh:
    pattern = pattern_from(optics.pattern)
    facets, beyond = facet_departure(given), patch_departure(given)

    def error(parts: int) -> float:
        return facet_error(given, facets.of_finer(parts).on_top_of(beyond), pattern, optics.indices)

    # Finer facets do not mend what the curved triangles of the given mesh miss.
    lasting = facet_error(given, beyond, pattern, optics.indices)
    own = facet_error(given, facets, pattern, optics.indices)
    most = math.isqrt(MAX_TRIANGLES // len(given.faces))
    if not refine or most < 2 or error(1) <= direction_error:
        return ElementMesh(given, error(1))
    room = max(direction_error - lasting, 0.1 * lasting)
    parts = min(most, math.ceil(math.sqrt(own / room)))
    return ElementMesh(refined(given, parts), error(parts), parts)


@lru_cache(maxsize=16)
def _tessellated(surface: FormulaSurface, direction_error: float) -> ElementMesh:
    shape = surface.core_shape()
    width, height = (mm_to_m(side) for side in surface.size_mm)
    make = _maker(surface, shape, width, height)
    if isinstance(shape, Plane):
        return ElementMesh(make(1), 0.0)
    cells = _FEWEST_CELLS
    while True:
        mesh = make(cells)
        error = _parallax(shape, mesh, max(width, height))
        if error <= direction_error or 4 * len(mesh.faces) > MAX_TRIANGLES:
            return ElementMesh(mesh, error)
        # Chords depart with the square of the cells.
        cells = max(cells + 1, min(2 * cells, int(cells * np.sqrt(error / direction_error)) + 1))


def _maker(
    surface: FormulaSurface, shape: Shape, width: float, height: float
) -> Callable[[int], MeshShape]:
    def rings(cells: int) -> MeshShape:
        return ellipse_mesh(shape, width, height, max(1, cells // 2))

    def grid(cells: int) -> MeshShape:
        longest = max(width, height)
        columns, rows = (max(1, int(np.ceil(cells * side / longest))) for side in (width, height))
        return rectangle_mesh(shape, width, height, columns, rows)

    return rings if surface.outline == "ellipse" else grid


def _parallax(shape: Shape, mesh: MeshShape, width: float) -> float:
    return departure_from(shape, mesh) * max(largest_curvature(mesh), 1.0 / width)
