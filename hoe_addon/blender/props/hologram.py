# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole hologram as properties."""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ...model.document import SCHEMA
from ..ids import CharacteristicKind, Outline, PatternKind, Shape
from ..registration import class_registrars
from . import details
from .beginning import begin
from .changes import mark
from .detail_fitting import function_changed, surface_changed
from .efficiency import ORDER_LIMITS, HOE_PG_efficiency
from .medium import HOE_PG_media
from .pattern_fields import FunctionFields, SurfaceFields
from .recording import HOE_PG_recording
from .values import numbers, reset, store


class HOE_PG_surface(SurfaceFields, bpy.types.PropertyGroup):
    """The shape of the element; other shapes than a plane are kept as text."""

    shape: EnumProperty(
        name="Shape",
        description="Shape of the surface",
        items=Shape.items(),
        default=Shape.PLANE,
        update=surface_changed,
    )

    size_mm: FloatVectorProperty(
        name="Size",
        description="Width and height of the plane element, in mm",
        size=2,
        subtype="XYZ",
        default=(40.0, 40.0),
        min=1e-6,
        soft_min=0.1,
        soft_max=500.0,
        step=100,
        precision=3,
        update=mark,
    )

    outline: EnumProperty(
        name="Outline",
        description="Outline of the plane element",
        items=Outline.items(),
        default=Outline.RECTANGLE,
        update=mark,
    )

    details: StringProperty(
        name="Details",
        description="JSON of a surface that is no plane; lengths in mm",
        update=mark,
    )

    def to_document(self) -> dict[str, Any]:
        """The surface as documents write it."""
        if self.shape != Shape.PLANE:
            return details.read(self.details, "shape", self.shape, "surface")
        return {
            "shape": "plane",
            "size_mm": numbers(self, "size_mm"),
            "outline": self.outline,
        }

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the surface of a document.

        Args:
            document: The surface.
            path: Its path, for messages.
        """
        reset(self)
        self.shape = document["shape"]
        if document["shape"] != Shape.PLANE:
            self.details = details.written(document, "shape")
            return
        store(self, "size_mm", document["size_mm"], path)
        self.outline = document["outline"]


class HOE_PG_characteristic(FunctionFields, bpy.types.PropertyGroup):
    """A characteristic function given outright."""

    kind: EnumProperty(
        name="Function",
        description="Kind of characteristic function",
        items=CharacteristicKind.items(),
        default=CharacteristicKind.LINEAR,
        update=function_changed,
    )
    details: StringProperty(
        name="Details",
        description="JSON of the function; lengths in mm, wavelengths in nm",
        default='{"wavelength_nm": 532, "lines_per_mm": 600}',
        update=mark,
    )

    def to_document(self) -> dict[str, Any]:
        """The function as documents write it."""
        return details.read(self.details, "kind", self.kind, "characteristic")

    def from_document(self, document: dict[str, Any]) -> None:
        """Take the function of a document.

        Args:
            document: The function.
        """
        self.kind = document["kind"]
        self.details = details.written(document, "kind")


def _axis(letter: str, default: tuple[float, float, float]) -> Any:
    return FloatVectorProperty(
        name=f"{letter} Axis",
        description=f"{letter.lower()} axis of the recording in object space, a unit vector",
        subtype="XYZ",
        size=3,
        default=default,
        min=-1.0,
        max=1.0,
        step=1,
        precision=4,
        update=mark,
    )


class HOE_PG_frame(bpy.types.PropertyGroup):
    """Where the frame of the recording lies in the object."""

    origin: FloatVectorProperty(
        name="Origin",
        description="Origin of the recording in object space, in scene units",
        subtype="XYZ",
        size=3,
        default=(0.0, 0.0, 0.0),
        soft_min=-1000.0,
        soft_max=1000.0,
        step=100,
        precision=3,
        update=mark,
    )
    x: _axis("X", (1.0, 0.0, 0.0))
    y: _axis("Y", (0.0, 1.0, 0.0))


class HOE_PG_order(bpy.types.PropertyGroup):
    """One diffraction order to trace."""

    order: IntProperty(
        name="Order", description="Diffraction order", default=0, update=mark, **ORDER_LIMITS
    )


def _enable(group: "HOE_PG_hologram", context: bpy.types.Context) -> None:
    # Stored with the file, so that a later version knows how to read the rest.
    if group.enabled and not group.is_property_set("schema"):
        group.schema = SCHEMA
        begin(group)
    mark(group, context)


class HOE_PG_hologram(bpy.types.PropertyGroup):
    """A hologram on a material; its name is the name of the material."""

    enabled: BoolProperty(
        name="Hologram",
        description="Whether this material is a hologram",
        default=False,
        update=_enable,
    )
    schema: IntProperty(
        name="Schema",
        description="Version of the format of these properties",
        default=SCHEMA,
        min=1,
        options={"HIDDEN"},
    )
    problem: StringProperty(
        name="Problem",
        description="Why the shader could not be made from these properties; empty when it could",
        options={"HIDDEN"},
        override=set(),
    )
    needs_bake: BoolProperty(
        name="Needs Bake",
        description="Whether a map or a table has to be made before the shader can be",
        default=False,
        options={"HIDDEN"},
        override=set(),
    )
    made_of: StringProperty(
        name="Made of",
        description="Hash of the properties that the shader was made from",
        options={"HIDDEN"},
        override=set(),
    )
    units_per_mm: FloatProperty(
        name="Units per mm",
        description="Scene units in one mm",
        default=1.0,
        min=1e-6,
        max=1e6,
        soft_min=0.001,
        soft_max=1.0,
        step=1,
        precision=4,
        update=mark,
    )
    surface: PointerProperty(
        name="Surface", description="Shape of the element", type=HOE_PG_surface
    )
    frame: PointerProperty(
        name="Frame", description="Where the recording lies in the object", type=HOE_PG_frame
    )
    media: PointerProperty(
        name="Media", description="Media on the two sides of the surface", type=HOE_PG_media
    )
    pattern: EnumProperty(
        name="Pattern",
        description="How it is said what is recorded",
        items=PatternKind.items(),
        default=PatternKind.RECORDING,
        update=mark,
    )
    characteristic: PointerProperty(
        name="Characteristic Function",
        description="The function V(x, y) that is recorded",
        type=HOE_PG_characteristic,
    )
    recording: PointerProperty(
        name="Recording", description="How the hologram was recorded", type=HOE_PG_recording
    )
    efficiency: PointerProperty(
        name="Efficiency", description="How much light each order gets", type=HOE_PG_efficiency
    )
    orders: CollectionProperty(
        name="Orders", description="Diffraction orders that are traced", type=HOE_PG_order
    )

    def to_document(self) -> dict[str, Any]:
        """The hologram as documents write it."""
        return {
            "schema": self.schema,
            "name": self.id_data.name,
            "surface": self.surface.to_document(),
            "media": self.media.to_document(),
            self.pattern: getattr(self, self.pattern).to_document(),
            "efficiency": self.efficiency.to_document(),
            "orders": [entry.order for entry in self.orders],
        }

    def from_document(self, document: dict[str, Any]) -> None:
        """Take a document; what it does not name gets its default, the frame stays.

        Args:
            document: A valid hologram of the current format.
        """
        reset(self)
        self.schema = document["schema"]
        self.surface.from_document(document["surface"], "surface")
        self.media.from_document(document["media"], "media")
        if "characteristic" in document:
            self.pattern = PatternKind.CHARACTERISTIC
            self.characteristic.from_document(document["characteristic"])
        else:
            self.recording.from_document(document["recording"], "recording")
        self.efficiency.from_document(document["efficiency"], "efficiency")
        for order in document["orders"]:
            self.orders.add().order = order


register, unregister = class_registrars(
    (HOE_PG_surface, HOE_PG_characteristic, HOE_PG_frame, HOE_PG_order, HOE_PG_hologram)
)
