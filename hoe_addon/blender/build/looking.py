# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The view through the eye of a device."""

import bpy

from ...core.errors import SpecError


def look_through_eye(scene: bpy.types.Scene, space: bpy.types.SpaceView3D | None = None) -> None:
    """Make the eye the camera of its scene, and look through it.

    Args:
        scene: A scene with a device.
        space: The 3-D view that looks; None where there is none.

    Raises:
        SpecError: The device has no eye, or it is not in the scene.
    """
    eye = scene.hologram.eye.camera
    if eye is None or eye.name not in scene.objects:
        raise SpecError("eye: is missing in this scene; add one with Add > Hologram > Eye")
    scene.camera = eye
    if space is not None and space.region_3d is not None:
        space.region_3d.view_perspective = "CAMERA"
