# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an object is in a device or a scene, ``Object.hologram``.

The place of an element is that of its object, its hologram that of its material. What has no
property of its own is kept as text.
"""

from typing import Any

import bpy
from bpy.props import (
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..ids import PictureKind, Role
from ..registration import class_registrars
from . import details
from .changes import mark
from .display import LUMINANCE_LIMITS, SIZE_LIMITS, HOE_PG_display, picture_field, take_picture
from .values import number, numbers, reset, store

PLACE = ("name", "position_mm", "rotation_deg")
"""Fields of an element that its object has."""

_OWN = {
    Role.DISPLAY: ("display",),
    Role.LAMP: ("size_mm", "luminance_cd_m2"),
    Role.CARD: ("image", "size_mm"),
    Role.HOLOGRAM: ("hologram",),
}
"""Fields of an element that have properties, or stand in its material."""


class HOE_PG_element(bpy.types.PropertyGroup):
    """An element; only the fields of its role count."""

    role: EnumProperty(
        name="Role",
        description="What the object is",
        items=Role.items(),
        default=Role.NONE,
    )
    display: PointerProperty(
        name="Display", description="Picture that gives light", type=HOE_PG_display
    )
    picture: EnumProperty(
        name="Picture",
        description="What is printed on the card",
        items=PictureKind.items(),
        default=PictureKind.CHART,
        update=mark,
    )
    image: PointerProperty(
        name="Image", description="Image on the card", type=bpy.types.Image, update=mark
    )
    size_mm: FloatVectorProperty(
        name="Size",
        description="Width and height of a lamp or a card, in mm",
        size=2,
        subtype="XYZ",
        default=(10.0, 10.0),
        update=mark,
        **SIZE_LIMITS,
    )
    luminance_cd_m2: FloatProperty(
        name="Luminance",
        description="Luminance of the lamp, in cd/m²; the sky has about 5000",
        default=1000.0,
        update=mark,
        **LUMINANCE_LIMITS,
    )
    details: StringProperty(
        name="Details",
        description="JSON of the fields of this element that have no properties",
        update=mark,
    )
    rank: IntProperty(
        description="Where the element stands in its document; equal ones stand in order of name",
        options={"HIDDEN"},
    )
    made_of: StringProperty(
        description="What the object was last made of, to see what has changed",
        options={"HIDDEN"},
    )

    def to_document(self) -> dict[str, Any]:
        """The element as documents write it, without its place and its hologram."""
        path = self.id_data.name
        elsewhere = (*PLACE, *_OWN.get(Role(self.role), ()))
        document = details.read(self.details, "kind", self.role, path, elsewhere)
        match Role(self.role):
            case Role.DISPLAY:
                document["display"] = self.display.to_document()
            case Role.LAMP:
                document["size_mm"] = numbers(self, "size_mm")
                document["luminance_cd_m2"] = number(self, "luminance_cd_m2")
            case Role.CARD:
                document["image"] = picture_field(self)
                document["size_mm"] = numbers(self, "size_mm")
        return document

    def from_document(
        self, document: dict[str, Any], path: str, image: bpy.types.Image | None = None
    ) -> None:
        """Take an element of a document.

        Args:
            document: The element.
            path: Its path, for messages.
            image: The image that shows its picture, where that is a file.
        """
        reset(self)
        self.role = document["kind"]
        own = (*PLACE, *_OWN.get(Role(self.role), ()))
        rest = {name: item for name, item in document.items() if name not in own}
        self.details = details.written(rest, "kind")
        match Role(self.role):
            case Role.DISPLAY:
                self.display.from_document(document["display"], f"{path}.display", image)
            case Role.LAMP:
                store(self, "size_mm", document["size_mm"], path)
                store(self, "luminance_cd_m2", document["luminance_cd_m2"], path)
            case Role.CARD:
                take_picture(self, document["image"], image)
                store(self, "size_mm", document["size_mm"], path)


_register, _unregister = class_registrars((HOE_PG_element,))


def register() -> None:
    """Add ``Object.hologram``."""
    _register()
    bpy.types.Object.hologram = PointerProperty(
        name="Hologram",
        description="What the object is in a device",
        type=HOE_PG_element,
        override={"LIBRARY_OVERRIDABLE"},
    )


def unregister() -> None:
    """Take it away; what files hold in it stays in them."""
    del bpy.types.Object.hologram
    _unregister()
