# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light guide as properties: the plate, the holograms on it, display and lens."""

from typing import Any

import bpy
from bpy.props import EnumProperty, FloatVectorProperty, PointerProperty, StringProperty

from ..ids import Face
from ..registration import class_registrars
from .changes import mark
from .display import SIZE_LIMITS, HOE_PG_display, length
from .medium import HOE_PG_medium
from .values import number, numbers, reset, store


class HOE_PG_guide(bpy.types.PropertyGroup):
    """The plate of a light guide."""

    plate: PointerProperty(name="Plate", description="The plate's object", type=bpy.types.Object)
    medium: PointerProperty(
        name="Medium", description="What the plate is made of", type=HOE_PG_medium
    )
    outside: PointerProperty(name="Outside", description="What is around it", type=HOE_PG_medium)
    thickness_mm: length("Thickness", "Distance of the two faces", 1.0)
    size_mm: FloatVectorProperty(
        name="Size",
        description="Width and height of the plate, in mm",
        size=2,
        subtype="XYZ",
        default=(50.0, 30.0),
        update=mark,
        **SIZE_LIMITS,
    )
    center_mm: FloatVectorProperty(
        name="Centre",
        description="Centre of the plate, right and up from the eye, in mm",
        size=2,
        subtype="XYZ",
        default=(0.0, 0.0),
        step=100,
        precision=3,
        update=mark,
    )
    relief_mm: length("Eye Relief", "Distance from the eye's pupil to the plate", 18.0)

    _VECTORS = ("size_mm", "center_mm")
    _NUMBERS = ("thickness_mm", "relief_mm")

    def to_document(self) -> dict[str, Any]:
        """The plate as documents write it."""
        return (
            {"medium": self.medium.to_document(), "outside": self.outside.to_document()}
            | {field: number(self, field) for field in self._NUMBERS}
            | {field: numbers(self, field) for field in self._VECTORS}
        )

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the plate of a document."""
        reset(self)
        for field in ("medium", "outside"):
            getattr(self, field).from_document(document[field], f"{path}.{field}")
        for field in (*self._NUMBERS, *self._VECTORS):
            store(self, field, document[field], path)


class HOE_PG_patch(bpy.types.PropertyGroup):
    """A hologram on a face of the plate; what is recorded in it stands in its material."""

    material: PointerProperty(
        name="Hologram", description="Material of the patch", type=bpy.types.Material
    )
    face: EnumProperty(
        name="Face",
        description="Face of the plate that it lies on",
        items=Face.items(),
        default=Face.EYE,
        update=mark,
    )
    center_mm: FloatVectorProperty(
        name="Centre",
        description="Centre of the patch, right and up from the eye, in mm",
        size=2,
        subtype="XYZ",
        default=(0.0, 0.0),
        step=100,
        precision=3,
        update=mark,
    )
    size_mm: FloatVectorProperty(
        name="Size",
        description="Width and height of the patch, in mm",
        size=2,
        subtype="XYZ",
        default=(10.0, 10.0),
        update=mark,
        **SIZE_LIMITS,
    )

    def to_document(self) -> dict[str, Any]:
        """The patch as documents write it, without its hologram."""
        return {
            "name": self.name,
            "face": self.face,
            "center_mm": numbers(self, "center_mm"),
            "size_mm": numbers(self, "size_mm"),
        }

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the patch of a document."""
        self.name, self.face = document["name"], document["face"]
        for field in ("center_mm", "size_mm"):
            store(self, field, document[field], path)


class HOE_PG_engine(bpy.types.PropertyGroup):
    """Display and lens of a light guide."""

    mount: PointerProperty(
        name="Light Engine",
        description="Object that lens and display hang on",
        type=bpy.types.Object,
    )
    panel: PointerProperty(
        name="Display", description="The display's object", type=bpy.types.Object
    )
    patch: StringProperty(
        name="In-Coupler",
        description="Hologram over whose centre display and lens stand",
        update=mark,
    )
    display: PointerProperty(name="Display", description="The picture", type=HOE_PG_display)
    focal_length_mm: length("Focal Length", "Focal length of the collimating lens", 20.0)
    diameter_mm: length("Lens Diameter", "Diameter of the collimating lens", 5.0)
    distance_mm: length("Lens Distance", "Distance from the lens to the plate", 1.0)

    _LENS = ("focal_length_mm", "diameter_mm", "distance_mm")

    def lens_document(self) -> dict[str, Any]:
        """The lens as documents write it."""
        return {field: number(self, field) for field in self._LENS}

    def from_documents(
        self,
        document: dict[str, Any],
        image: bpy.types.Image | None,
    ) -> None:
        """Take source, display and lens of a light guide's document."""
        reset(self)
        self.patch = document["source"]["patch"]
        self.display.from_document(document["display"], "display", image)
        for field in self._LENS:
            store(self, field, document["lens"][field], "lens")


register, unregister = class_registrars((HOE_PG_guide, HOE_PG_patch, HOE_PG_engine))
