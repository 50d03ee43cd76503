# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How large a device stands in its scene; its picture does not depend on it."""

import math

import bpy

from ...core.errors import HoeError
from ..units import scale_of, units_per_mm
from .refusing import settle_or_restore

_NEAR = 1e-4


def enlargement(scene: bpy.types.Scene) -> float:
    """How many times its true size a device has in a scene.

    Args:
        scene: A scene that holds a document.

    Returns:
        Size over true size; exactly 1 where only rounding is between them, or nothing is there.
    """
    root = scene.hologram.root
    if root is None:
        return 1.0
    ratio = scale_of(root) / units_per_mm(scene)
    return 1.0 if abs(ratio - 1.0) < _NEAR else ratio


def set_size(scene: bpy.types.Scene, times: float = 1.0) -> None:
    """Set how large a device is, about the origin of its document; its eye follows.

    Args:
        scene: A scene that holds a document.
        times: Size over true size, by the units of the scene; above 0.

    Raises:
        HoeError: The size is none, or the device is gone or has no size to begin with.
        SpecError: The document is not valid; the size stays as it was.
    """
    root = scene.hologram.root
    if not 0.0 < times < math.inf:
        raise HoeError(f"size: must be above 0 times the true size, got {times:g}")
    if root is None:
        raise HoeError(f"scene {scene.name}: holds no device; add one with Add > Hologram")
    for layer in scene.view_layers:
        layer.update()
    if not scale_of(root) > 0.0:
        raise HoeError(f"object {root.name}: must not be scaled to nothing")
    before = root.scale.copy()
    root.scale *= times * units_per_mm(scene) / scale_of(root)

    def restore() -> None:
        root.scale = before

    settle_or_restore(scene, restore)
