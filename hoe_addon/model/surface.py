# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of a hologram's surface as documents write them, told apart by ``shape``; in mm.

The frame of a hologram has its origin on the surface and z along the normal there.
"""

from msgspec import Struct

from . import fields

ON_SURFACE_MM = 1e-9
"""A point nearer to the surface than this counts as on it; far below any real position."""


class PlaneSurface(Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="plane"):
    """A rectangle around the origin in the plane z = 0, its normal along +z.

    Attributes:
        size_mm: Width and height in mm.
    """

    size_mm: tuple[float, float]

    def __post_init__(self) -> None:
        """Check the size."""
        fields.vector(self, "size_mm", 2, above=0.0)

    def holds(self, position_mm: tuple[float, float, float]) -> bool:
        """Tell whether a point lies on the element.

        Args:
            position_mm: The point, in the frame of the surface.

        Returns:
            True on the rectangle, edges included.
        """
        x, y, z = position_mm
        inside = abs(x) <= self.size_mm[0] / 2 and abs(y) <= self.size_mm[1] / 2
        return inside and abs(z) <= ON_SURFACE_MM


type SurfaceSpec = PlaneSurface

SURFACES = (PlaneSurface,)
"""Every shape."""
