# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan of a light guide: what is simulated, what is left out, and why."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, View, hide_room, part, scene, take


def prepare() -> None:
    """Work the plan out."""
    hide_room()
    held, plans = part("blender.document.held"), part("ui.facts.plans")
    plans.plan_now(scene(), held.document_of(scene()))


take(
    Picture(
        "two_hologram_ar",
        opened=("effects",),
        view=View((12.0, 10.0, 0.0), 75.0, (62.0, 0.0, 30.0)),
        alone=True,
        prepare=prepare,
    )
)
