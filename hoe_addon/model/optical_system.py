# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves that come through lenses or from mirrors, as documents write them; lengths in mm."""

import math
from functools import lru_cache
from typing import Annotated, Literal, cast

import numpy as np
from msgspec import Meta, Struct

from ..core.arrays import FloatArray
from ..core.ray_fitting import NoRayError, OpticalSurface, OpticalSystem, check_reaches
from ..core.shapes import MeshShape
from ..core.tracer import Frame
from ..core.units import mm_to_m
from ..core.waves import PlaneWave, PointSource
from . import field_kinds, fields, medium
from .field_error import FieldError
from .medium import MediumRef, SellmeierMedium
from .surface import SurfaceSpec

MAX_SURFACES = 64
"""More than any lens has."""

_LOOKED_AT = 9
"""Points of an element along a side by which it is told whether a system throws rays on it."""


class SystemPlaneSource(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="plane"
):
    """A plane wave before the first surface.

    Attributes:
        direction: Direction of propagation, of any length but zero.
        medium: Medium before the first surface.
    """

    direction: tuple[float, float, float]
    medium: MediumRef = 1.0

    def __post_init__(self) -> None:
        """Check direction and medium."""
        _direction(self, "direction")
        medium.check(self, "medium")

    def core_source(self, wavelength_nm: float) -> PlaneWave:
        """Return the wave of the core, at a wavelength."""
        return PlaneWave(self.direction, medium.index_at(self, "medium", wavelength_nm))


class SystemPointSource(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="point"
):
    """A spherical wave before the first surface.

    Attributes:
        position_mm: Its point, in the frame of the hologram.
        beam: Whether the wave runs away from its point, or toward it: then the point lies beyond
            the first surface, and the wave would come together there without the optics.
        medium: Medium before the first surface.
    """

    position_mm: tuple[float, float, float]
    beam: Literal["diverging", "converging"] = "diverging"
    medium: MediumRef = 1.0

    def __post_init__(self) -> None:
        """Check position, beam and medium."""
        fields.vector(self, "position_mm", 3)
        field_kinds.choice(self, "beam", ("diverging", "converging"))
        medium.check(self, "medium")

    def core_source(self, wavelength_nm: float) -> PointSource:
        """Return the wave of the core, at a wavelength."""
        return PointSource(
            _metres(self.position_mm),
            converging=self.beam == "converging",
            index=medium.index_at(self, "medium", wavelength_nm),
        )


type SystemSourceSpec = SystemPlaneSource | SystemPointSource


class _Optic(Struct, frozen=True, kw_only=True):
    """Common part of all surfaces of a system.

    Attributes:
        vertex_mm: Where the axis meets the surface, in the frame of the hologram.
        normal: Direction of the axis, of any length but zero.
        semi_diameter_mm: Radius of the round aperture.
        interaction: What the surface does with light.
        medium: Medium behind a refracting surface; not given for a mirror.
    """

    vertex_mm: tuple[float, float, float]
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    semi_diameter_mm: float
    interaction: Literal["refract", "reflect"] = "refract"
    medium: float | str | SellmeierMedium | None = None

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.vector(self, "vertex_mm", 3)
        _direction(self, "normal")
        fields.number(self, "semi_diameter_mm", above=0.0)
        field_kinds.choice(self, "interaction", ("refract", "reflect"))
        if self.interaction == "reflect":
            if self.medium is not None:
                raise FieldError("medium", "must not be given for a mirror", self.medium)
        elif self.medium is None:
            raise FieldError("medium", "must be given, unless interaction is reflect", None)
        else:
            medium.check(self, "medium")
        radius_mm, conic = self.curve()
        limit = abs(radius_mm) / math.sqrt(1.0 + conic) if conic > -1.0 else math.inf
        if self.semi_diameter_mm >= limit:
            rule = f"must lie within the surface, below {limit:g}"
            raise FieldError("semi_diameter_mm", rule, self.semi_diameter_mm)

    def curve(self) -> tuple[float, float]:
        """Return the radius at the vertex in mm, infinite for a plane, and the conic constant."""
        return math.inf, 0.0

    def core_surface(self, wavelength_nm: float) -> OpticalSurface:
        """Return the surface of the core, at a wavelength."""
        radius_mm, conic = self.curve()
        mirror = self.interaction == "reflect"
        return OpticalSurface(
            frame=Frame.at(_metres(self.vertex_mm), self.normal),
            radius=mm_to_m(radius_mm),
            conic=conic,
            semi_diameter=mm_to_m(self.semi_diameter_mm),
            index_after=None if mirror else medium.index_at(self, "medium", wavelength_nm),
        )


class PlaneOptic(_Optic, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="plane"):
    """A flat surface; its fields are those of all surfaces."""


