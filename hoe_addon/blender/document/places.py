# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the root, the eye and the elements of a scene's document stand, and how they are scaled."""

import math
from itertools import chain
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...model.device import LightGuideSpec
from ...model.field_error import FieldError
from ...model.scene_view import gaze_of
from ..build.device import engine_place
from ..props.values import shortest
from ..units import scale_of

_SCALE = 1e-4
"""How far scales that should be equal may be from each other, as a share of them."""

_APART_MM = 0.01
"""How far a part may be from where it belongs."""

_ROUNDING = 1e-6
"""Of places in float32, over their distance from the origin of the scene."""

_DECIMALS = 6
"""Of angles in degrees: what is left is the rounding of float32."""


def is_in(scene: bpy.types.Scene, item: bpy.types.Object) -> bool:
    """Tell whether an object is in a scene; a deleted one lives on where a pointer names it."""
    # Blender finds what is visible at once, and goes through all objects else.
    return item.visible_get(view_layer=scene.view_layers[0]) or item in scene.objects[:]


def root_of(scene: bpy.types.Scene) -> bpy.types.Object:
    """The object whose frame is that of the document.

    Raises:
        FieldError: It is gone.
    """
    root = scene.hologram.root
    if root is None:
        raise FieldError("root", "must be an object; undo, or add the device anew", None)
    return root


def eye_of(scene: bpy.types.Scene) -> bpy.types.Object:
    """The camera that is the eye.

    Raises:
        FieldError: It is gone, or no camera.
    """
    eye = scene.hologram.eye.camera
    if eye is None or eye.type != "CAMERA":
        raise FieldError("eye", "must be a camera; add one with Add > Hologram > Eye", None)
    return eye


def is_stretched(item: bpy.types.Object) -> bool:
    """Tell whether lengths in an object's frame have no one size in the scene.

    It is so where it is scaled by other factors along other axes, or to nothing. A mirrored one
    has its size.
    """
    axes = np.array(item.matrix_world, dtype=float)[:3, :3]
    products = axes.T @ axes
    largest = products.diagonal().max()
    # Also false for what is not finite.
    even = np.abs(products - largest * np.eye(3)).max() <= 2.0 * _SCALE * largest
    return not (even and largest > 0.0)


def check_scales(scene: bpy.types.Scene) -> None:
    """Refuse a device or an eye that has no one size.

    Raises:
        FieldError: It is stretched; with the path.
    """
    for name, item in (("root", root_of(scene)), ("eye", scene.hologram.eye.camera)):
        if item is not None and is_stretched(item):
            rule = "must be the same along all axes, and not 0; set all three in the Item tab"
            scale = [round(side, 4) for side in item.matrix_world.to_scale()]
            raise FieldError(f"{name}.scale", rule, scale)


def check_fixed(scene: bpy.types.Scene, spec: LightGuideSpec) -> None:
    """Refuse a light guide whose plate or light engine is not where its numbers put it.

    Args:
        scene: The scene that holds it.
        spec: Its document.

    Raises:
        FieldError: A part was moved, turned or scaled on its own; with its path.
    """
    guide, engine = scene.hologram.guide, scene.hologram.engine
    _check_fixed("guide", root_of(scene), guide.plate, (0.0, 0.0, 0.0))
    _check_fixed("light engine", root_of(scene), engine.mount, engine_place(spec))
    _check_fixed("display", engine.mount, engine.panel, (0.0, 0.0, spec.lens.focal_length_mm))


def _check_fixed(
    name: str,
    frame: bpy.types.Object | None,
    item: bpy.types.Object | None,
    where: tuple[float, float, float],
) -> None:
    if frame is None or item is None:
        return
    here = frame.matrix_world.inverted_safe() @ item.matrix_world
    away = here.translation - Vector(where)
    far = item.matrix_world.translation.length / scale_of(frame)
    turned = here.to_3x3() - Matrix.Identity(3)
    if away.length > _APART_MM + _ROUNDING * far or max(map(abs, chain(*turned))) > _SCALE:
        rule = "must stand where its numbers put it; undo the move, and move the whole device"
        raise FieldError(name, rule, [round(value, 3) for value in here.translation])


def place(scene: bpy.types.Scene, item: bpy.types.Object) -> dict[str, Any]:
    """Place of an element in the frame of the device, as documents write it.

    Raises:
        FieldError: The element has a size of its own.
    """
    matrix = _in_device(scene, item)
    scale = matrix.to_scale()
    if max(abs(side - 1.0) for side in scale) > _SCALE or matrix.determinant() < 0.0:
        rule = "must be 1; apply the scale (Object > Apply > Scale), or change the size in mm"
        raise FieldError(f"{item.name}.scale", rule, [round(side, 4) for side in scale])
    where, turns = matrix.translation, matrix.to_euler("XYZ")
    if _hangs_plainly(scene, item):
        # As they were typed, without the rounding of matrices.
        where, turns = item.location, item.rotation_euler
    return {
        "name": item.name,
        "position_mm": [shortest(value) for value in where],
        "rotation_deg": [shortest(math.degrees(angle)) for angle in turns],
    }


def gaze(scene: bpy.types.Scene) -> list[float]:
    """Where the eye looks, as documents write it; straight ahead where there is none.

    Raises:
        FieldError: It looks nowhere.
    """
    if scene.hologram.eye.camera is None:
        return [0.0, 0.0]
    eye = eye_of(scene)
    ahead = _in_device(scene, eye).to_3x3() @ Vector((0.0, 0.0, -1.0))
    if not 0.0 < ahead.length_squared < math.inf:
        scale = [round(side, 4) for side in eye.scale]
        raise FieldError("eye.scale", "must be 1; clear it (Object > Clear > Scale)", scale)
    return [round(angle, _DECIMALS) for angle in gaze_of(ahead)]


def eye_place(scene: bpy.types.Scene) -> list[float]:
    """Where the eye is, as documents write it; at the origin where there is none."""
    if scene.hologram.eye.camera is None:
        return [0.0, 0.0, 0.0]
    eye = eye_of(scene)
    plain = _hangs_plainly(scene, eye)
    where = eye.location if plain else _in_device(scene, eye).translation
    return [shortest(value) for value in where]


def _hangs_plainly(scene: bpy.types.Scene, item: bpy.types.Object) -> bool:
    """Tell whether the location and rotation of an object are those in the frame of the device."""
    return (
        item.parent == root_of(scene)
        and item.rotation_mode == "XYZ"
        and not item.constraints
        and item.matrix_parent_inverse.is_identity
        and not any((*item.delta_location, *item.delta_rotation_euler))
    )


def _in_device(scene: bpy.types.Scene, item: bpy.types.Object) -> Matrix:
    """Matrix of an object in the frame of the device."""
    return root_of(scene).matrix_world.inverted_safe() @ item.matrix_world
