# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light guide: recording waves, chief rays, pupil, eyebox."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, View, hide_room, scene, take


def prepare() -> None:
    """Let the light engine be looked into."""
    hide_room()
    next(each for each in scene().objects if each.name == "Housing").display_type = "WIRE"


take(
    Picture(
        "two_hologram_ar",
        opened=("overlay",),
        view=View((12.0, 10.0, 0.0), 62.0, (60.0, 0.0, 25.0)),
        alone=True,
        prepare=prepare,
    )
)
