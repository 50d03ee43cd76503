# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene whose engine cannot render holograms, with the button that mends it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from window import Picture, scene, show_properties, take


def prepare() -> None:
    """Choose an engine that cannot render holograms."""
    scene().render.engine = "BLENDER_EEVEE"
    show_properties("RENDER")


take(Picture("two_hologram_ar", opened=("render",), hidden=(), prepare=prepare))
