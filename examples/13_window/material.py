# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram of a material: how it is recorded, and its efficiency with a plot."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import SCALE, Picture, View, hide_room, scroll, show_properties, take

LARGE = SCALE != "1"


def prepare() -> None:
    """Show the material's panels in the properties editor too."""
    hide_room()
    if not LARGE:
        show_properties("MATERIAL")


def later() -> None:
    """Bring the plot into the window."""
    if LARGE:
        scroll("VIEW_3D", 7)
    else:
        scroll("PROPERTIES", 9)


take(
    Picture(
        "point_lens",
        opened=("hologram_sidebar", "hologram_efficiency_sidebar")
        if LARGE
        else ("hologram", "hologram_recording_sidebar", "hologram_efficiency_material"),
        view=View((40.0, 330.0, -20.0), 300.0, (70.0, 0.0, 35.0)),
        alone=LARGE,
        prepare=prepare,
        later=later,
    )
)
