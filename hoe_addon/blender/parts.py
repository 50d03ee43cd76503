# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The modules that register something with Blender, each after those that it depends on."""

from .props import efficiency, hologram, map_files, material, medium, recording, sync, targets
from .registration import Part

PARTS: tuple[Part, ...] = (
    medium,
    recording,
    efficiency,
    hologram,
    material,
    sync,
    targets,
    map_files,
)
