# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A preset, one source of its recording moved, and what that does to the picture."""

import math

import hoe_addon
from hoe_addon.blender.api import add_scene, device_of, refresh_changed, render_view

hoe_addon.register()
scene = add_scene("holographic_sight")
window = scene.objects["window"].active_material.hologram
window.recording.object.position_mm = (500, 0, -50000)  # 50 m away, half a metre to the right
refresh_changed()
scene.render.resolution_x, scene.render.resolution_y, scene.cycles.samples = 240, 180, 16

luminance = render_view(device_of(scene)).display @ (0.2126, 0.7152, 0.0722)
middle = (luminance.sum(axis=0) @ range(240) / luminance.sum() + 0.5) / 240 - 0.5
right = math.degrees(math.atan(2 * middle * math.tan(math.radians(15 / 2))))
print(f"reticle: {right:.2f} degrees to the right; mean {3000 * luminance.mean():.1f} cd/m2")
