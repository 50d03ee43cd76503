# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A round lens of a scene document, with a hologram on one of its faces or on none.

Its frame has the origin half way between the two vertices and z along the axis; the front is the
face at z > 0. A radius above 0 has its centre of curvature at +z, so a biconvex lens has a
negative radius in front and a positive one at the back.
"""

from typing import Literal

import numpy as np
from msgspec import Struct

from ..core.arrays import FloatArray
from ..core.units import m_to_mm, mm_to_m
from . import field_kinds, fields, medium
from .characteristic import CharacteristicSpec
from .efficiency import EfficiencySpec
from .field_error import FieldError
from .hologram import HologramSpec, Orders, SideMedia
from .medium import MediumRef
from .recording import RecordingSpec
from .scene_element import SceneElement
from .surface import ConicSurface, PlaneSurface

type Face = Literal["front", "back"]
FACES: tuple[Face, Face] = ("front", "back")

_THICKEST_MM = 1000.0
_LEAST_THICKNESS_MM = 1e-3
"""Thinner anywhere, and the two faces could not be told apart in a render."""
_PROBES = 65


class LensHologramSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A hologram on a face of a lens: a hologram document without surface and media.

    Attributes:
        recording: The two waves that it was made with, or
        characteristic: the function V(x, y) that is recorded in it; exactly one of the two.
        efficiency: How much light each order gets.
        orders: Orders that are traced; those of the table where it is left out.
    """

    recording: RecordingSpec | None = None
    characteristic: CharacteristicSpec | None = None
    efficiency: EfficiencySpec
    orders: Orders = ()


class LensFaceSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One face of a lens.

    Attributes:
        radius_mm: Radius at the vertex, not 0; above 0 the centre lies at +z; None is flat.
        conic: Conic constant: 0 is a sphere, -1 a paraboloid, below that a hyperboloid.
        hologram: What is on it, in a frame at its vertex with the axes of the lens.
    """

    radius_mm: float | None = None
    conic: float = 0.0
    hologram: LensHologramSpec | None = None

    def __post_init__(self) -> None:
        """Check radius and conic constant."""
        if self.radius_mm is not None and fields.number(self, "radius_mm") == 0.0:
            raise FieldError("radius_mm", "must not be 0", 0.0)
        fields.number(self, "conic")
        if self.hologram is not None:
            field_kinds.instance(self, "hologram", LensHologramSpec)

    def surface(self, diameter_mm: float) -> PlaneSurface | ConicSurface:
        """Give the face as a surface around its vertex.

        Args:
            diameter_mm: Diameter of the lens.

        Returns:
            The surface, with a round outline.

        Raises:
            FieldError: The face does not reach as far as the rim.
        """
        size = (diameter_mm, diameter_mm)
        if self.radius_mm is None:
            return PlaneSurface(size_mm=size, outline="ellipse")
        try:
            return ConicSurface(
                size_mm=size, radius_mm=self.radius_mm, conic=self.conic, outline="ellipse"
            )
        except FieldError as error:
            rule = f"must be large enough for a diameter of {diameter_mm:g} mm"
            raise FieldError("radius_mm", rule, self.radius_mm) from error


class LensElement(SceneElement, frozen=True, kw_only=True, tag="lens"):
    """A lens of a dispersive medium, its rim blackened.

    Attributes:
        medium: What it is made of.
        outside: What is around it.
        diameter_mm: Its diameter.
        thickness_mm: Distance of the two vertices.
        front: The face at z > 0.
        back: The face at z < 0.
    """

    medium: MediumRef
    outside: MediumRef = "air"
    diameter_mm: float
    thickness_mm: float
    front: LensFaceSpec = LensFaceSpec()
    back: LensFaceSpec = LensFaceSpec()

    def __post_init__(self) -> None:
        """Check media, sizes, that the faces do not meet, and the holograms."""
        super().__post_init__()
        medium.check(self, "medium")
        medium.check(self, "outside")
        fields.number(self, "diameter_mm", above=0.0)
        fields.number(self, "thickness_mm", above=0.0, at_most=_THICKEST_MM)
        for face in FACES:
            field_kinds.instance(self, face, LensFaceSpec)
            try:
                self.face(face).surface(self.diameter_mm)
            except FieldError as error:
                raise error.inside(face) from error
        self._check_thickness()
        for face in FACES:
            self.hologram(face)

    def _check_thickness(self) -> None:
        height = np.linspace(0.0, 0.5 * self.diameter_mm, _PROBES)
        thinnest = float(np.min(self.sag_mm("front", height) - self.sag_mm("back", height)))
        if thinnest < _LEAST_THICKNESS_MM:
            rule = f"must be more by {_LEAST_THICKNESS_MM - thinnest:g}: the faces meet"
            raise FieldError("thickness_mm", rule, self.thickness_mm)

    def face(self, face: Face) -> LensFaceSpec:
        """Give one of the two faces."""
        return self.front if face == "front" else self.back

    def vertex_z_mm(self, face: Face) -> float:
        """Tell where the vertex of a face is on the axis, in the frame of the lens."""
        return (0.5 if face == "front" else -0.5) * self.thickness_mm

    def sag_mm(self, face: Face, height_mm: FloatArray) -> FloatArray:
        """Tell where a face is.

        Args:
            face: The face.
            height_mm: Distances from the axis, shape ``(...)``.

        Returns:
            z in the frame of the lens, mm, shape ``(...)``.
        """
        shape = self.face(face).surface(self.diameter_mm).core_shape()
        return m_to_mm(shape.sag(mm_to_m(height_mm), 0.0)) + self.vertex_z_mm(face)

    def hologram(self, face: Face) -> HologramSpec | None:
        """Give what is on a face as a hologram of its own, in a frame at the face's vertex.

        Args:
            face: The face.

        Returns:
            The hologram, or None for a bare face.

        Raises:
            FieldError: It does not suit the face.
        """
        given = self.face(face).hologram
        if given is None:
            return None
        front = face == "front"
        media = SideMedia(
            back=self.medium if front else self.outside,
            front=self.outside if front else self.medium,
        )
        try:
            return HologramSpec(
                name=f"{self.name} {face}",
                surface=self.face(face).surface(self.diameter_mm),
                media=media,
                recording=given.recording,
                characteristic=given.characteristic,
                efficiency=given.efficiency,
                orders=given.orders,
            )
        except FieldError as error:
            raise error.inside(f"{face}.hologram") from error
