# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material has when it becomes a hologram: a valid one at once."""

import bpy

from ..ids import WaveKind
from .changes import unmarked

_RELIEF_INDEX = 1.5
"""Of a relief in plastic."""

_ORDERS = (0, 1)


def begin(group: bpy.types.PropertyGroup) -> None:
    """Make a new hologram the lens of a point source, with the light that goes straight on.

    Args:
        group: Properties of a hologram that nobody has set yet.
    """
    with unmarked():
        group.recording.object.kind = WaveKind.POINT
        group.efficiency.relief.index = _RELIEF_INDEX
        for order in _ORDERS:
            group.orders.add().order = order
