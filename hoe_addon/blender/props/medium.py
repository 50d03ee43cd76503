# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A medium as properties: a constant index, a name of the catalogue, or Sellmeier coefficients."""

from typing import Any

import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, PointerProperty

from ..ids import MediumKind, catalogue_items
from ..registration import class_registrars
from .changes import mark
from .values import number, numbers, reset, store


class HOE_PG_medium(bpy.types.PropertyGroup):
    """One medium; only the fields of its kind count."""

    kind: EnumProperty(
        name="Medium",
        description="How the medium is given",
        items=MediumKind.items(),
        default=MediumKind.CONSTANT,
        update=mark,
    )
    index: FloatProperty(
        name="Index",
        description="Refractive index at every wavelength, relative to air",
        default=1.0,
        min=1.0,
        soft_max=2.5,
        step=1,
        precision=4,
        update=mark,
    )
    catalogue_name: EnumProperty(
        name="Material",
        description="Glass or plastic of the catalogue",
        items=catalogue_items(),
        default="N-BK7",
        update=mark,
    )
    a: FloatProperty(
        name="A",
        description="Constant term of the squared index, 1 for most glasses, without unit",
        default=1.0,
        soft_min=1.0,
        soft_max=5.0,
        step=1,
        precision=6,
        update=mark,
    )
    b: FloatVectorProperty(
        name="B",
        description="Strengths B1, B2 and B3 of the Sellmeier formula, without unit",
        size=3,
        default=(0.0, 0.0, 0.0),
        soft_min=0.0,
        soft_max=5.0,
        step=1,
        precision=6,
        update=mark,
    )
    c_um2: FloatVectorProperty(
        name="C",
        description="C1, C2 and C3 of the Sellmeier formula, in square micrometres",
        size=3,
        default=(0.0, 0.0, 0.0),
        soft_min=0.0,
        soft_max=200.0,
        step=1,
        precision=6,
        update=mark,
    )

    def to_document(self) -> object:
        """The medium as documents write it."""
        match MediumKind(self.kind):
            case MediumKind.CONSTANT:
                return number(self, "index")
            case MediumKind.CATALOGUE:
                return self.catalogue_name
        terms = {"b": numbers(self, "b"), "c_um2": numbers(self, "c_um2"), "a": number(self, "a")}
        return {"sellmeier": terms}

    def from_document(self, document: Any, path: str) -> None:
        """Take the medium of a document.

        Args:
            document: A number, a name, or the coefficients.
            path: Its path, for messages.
        """
        reset(self)
        if isinstance(document, str):
            self.kind = MediumKind.CATALOGUE
            self.catalogue_name = document
        elif isinstance(document, dict):
            self.kind = MediumKind.SELLMEIER
            for field, value in document["sellmeier"].items():
                store(self, field, value, f"{path}.sellmeier")
        else:
            self.kind = MediumKind.CONSTANT
            store(self, "index", document, path)


class HOE_PG_media(bpy.types.PropertyGroup):
    """The media on the two sides."""

    back: PointerProperty(
        name="Back", description="Medium behind the surface, z < 0", type=HOE_PG_medium
    )
    front: PointerProperty(
        name="Front", description="Medium before the surface, z > 0", type=HOE_PG_medium
    )

    def to_document(self) -> dict[str, Any]:
        """Both media as documents write them."""
        return {"back": self.back.to_document(), "front": self.front.to_document()}

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take both media of a document.

        Args:
            document: The media by side.
            path: Their path, for messages.
        """
        self.back.from_document(document["back"], f"{path}.back")
        self.front.from_document(document["front"], f"{path}.front")


register, unregister = class_registrars((HOE_PG_medium, HOE_PG_media))
