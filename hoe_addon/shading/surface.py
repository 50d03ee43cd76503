# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface's shape in the shader: code for its true normal, and for the exact hit.

The code may read ``position`` and ``heading`` (the hit and the ray's unit direction of travel, in
the frame of the recording, in scene units) and sets ``frame_normal`` (which begins as +z); it may
move ``position`` onto the true surface.
"""

from ..model.surface import SurfaceSpec
from .part import ShaderPart


def surface_part(surface: SurfaceSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for the shape.

    Args:
        surface: The shape.
        units_per_mm: Scene units in one mm.

    Returns:
        Its part; a plane needs none.
    """
    del surface, units_per_mm
    return ShaderPart()
