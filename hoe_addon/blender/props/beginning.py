# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material has when it becomes a hologram: a valid one at once."""

import bpy

from ..ids import Beam, WaveKind
from .changes import unmarked

_RELIEF_INDEX = 1.5
"""Of a relief in plastic."""

FOCUS_MM = 100.0
"""From the element to the point that the object wave runs to."""

_ORDERS = (0, 1)


def begin(group: bpy.types.PropertyGroup) -> None:
    """Make a new hologram a lens, recorded by a wave to its focus and a plane one.

    Args:
        group: Properties of a hologram that nobody has set yet.
    """
    with unmarked():
        wave = group.recording.object
        wave.kind, wave.beam = WaveKind.POINT, Beam.CONVERGING
        wave.position_mm = (0.0, 0.0, FOCUS_MM)
        group.efficiency.relief.index = _RELIEF_INDEX
        for order in _ORDERS:
            group.orders.add().order = order