class SphereOptic(_Optic, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sphere"):
    """A part of a sphere.

    Attributes:
        radius_mm: Radius, not 0; above 0 the centre lies on the side that the normal points to.
    """

    radius_mm: float

    def __post_init__(self) -> None:
        """Check the radius and all other fields."""
        _radius(self)
        super().__post_init__()

    def curve(self) -> tuple[float, float]:
        """Return the radius, and 0."""
        return self.radius_mm, 0.0


class ConicOptic(_Optic, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="conic"):
    """A part of a conic of revolution.

    Attributes:
        radius_mm: Radius at the vertex, not 0; above 0 the centre of curvature lies on the side
            that the normal points to.
        conic: Conic constant: 0 a sphere, -1 a paraboloid, below that a hyperboloid.
    """

    radius_mm: float
    conic: float = 0.0

    def __post_init__(self) -> None:
        """Check radius, conic constant and all other fields."""
        _radius(self)
        fields.number(self, "conic")
        super().__post_init__()

    def curve(self) -> tuple[float, float]:
        """Return radius and conic constant."""
        return self.radius_mm, self.conic


type OpticSpec = PlaneOptic | SphereOptic | ConicOptic

_OPTICS = (PlaneOptic, SphereOptic, ConicOptic)


class SystemWaveSpec(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="system"
):
    """A wave of a source behind optics. Media count at the wavelength of the recording.

    Attributes:
        source: The wave before the first surface.
        surfaces: What light meets on its way to the hologram, in this order.
    """

    source: SystemSourceSpec
    surfaces: Annotated[tuple[OpticSpec, ...], Meta(min_length=1, max_length=MAX_SURFACES)]

    def __post_init__(self) -> None:
        """Check the kinds and the number of surfaces."""
        field_kinds.instance(self, "source", SystemPlaneSource, SystemPointSource)
        if not 1 <= len(self.surfaces) <= MAX_SURFACES:
            rule = f"must have 1 to {MAX_SURFACES} surfaces"
            raise FieldError("surfaces", rule, len(self.surfaces))
        for number, surface in enumerate(self.surfaces):
            if not isinstance(cast("object", surface), _OPTICS):
                raise FieldError(f"surfaces[{number}]", "must be a surface", surface)

    def source_points(self) -> list[tuple[str, tuple[float, float, float]]]:
        """Return no points: light comes from the last surface, not from the source."""
        return []

    def core_system(self, wavelength_nm: float) -> OpticalSystem:
        """Make the system of the core.

        Args:
            wavelength_nm: Vacuum wavelength of the recording in nm.

        Returns:
            The same system in SI units, media as numbers.

        Raises:
            FieldError: If a medium has no index there.
        """
        try:
            source = self.source.core_source(wavelength_nm)
        except FieldError as error:
            raise error.inside("source") from error
        made: list[OpticalSurface] = []
        for number, surface in enumerate(self.surfaces):
            try:
                made.append(surface.core_surface(wavelength_nm))
            except FieldError as error:
                raise error.inside(f"surfaces[{number}]") from error
        return OpticalSystem(source, tuple(made))

    def check_reaches(self, surface: SurfaceSpec, wavelength_nm: float) -> None:
        """Check that light gets to an element.

        Args:
            surface: The element.
            wavelength_nm: Vacuum wavelength of the recording in nm.

        Raises:
            FieldError: No ray does; it names the surface where the rays are lost.
        """
        problem = _problem(self, surface, wavelength_nm)
        if problem is not None:
            raise FieldError(f"surfaces[{problem.surface}]", problem.rule, "0 rays")


@lru_cache(maxsize=32)
def _problem(wave: SystemWaveSpec, surface: SurfaceSpec, wavelength_nm: float) -> NoRayError | None:
    try:
        check_reaches(wave.core_system(wavelength_nm), _some_points(surface))
    except NoRayError as error:
        return error
    return None


def _some_points(surface: SurfaceSpec) -> FloatArray:
    """Return points of an element, metres, shape ``(N, 3)``."""
    shape = surface.core_shape()
    if isinstance(shape, MeshShape):
        return shape.vertices[:: max(1, len(shape.vertices) // _LOOKED_AT**2)]
    half = 0.5 * mm_to_m(np.asarray(surface.size_mm, dtype=np.float64))
    steps = np.linspace(-1.0, 1.0, _LOOKED_AT)
    across, up = np.indices((_LOOKED_AT, _LOOKED_AT))
    x, y = half[0] * steps[across.ravel()], half[1] * steps[up.ravel()]
    return np.stack((x, y, shape.sag(x, y)), axis=-1)


def _metres(position_mm: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = (float(mm_to_m(value)) for value in position_mm)
    return (x, y, z)


def _direction(owner: Struct, field: str) -> None:
    direction = fields.vector(owner, field, 3)
    if math.hypot(*direction) == 0.0:
        raise FieldError(field, "must not have zero length", direction)


def _radius(owner: Struct) -> None:
    if fields.number(owner, "radius_mm") == 0.0:
        raise FieldError("radius_mm", "must not be 0", 0.0)
