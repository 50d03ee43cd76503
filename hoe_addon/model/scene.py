# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document of a scene: holograms, displays, lamps and other things, and an eye that looks.

Frame: x right, y up, z toward the viewer, in mm. The eye's pupil is at ``eye.position_mm``, at the
origin by default, and looks along -z, turned by ``gaze_deg``.
"""

from typing import Literal

from msgspec import Struct

from . import field_kinds, fields
from .device_parts import BUILT_IN_IMAGES, EyeSpec, RenderSpec, RoomSpec
from .field_error import FieldError
from .scene_parts import CardElement, DisplayElement, ElementSpec, HologramElement

_STEEPEST_DEG = 90.0
_HALF_TURN_DEG = 180.0
_MAX_ELEMENTS = 200


class SceneSpec(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="scene"
):
    """Any arrangement of holograms and what they are looked at with.

    Attributes:
        schema: Version of the document's format.
        name: Short name, as the preset's file.
        title: One line for lists.
        description: What it shows, and where its numbers come from.
        elements: All that stands in the scene.
        eye: The eye that looks.
        gaze_deg: Where it looks: degrees to the right, and degrees up.
        room: What is behind and around.
        render: How the picture is made.
    """

    schema: Literal[1] = 1
    name: str
    title: str
    description: str = ""
    elements: tuple[ElementSpec, ...]
    eye: EyeSpec
    gaze_deg: tuple[float, float] = (0.0, 0.0)
    room: RoomSpec
    render: RenderSpec

    def __post_init__(self) -> None:
        """Check what the parts cannot check alone."""
        field_kinds.text(self, "name")
        field_kinds.text(self, "title")
        field_kinds.text(self, "description", empty=True)
        field_kinds.instance(self, "eye", EyeSpec)
        field_kinds.instance(self, "room", RoomSpec)
        field_kinds.instance(self, "render", RenderSpec)
        aside, up = fields.vector(self, "gaze_deg", 2)
        if abs(aside) > _HALF_TURN_DEG:
            raise FieldError("gaze_deg[0]", f"must be within {_HALF_TURN_DEG:g}", aside)
        if abs(up) > _STEEPEST_DEG:
            raise FieldError("gaze_deg[1]", f"must be within {_STEEPEST_DEG:g}", up)
        if len(self.elements) > _MAX_ELEMENTS:
            rule = f"must hold at most {_MAX_ELEMENTS} elements"
            raise FieldError("elements", rule, len(self.elements))
        names: set[str] = set()
        for place, element in enumerate(self.elements):
            if element.name in names:
                raise FieldError(f"elements[{place}].name", "must be used once", element.name)
            names.add(element.name)

    @property
    def picture_files(self) -> tuple[tuple[str, str], ...]:
        """Pictures that are files: the field that names each, and the name."""
        found: list[tuple[str, str]] = []
        for place, element in enumerate(self.elements):
            if isinstance(element, DisplayElement):
                if element.display.image not in BUILT_IN_IMAGES:
                    found.append((f"elements[{place}].display.image", element.display.image))
            elif isinstance(element, CardElement) and element.is_file:
                found.append((f"elements[{place}].image", element.image))
        return tuple(found)

    def element(self, name: str) -> ElementSpec:
        """Find an element by its name.

        Args:
            name: Name of the element.

        Returns:
            The element.

        Raises:
            FieldError: If there is none; the message lists the names.
        """
        for element in self.elements:
            if element.name == name:
                return element
        names = ", ".join(element.name for element in self.elements)
        raise FieldError("elements", f"must name an element ({names})", name)

    def hologram(self, name: str) -> HologramElement:
        """Find a hologram by the name of its element.

        Args:
            name: Name of the element.

        Returns:
            The element.

        Raises:
            FieldError: If there is none, or it is no hologram.
        """
        element = self.element(name)
        if not isinstance(element, HologramElement):
            raise FieldError("elements", "must name a hologram", name)
        return element
