# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What all elements of a scene document have: a name and a place."""

from msgspec import Struct

from . import field_kinds, fields

type Place = tuple[float, float, float]


class SceneElement(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind"):
    """Common part of all elements.

    Attributes:
        name: Name of the element, once in a scene.
        position_mm: Where the origin of its frame is.
        rotation_deg: Turns about x, y and z of the scene, in this order.
    """

    name: str
    position_mm: Place
    rotation_deg: Place = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Check name and place."""
        field_kinds.text(self, "name")
        fields.vector(self, "position_mm", 3)
        fields.vector(self, "rotation_deg", 3)
