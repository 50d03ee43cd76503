# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Who looks, from where, and at what else, as properties: eye, eyebox and room."""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntVectorProperty,
    PointerProperty,
)

from ..ids import RoomKind
from ..registration import class_registrars
from .changes import mark
from .display import LUMINANCE_LIMITS, SIZE_LIMITS, length
from .values import number, numbers, reset, store


class HOE_PG_eye(bpy.types.PropertyGroup):
    """The eye; its place is that of the camera."""

    camera: PointerProperty(name="Eye", description="Camera that is the eye", type=bpy.types.Object)
    pupil_diameter_mm: length("Pupil", "Diameter of the eye's pupil; 2 in sunlight, 6 at night", 4)
    at_infinity: BoolProperty(
        name="Focus at Infinity",
        description="Whether the eye is focused on infinity",
        default=True,
        update=mark,
    )
    focus_mm: length("Focus", "Distance that the eye is focused on", 1000.0)
    field_deg: FloatProperty(
        name="Field of View",
        description="Horizontal field of the picture, in degrees",
        default=40.0,
        min=0.01,
        max=179.0,
        step=100,
        precision=2,
        update=mark,
    )

    def to_document(self) -> dict[str, Any]:
        """The eye as documents write it, without its place."""
        return {
            "pupil_diameter_mm": number(self, "pupil_diameter_mm"),
            "focus_mm": None if self.at_infinity else number(self, "focus_mm"),
            "field_deg": number(self, "field_deg"),
        }

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the eye of a document."""
        reset(self)
        for field in ("pupil_diameter_mm", "field_deg"):
            store(self, field, document[field], path)
        self.at_infinity = document["focus_mm"] is None
        if not self.at_infinity:
            store(self, "focus_mm", document["focus_mm"], path)


class HOE_PG_eyebox(bpy.types.PropertyGroup):
    """A grid of pupil positions around the eye's own."""

    grid: IntVectorProperty(
        name="Positions",
        description="Number of pupil positions across and up",
        size=2,
        subtype="XYZ",
        default=(3, 3),
        min=1,
        max=101,
        soft_max=9,
        update=mark,
    )
    pitch_mm: FloatVectorProperty(
        name="Pitch",
        description="Distance of neighbouring pupil positions across and up, in mm",
        size=2,
        subtype="XYZ",
        default=(2.0, 2.0),
        update=mark,
        **SIZE_LIMITS,
    )

    def to_document(self) -> dict[str, Any]:
        """The grid as documents write it."""
        return {"grid": list(self.grid), "pitch_mm": numbers(self, "pitch_mm")}

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the grid of a document."""
        for field in ("grid", "pitch_mm"):
            store(self, field, document[field], path)


class HOE_PG_room(bpy.types.PropertyGroup):
    """What stands behind and around."""

    kind: EnumProperty(
        name="Room",
        description="What stands behind and around the device",
        items=RoomKind.items(),
        default=RoomKind.NONE,
        update=mark,
    )
    luminance_cd_m2: FloatProperty(
        name="Room Luminance",
        description="Luminance of a white surface in the room, in cd/m²; indoors about 100",
        default=100.0,
        update=mark,
        **LUMINANCE_LIMITS,
    )
    collection: PointerProperty(
        name="Room", description="Collection that holds the room", type=bpy.types.Collection
    )
    world: PointerProperty(
        name="Sky", description="World that belongs to the room", type=bpy.types.World
    )

    def to_document(self) -> dict[str, Any]:
        """The room as documents write it."""
        return {"kind": self.kind, "luminance_cd_m2": number(self, "luminance_cd_m2")}

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the room of a document."""
        self.kind = document["kind"]
        store(self, "luminance_cd_m2", document["luminance_cd_m2"], path)


register, unregister = class_registrars((HOE_PG_eye, HOE_PG_eyebox, HOE_PG_room))
