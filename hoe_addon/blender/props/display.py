# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A display as properties: its picture, size, brightness and colours."""

import json
from pathlib import Path
from typing import Any

import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, PointerProperty
from bpy.props import StringProperty as TextProperty

from ...core.spectrum import DISPLAY_PRIMARIES
from ...model.reading import parse_json
from ..ids import PictureKind, Primaries, White
from ..registration import class_registrars
from .changes import mark
from .values import number, numbers, reset, store

LUMINANCE_LIMITS = {"min": 0.0, "max": 1e9, "soft_max": 1e5, "step": 1000, "precision": 1}
"""Limits, slider range and digits of every luminance in cd/m^2."""

SIZE_LIMITS = {
    "min": 1e-6,
    "soft_min": 0.1,
    "soft_max": 500.0,
    "step": 100,
    "precision": 3,
}
"""Limits, slider range and digits of every length in mm."""

_SETS = ", ".join(DISPLAY_PRIMARIES)


def length(name: str, words: str, default: float) -> Any:
    """A property that is a length in mm."""
    return FloatProperty(
        name=name,
        description=f"{words}, in mm",
        default=default,
        update=mark,
        min=1e-6,
        soft_min=0.01,
        soft_max=500.0,
        step=10,
        precision=3,
    )


def picture_field(group: bpy.types.PropertyGroup) -> str:
    """The picture of a group as documents name it.

    Args:
        group: Group with ``picture`` and ``image``.

    Returns:
        Name of a built-in picture, or path of a file. An image that is in no file (painted, or
        packed) has its datablock's name: documents elsewhere cannot show it.
    """
    if group.picture != PictureKind.IMAGE:
        return group.picture
    if group.image is None:
        return ""
    path = bpy.path.abspath(group.image.filepath, library=group.image.library)
    return path if path and Path(path).is_file() else f"{group.image.name}"


def take_picture(group: bpy.types.PropertyGroup, name: str, image: bpy.types.Image | None) -> None:
    """Take the picture of a document.

    Args:
        group: Group with ``picture`` and ``image``.
        name: Name of a built-in picture, or of a file.
        image: The image that shows it, for a file.
    """
    if name in set(PictureKind) - {PictureKind.IMAGE}:
        group.picture, group.image = name, None
    else:
        group.picture, group.image = PictureKind.IMAGE, image


def _kind_of_primaries(group: "HOE_PG_display") -> int:
    known = Primaries.__members__.values()
    found = next((each for each in known if each == group.primaries.strip()), Primaries.OWN)
    return found.number


def _choose_primaries(group: "HOE_PG_display", chosen: int) -> None:
    """Write the name of a set; own lines begin as those of the set before."""
    kind = next(each for each in Primaries if each.number == chosen)
    if kind != Primaries.OWN:
        group.primaries = kind.value
    elif group.primaries.strip() in DISPLAY_PRIMARIES:
        bands = DISPLAY_PRIMARIES[group.primaries.strip()].bands_nm
        lines = [{"centre_nm": centre, "fwhm_nm": wide} for centre, wide in bands]
        group.primaries = json.dumps(lines)


class HOE_PG_display(bpy.types.PropertyGroup):
    """A flat picture that gives light."""

    picture: EnumProperty(
        name="Picture",
        description="What the display shows",
        items=PictureKind.items(),
        default=PictureKind.CHART,
        update=mark,
    )
    image: PointerProperty(
        name="Image",
        description="Image that the display shows; its colours are the drives of the primaries",
        type=bpy.types.Image,
        update=mark,
    )
    size_mm: FloatVectorProperty(
        name="Size",
        description="Width and height of the display, in mm",
        size=2,
        subtype="XYZ",
        default=(10.0, 7.5),
        update=mark,
        **SIZE_LIMITS,
    )
    luminance_cd_m2: FloatProperty(
        name="Luminance",
        description="Luminance of the display's white, in cd/m²; a phone has about 500",
        default=500.0,
        update=mark,
        **LUMINANCE_LIMITS,
    )
    white: EnumProperty(
        name="White",
        description="White point that the primaries are balanced to",
        items=White.items(),
        default=White.D65,
        update=mark,
    )
    primaries: TextProperty(
        name="Primaries",
        description=f"Spectra of red, green and blue: {_SETS}, or the JSON of three lines with "
        "centre_nm and fwhm_nm",
        default=next(iter(DISPLAY_PRIMARIES)),
        update=mark,
    )
    kind_of_primaries: EnumProperty(
        name="Primaries",
        description="What makes the red, green and blue of the display",
        items=Primaries.items(),
        get=_kind_of_primaries,
        set=_choose_primaries,
        options=set(),
    )

    def to_document(self) -> dict[str, Any]:
        """The display as documents write it."""
        text = self.primaries.strip()
        return {
            "image": picture_field(self),
            "size_mm": numbers(self, "size_mm"),
            "luminance_cd_m2": number(self, "luminance_cd_m2"),
            "primaries": parse_json(text) if text.startswith(("[", "{")) else text,
            "white": self.white,
        }

    def from_document(
        self, document: dict[str, Any], path: str, image: bpy.types.Image | None
    ) -> None:
        """Take the display of a document.

        Args:
            document: The display.
            path: Its path, for messages.
            image: The image that shows its picture, where that is a file.
        """
        reset(self)
        take_picture(self, document["image"], image)
        store(self, "size_mm", document["size_mm"], path)
        store(self, "luminance_cd_m2", document["luminance_cd_m2"], path)
        self.white = document["white"]
        primaries = document["primaries"]
        self.primaries = primaries if isinstance(primaries, str) else json.dumps(primaries)


register, unregister = class_registrars((HOE_PG_display,))
