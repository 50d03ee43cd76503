# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves as documents write them, told apart by ``kind``; lengths in mm.

Every kind but one behind optics has an ``index``; each lists by ``source_points`` the places where
it has no direction.
"""

import math
from typing import Literal

import numpy as np
from msgspec import Struct

from ..core.arrays import FloatArray, as_float, dot, unit
from . import field_kinds, fields
from .field_error import FieldError
from .optical_system import SystemWaveSpec
from .source_shapes import SOURCE_SHAPES, Point, SourceShapeSpec

type Beam = Literal["diverging", "converging"]
"""Away from a point (a real source) or toward it (a virtual one, beyond the hologram)."""

type SourcePoints = list[tuple[str, Point]]
"""Field and place in mm of points of a source, which must stay clear of the hologram."""

_BEAMS = ("diverging", "converging")
_ON_WINDOW_MM = 1e-9
"""A point nearer to a window than this counts as on it."""
_PARALLEL = 1e-9
"""Sine of an angle below which two directions count as parallel."""


class PlaneWaveSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="plane"):
    """A plane wave: a source at infinity, real and virtual alike.

    Attributes:
        direction: Direction of propagation, of any length but zero; kept as written.
        index: Refractive index of the medium that the wave arrives in.
    """

    direction: tuple[float, float, float]
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check direction and index."""
        _direction(self, "direction")
        fields.number(self, "index", at_least=1.0)

    def source_points(self) -> SourcePoints:
        """Return no points: it has a direction everywhere."""
        return []


class PointSourceSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="point"
):
    """A spherical wave.

    Attributes:
        position_mm: Its point, in the frame of the surface, in mm.
        beam: Whether the wave runs away from its point (a real source) or toward it (a virtual
            one: the wave would come together there, beyond the hologram).
        index: Refractive index of the medium that the wave arrives in.
    """

    position_mm: tuple[float, float, float]
    beam: Beam = "diverging"
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check position, beam and index."""
        fields.vector(self, "position_mm", 3)
        field_kinds.choice(self, "beam", _BEAMS)
        fields.number(self, "index", at_least=1.0)

    def source_points(self) -> SourcePoints:
        """Return its point."""
        return [("position_mm", self.position_mm)]


class FlatWindowSpec(Struct, frozen=True, forbid_unknown_fields=True):
    """A plane-parallel plate between a point and the hologram.

    Attributes:
        position_mm: A point on its face toward the source.
        normal: Normal of its faces, from the source's side to the hologram's; any length but zero.
        thickness_mm: Its thickness; 0 is a plain boundary of two media.
        index: Refractive index of the plate; at thickness 0 it does not matter.
    """

    position_mm: tuple[float, float, float]
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    thickness_mm: float = 0.0
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check position, normal, thickness and index."""
        fields.vector(self, "position_mm", 3)
        _direction(self, "normal")
        fields.number(self, "thickness_mm", at_least=0.0)
        fields.number(self, "index", at_least=1.0)

    def depth_mm(self, position_mm: Point) -> float:
        """Tell how far a point lies behind the face toward the source; negative before it."""
        away = as_float(position_mm) - as_float(self.position_mm)
        return float(dot(away, unit(self.normal)))


class WindowSourceSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="window"
):
    """A spherical wave in one medium, met in another one behind a flat window.

    Places that are not behind the window get no light, and nothing is recorded there.

    Attributes:
        position_mm: Its point, on the side of the window that the normal points from.
        window: The window.
        beam: Whether the wave comes from the point through the window, or runs from the hologram
            through the window toward the point.
        index: Refractive index of the medium between window and hologram.
        source_index: Refractive index of the medium around the point.
    """

    position_mm: tuple[float, float, float]
    window: FlatWindowSpec
    beam: Beam = "diverging"
    index: float = 1.0
    source_index: float = 1.0

    def __post_init__(self) -> None:
        """Check all fields, and that the point lies before the window."""
        fields.vector(self, "position_mm", 3)
        field_kinds.instance(self, "window", FlatWindowSpec)
        field_kinds.choice(self, "beam", _BEAMS)
        fields.number(self, "index", at_least=1.0)
        fields.number(self, "source_index", at_least=1.0)
        if self.window.depth_mm(self.position_mm) > -_ON_WINDOW_MM:
            rule = "must lie before the window, on the side that its normal points from"
            raise FieldError("position_mm", rule, self.position_mm)

    def source_points(self) -> SourcePoints:
        """Return its point."""
        return [("position_mm", self.position_mm)]


class AstigmaticSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="astigmatic"
):
    """A beam with two line foci: a toric wave.

    The first focus is a straight line, the second an arc of a circle around that line: no wave has
    two straight ones. Near the chief ray, which runs through both places, the arc is a line too.

    Attributes:
        first_mm: Where the chief ray crosses the straight focal line.
        second_mm: Where it crosses the focal arc.
        line_direction: Direction of the straight line; its part at a right angle to the chief ray
            counts.
        beam: Whether the wave runs away from the arc or toward it. Both foci may lie before the
            hologram, both beyond it, or one on each side.
        index: Refractive index of the medium that the wave arrives in.
    """

    first_mm: tuple[float, float, float]
    second_mm: tuple[float, float, float]
    line_direction: tuple[float, float, float]
    beam: Beam = "diverging"
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check both places, the direction, beam and index."""
        fields.vector(self, "first_mm", 3)
        fields.vector(self, "second_mm", 3)
        _direction(self, "line_direction")
        field_kinds.choice(self, "beam", _BEAMS)
        fields.number(self, "index", at_least=1.0)
        if self.first_mm == self.second_mm:
            rule = "must not be the same place as first_mm; a point source has one focus"
            raise FieldError("second_mm", rule, self.second_mm)
        chief = as_float(self.second_mm) - as_float(self.first_mm)
        if _parallel(self.line_direction, chief):
            rule = "must not run along the chief ray, from first_mm to second_mm"
            raise FieldError("line_direction", rule, self.line_direction)

    def source_points(self) -> SourcePoints:
        """Return the two places on the chief ray."""
        return [("first_mm", self.first_mm), ("second_mm", self.second_mm)]


class ExtendedSourceSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="extended"
):
    """A source with a length or an area: each ray meets the spherical wave of one point of it.

    The point is drawn anew for each ray, evenly by length or area, and for object and reference
    wave independently. The element then blurs as if its source were as large.

    Attributes:
        shape: Its shape, in its own frame.
        position_mm: Origin of that frame.
        normal: z axis of that frame, of any length but zero.
        x_axis: Direction whose part at a right angle to the normal is the x axis of that frame.
        beam: Whether the waves run away from their points or toward them.
        index: Refractive index of the medium that the waves arrive in.
    """

    shape: SourceShapeSpec
    position_mm: tuple[float, float, float]
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    x_axis: tuple[float, float, float] = (1.0, 0.0, 0.0)
    beam: Beam = "diverging"
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check shape, frame, beam and index."""
        field_kinds.instance(self, "shape", *SOURCE_SHAPES)
        fields.vector(self, "position_mm", 3)
        _direction(self, "normal")
        _direction(self, "x_axis")
        field_kinds.choice(self, "beam", _BEAMS)
        fields.number(self, "index", at_least=1.0)
        if _parallel(self.x_axis, self.normal):
            raise FieldError("x_axis", "must not be parallel to normal", self.x_axis)

    def axes(self) -> FloatArray:
        """Return the unit vectors x, y and z of its frame, shape ``(3, 3)``, one a row."""
        z, along = unit(self.normal), unit(self.x_axis)
        x = unit(along - dot(along, z) * z)
        return np.stack((x, np.cross(z, x), z))

    def source_points(self) -> SourcePoints:
        """Return no points: its edges are looked at instead."""
        return []

    def edges_mm(self) -> FloatArray:
        """Return edges and spokes of its shape in the hologram's frame, shape ``(n, 2, 3)``."""
        return self.shape.edges_mm() @ self.axes() + as_float(self.position_mm)


type WaveSpec = (
    PlaneWaveSpec
    | PointSourceSpec
    | WindowSourceSpec
    | AstigmaticSpec
    | ExtendedSourceSpec
    | SystemWaveSpec
)

WAVES = (
    PlaneWaveSpec,
    PointSourceSpec,
    WindowSourceSpec,
    AstigmaticSpec,
    ExtendedSourceSpec,
    SystemWaveSpec,
)
"""Every kind of wave."""


def _direction(owner: Struct, field: str) -> None:
    """Check a direction of any length but zero."""
    direction = fields.vector(owner, field, 3)
    if math.hypot(*direction) == 0.0:
        raise FieldError(field, "must not have zero length", direction)


def _parallel(first: Point, second: Point | FloatArray) -> bool:
    return float(np.linalg.norm(np.cross(unit(first), unit(second)))) < _PARALLEL
