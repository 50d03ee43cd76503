# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a build without Open Shading Language says."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, View, hide_room, take

take(
    Picture(
        "two_hologram_ar",
        opened=("device",),
        hidden=(),
        view=View((12.0, 10.0, 0.0), 75.0, (62.0, 0.0, 30.0)),
        prepare=hide_room,
    )
)
