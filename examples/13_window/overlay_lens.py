# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A lens recorded with a point and a plane wave."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, View, hide_room, take

take(
    Picture(
        "point_lens",
        opened=("overlay",),
        view=View((0.0, 230.0, 0.0), 480.0, (70.0, 0.0, 65.0)),
        alone=True,
        prepare=hide_room,
    )
)
