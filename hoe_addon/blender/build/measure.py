# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions measured in rendered pictures of a scene."""

import math

import numpy as np
from numpy.typing import NDArray

from ...core.errors import RenderError
from ..pictures.render import render_layers
from ..pictures.render_settings import picture_size
from ..pictures.view import DISPLAY_LAYER
from .device import DeviceScene


def emitters_picture(device: DeviceScene) -> NDArray[np.float64]:
    """Render the light of displays and lamps alone.

    Args:
        device: The scene.

    Returns:
        Sum of the three colours, shape ``(height, width)``, top row first.

    Raises:
        RenderError: Blender gave no usable picture.
    """
    picture = render_layers(device.scene, (DISPLAY_LAYER,))[DISPLAY_LAYER]
    return picture.astype(np.float64).sum(axis=2)


def seen_direction(device: DeviceScene) -> NDArray[np.float64]:
    """Render, and find the direction of the centroid of the light of displays and lamps.

    Args:
        device: The scene; let it show one spot, and nothing else that gives light.

    Returns:
        Unit vector from the eye in the frame of the scene, shape ``(3,)``.

    Raises:
        RenderError: Nothing is seen.
    """
    light = emitters_picture(device)
    total = light.sum()
    if not total > 0.0:
        raise RenderError("no light of a display or a lamp is seen")
    height, width = light.shape
    column = float(light.sum(axis=0) @ (np.arange(width) + 0.5)) / total
    row = float(light.sum(axis=1) @ (np.arange(height) + 0.5)) / total
    return pixel_direction(device, column, row)


def pixel_direction(device: DeviceScene, column: float, row: float) -> NDArray[np.float64]:
    """Direction of a place of the picture.

    Args:
        device: The scene.
        column: Pixels from the left edge.
        row: Pixels from the top edge.

    Returns:
        Unit vector from the eye in the frame of the scene, shape ``(3,)``.
    """
    width, height = picture_size(device.scene)
    pixel = 2.0 * math.tan(math.radians(device.spec.eye.field_deg) / 2.0) / width
    local = np.array([(column - width / 2.0) * pixel, (height / 2.0 - row) * pixel, -1.0])
    direction = np.array(device.eye.rotation_euler.to_matrix(), dtype=np.float64) @ local
    return direction / np.linalg.norm(direction)
