# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light guide with its panels: Device, Render and Effects."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import SCALE, Picture, View, hide_room, part, scene, take

LARGE = SCALE != "1"


def prepare() -> None:
    """Work the plan out; the room would stand before the guide."""
    hide_room()
    held, plans = part("blender.document.held"), part("ui.facts.plans")
    plans.plan_now(scene(), held.document_of(scene()))


take(
    Picture(
        "two_hologram_ar",
        opened=("device", "render") if LARGE else ("device", "render", "effects"),
        view=View((12.0, 10.0, 0.0), 75.0, (62.0, 0.0, 30.0)),
        alone=LARGE,
        prepare=prepare,
    )
)
