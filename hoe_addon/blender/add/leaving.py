# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Adding to a scene of the user's: all of it or nothing, and settings that are theirs stay."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from ..document.places import is_in
from ..ids import DeviceKind, Role
from ..units import use_millimetres

_KEPT = (
    "render.resolution_x",
    "render.resolution_y",
    "render.resolution_percentage",
    "render.use_border",
    "render.use_compositing",
    "render.use_sequencer",
    "render.use_multiview",
    "cycles.samples",
    "cycles.seed",
    "cycles.use_animated_seed",
    "cycles.diffuse_bounces",
    "view_settings.view_transform",
    "view_settings.look",
    "view_settings.exposure",
)
"""What a picture looks like and where it goes; holograms work with any of it."""

_UNITS = ("unit_settings.system", "unit_settings.scale_length", "unit_settings.length_unit")
"""An empty scene gets millimetres; elsewhere they stay."""

_SET = (
    "render.engine",
    "render.use_motion_blur",
    "render.motion_blur_shutter",
    "render.motion_blur_position",
    "render.pixel_aspect_x",
    "render.pixel_aspect_y",
    "cycles.shading_system",
    "cycles.use_adaptive_sampling",
    "cycles.time_limit",
    "cycles.use_denoising",
    "cycles.sample_clamp_direct",
    "cycles.sample_clamp_indirect",
    "cycles.blur_glossy",
    "cycles.light_sampling_threshold",
    "cycles.use_light_tree",
    "cycles.transparent_max_bounces",
    "cycles.min_transparent_bounces",
    "cycles.rolling_shutter_type",
    "cycles.film_exposure",
)
"""What holograms need at a certain value."""


@contextmanager
def all_or_nothing() -> Iterator[None]:
    """Take away every datablock that was made, should the work fail."""
    before = {block.session_uid for block in _blocks()}
    try:
        yield
    except BaseException:
        bpy.data.batch_remove([each for each in _blocks() if each.session_uid not in before])
        raise


@contextmanager
def guest_of(scene: bpy.types.Scene) -> Iterator[list[str]]:
    """Add to a scene: its own settings stay, and all is as it was should the work fail.

    Units stay too; an empty scene gets millimetres.

    Args:
        scene: The user's scene.

    Yields:
        A list; at the end it has the names of the settings that were changed.
    """
    camera, kind = scene.camera, scene.hologram.kind
    own = None if _is_deleted_eye(scene, camera) else camera
    scene.camera = own
    before = {path: _get(scene, path) for path in (*_KEPT, *_UNITS, *_SET)}
    if not scene.objects:
        use_millimetres(scene)
    kept = {path: _get(scene, path) for path in (*_KEPT, *_UNITS)}
    told: list[str] = []
    try:
        with all_or_nothing():
            yield told
    except BaseException:
        _restore(scene, before)
        scene.camera = camera
        if kind == DeviceKind.NONE:
            scene.property_unset("hologram")
        raise
    _restore(scene, kept)
    if own is not None:
        scene.camera = own
    told += [_label(scene, path) for path in _SET if _get(scene, path) != before[path]]
    if any(_get(scene, path) != before[path] for path in _UNITS):
        told.append("Units")


def _is_deleted_eye(scene: bpy.types.Scene, camera: bpy.types.Object | None) -> bool:
    """Tell whether a camera is an eye that only pointers of the scene keep."""
    return camera is not None and camera.hologram.role == Role.EYE and not is_in(scene, camera)


def _blocks() -> Iterator[bpy.types.ID]:
    for prop in bpy.data.bl_rna.properties:
        if prop.type == "COLLECTION":
            yield from getattr(bpy.data, prop.identifier)


def _restore(scene: bpy.types.Scene, values: dict[str, Any]) -> None:
    for path, value in values.items():
        group, field = path.split(".")
        if _get(scene, path) != value:
            setattr(getattr(scene, group), field, value)


def _get(scene: bpy.types.Scene, path: str) -> Any:
    group, field = path.split(".")
    return getattr(getattr(scene, group), field)


def _label(scene: bpy.types.Scene, path: str) -> str:
    group, field = path.split(".")
    return getattr(scene, group).bl_rna.properties[field].name
