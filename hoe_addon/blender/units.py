# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many units of a scene are one millimetre, and how large a device stands in it.

Parts of a device have their lengths in mm in their own frames. What the device hangs on is scaled
by the units of the scene, so that it has its true size there, whether a unit is a metre or an inch.
"""

import bpy

MILLIMETRE = 1e-3
"""Metres in one scene unit where that is a millimetre."""


def units_per_mm(scene: bpy.types.Scene) -> float:
    """Scene units in one mm of the true size, without the rounding of Blender's float32."""
    return float(f"{MILLIMETRE / scene.unit_settings.scale_length:.6g}")


def in_millimetres(scene: bpy.types.Scene) -> bool:
    """Tell whether one unit of a scene is one millimetre."""
    return units_per_mm(scene) == 1.0


def use_millimetres(scene: bpy.types.Scene) -> None:
    """Say that one unit is one millimetre, and scale nothing."""
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.scale_length = MILLIMETRE
    scene.unit_settings.length_unit = "MILLIMETERS"


def scale_of(item: bpy.types.Object | None) -> float:
    """How many scene units one unit of an object is long, its parents' scale included.

    Args:
        item: The object; None where it is gone.

    Returns:
        The mean of its three axes, without the rounding that turning it brings; 1 for None.
    """
    if item is None:
        return 1.0
    return float(f"{sum(abs(side) for side in item.matrix_world.to_scale()) / 3.0:.6g}")
