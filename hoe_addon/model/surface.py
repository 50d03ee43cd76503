# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of a hologram's surface as documents write them, told apart by ``shape``; in mm.

The frame of a hologram has its origin on the surface and z along the normal there. A radius above
0 has its centre of curvature at +z.
"""

import math
from typing import Literal

from msgspec import Struct

from ..core.arrays import BoolArray, FloatArray
from ..core.shapes import Conic, Cylinder, EvenAsphere, Plane, Shape
from ..core.units import mm_to_m
from . import field_kinds, fields
from .field_error import FieldError
from .mesh_file import FARTHEST_MM
from .mesh_surface import MeshSurface
from .outline import ON_SURFACE_MM as ON_SURFACE_MM
from .outline import OUTLINES, Outline, inside_outline, on_surface, reach_mm

_STEEPEST = 0.99
"""Share of the way to the rim of a sphere, where it stands upright, that an element may cover."""

MOST_COEFFICIENTS = 12
"""Of an asphere; lens data have fewer."""


class PlaneSurface(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="plane"):
    """A part of the plane z = 0 around the origin, its normal along +z.

    Attributes:
        size_mm: Width and height in mm.
        outline: A rectangle or the ellipse in it.
    """

    size_mm: tuple[float, float]
    outline: Outline = "rectangle"

    def __post_init__(self) -> None:
        """Check size and outline."""
        _check_extent(self)

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        return Plane()

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        return inside_outline(self.outline, self.size_mm, points_mm)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element, edges included."""
        return on_surface(self, position_mm)


class SphereSurface(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sphere"
):
    """A part of a sphere.

    Attributes:
        size_mm: Width and height of its projection on the plane z = 0, in mm.
        radius_mm: Radius in mm, not 0; above 0 the centre lies at +z.
        outline: A rectangle or the ellipse in it.
    """

    size_mm: tuple[float, float]
    radius_mm: float
    outline: Outline = "rectangle"

    def __post_init__(self) -> None:
        """Check all fields."""
        _check_extent(self)
        _check_radius(self)
        _check_reach(self, reach_mm(self.outline, self.size_mm), abs(self.radius_mm))

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        return Conic(mm_to_m(self.radius_mm))

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        return inside_outline(self.outline, self.size_mm, points_mm)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element, edges included."""
        return on_surface(self, position_mm)


class ConicSurface(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="conic"):
    """A part of a conic of revolution.

    Attributes:
        size_mm: Width and height of its projection on the plane z = 0, in mm.
        radius_mm: Radius at the vertex in mm, not 0; above 0 the centre lies at +z.
        conic: Conic constant: 0 is a sphere, -1 a paraboloid, below that a hyperboloid.
        outline: A rectangle or the ellipse in it.
    """

    size_mm: tuple[float, float]
    radius_mm: float
    conic: float
    outline: Outline = "rectangle"

    def __post_init__(self) -> None:
        """Check all fields."""
        _check_extent(self)
        _check_radius(self)
        fields.number(self, "conic")
        limit = _conic_limit(self.radius_mm, self.conic)
        _check_reach(self, reach_mm(self.outline, self.size_mm), limit)

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        return Conic(mm_to_m(self.radius_mm), self.conic)

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        return inside_outline(self.outline, self.size_mm, points_mm)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element, edges included."""
        return on_surface(self, position_mm)


