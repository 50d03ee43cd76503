# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A holographic sight: recording waves and the rays of its reticle."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, View, hide_room, take

take(
    Picture(
        "holographic_sight",
        opened=("overlay",),
        view=View((0.0, 180.0, -20.0), 330.0, (68.0, 0.0, 65.0)),
        alone=True,
        prepare=hide_room,
    )
)
