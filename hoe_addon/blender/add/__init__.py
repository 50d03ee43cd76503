# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Add > Hologram makes: whole scenes, devices in a scene of one's own, single elements.

Functions for scripts and operators alike; none looks at the window.
"""

import bpy  # noqa: F401  # as a module of Python, Blender brings bmesh and mathutils only with it