class CylinderSurface(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="cylinder"
):
    """A part of a circular cylinder.

    Attributes:
        size_mm: Width and height of its projection on the plane z = 0, in mm.
        radius_mm: Radius in mm, not 0; above 0 the axis lies at +z.
        axis: Direction of the axis, along which the surface is straight.
        outline: A rectangle or the ellipse in it.
    """

    size_mm: tuple[float, float]
    radius_mm: float
    axis: Literal["x", "y"]
    outline: Outline = "rectangle"

    def __post_init__(self) -> None:
        """Check all fields."""
        _check_extent(self)
        _check_radius(self)
        field_kinds.choice(self, "axis", ("x", "y"))
        across = self.size_mm[1] if self.axis == "x" else self.size_mm[0]
        _check_reach(self, across / 2.0, abs(self.radius_mm))

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        return Cylinder(mm_to_m(self.radius_mm), self.axis)

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        return inside_outline(self.outline, self.size_mm, points_mm)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element, edges included."""
        return on_surface(self, position_mm)


class AsphereSurface(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="asphere"
):
    """A part of an even asphere.

    Attributes:
        size_mm: Width and height of its projection on the plane z = 0, in mm.
        radius_mm: Radius at the vertex in mm, not 0; above 0 the centre lies at +z.
        conic: Conic constant.
        coefficients: Factors of r^4, r^6, ... in mm^-3, mm^-5, ...
        outline: A rectangle or the ellipse in it.
    """

    size_mm: tuple[float, float]
    radius_mm: float
    conic: float = 0.0
    coefficients: tuple[float, ...] = ()
    outline: Outline = "rectangle"

    def __post_init__(self) -> None:
        """Check all fields."""
        _check_extent(self)
        _check_radius(self)
        fields.number(self, "conic")
        count = len(self.coefficients)
        if count > MOST_COEFFICIENTS:
            raise FieldError("coefficients", f"must be at most {MOST_COEFFICIENTS}", count)
        fields.vector(self, "coefficients", count)
        reach = reach_mm(self.outline, self.size_mm)
        _check_reach(self, reach, _conic_limit(self.radius_mm, self.conic))
        for place, value in enumerate(self.coefficients):
            # More than upright everywhere: a mistyped power, not a lens.
            if abs(value) * reach ** (2 * place + 3) > 1.0:
                rule = f"must change the height at the rim, {reach:g} mm, by less than that"
                raise FieldError(f"coefficients[{place}]", rule, value)

    def core_shape(self) -> Shape:
        """The shape for the core, in metres."""
        per_metre = tuple(
            value * 1000.0 ** (2 * place + 3) for place, value in enumerate(self.coefficients)
        )
        reach = reach_mm(self.outline, self.size_mm)
        return EvenAsphere(mm_to_m(self.radius_mm), self.conic, per_metre, mm_to_m(reach))

    def covers(self, points_mm: FloatArray) -> BoolArray:
        """Tell which points of the shape, in mm, shape ``(..., 3)``, lie in the outline."""
        return inside_outline(self.outline, self.size_mm, points_mm)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element, edges included."""
        return on_surface(self, position_mm)


type FormulaSurface = PlaneSurface | SphereSurface | ConicSurface | CylinderSurface | AsphereSurface
"""Shapes given by a formula; all have ``size_mm`` and ``outline``."""

type SurfaceSpec = FormulaSurface | MeshSurface

SURFACES = (
    PlaneSurface,
    SphereSurface,
    ConicSurface,
    CylinderSurface,
    AsphereSurface,
    MeshSurface,
)
"""Every shape."""


def _check_extent(surface: Struct) -> None:
    fields.vector(surface, "size_mm", 2, above=0.0, at_most=FARTHEST_MM)
    field_kinds.choice(surface, "outline", OUTLINES)


def _check_radius(surface: Struct) -> None:
    if fields.number(surface, "radius_mm") == 0.0:
        raise FieldError("radius_mm", "must not be 0", 0.0)


def _conic_limit(radius_mm: float, conic: float) -> float:
    return abs(radius_mm) / math.sqrt(1.0 + conic) if conic > -1.0 else math.inf


def _check_reach(surface: Struct, reach: float, limit: float) -> None:
    if reach > _STEEPEST * limit:
        rule = f"must reach at most {_STEEPEST * limit:g} mm from the axis, where it is steep"
        raise FieldError("size_mm", rule, getattr(surface, "size_mm", None))
