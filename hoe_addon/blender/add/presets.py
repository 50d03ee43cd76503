# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole presets: as a scene of their own, or as a device in a scene of the user's."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import replace as with_fields
from pathlib import Path

import bpy
from msgspec.structs import replace

from ...core.errors import HoeError
from ...model.device import DeviceSpec
from ...model.device_parts import RoomSpec
from ...model.document import find_device, load_device
from ..build.device import DeviceScene, build_device
from ..document.gone import clear_gone, is_gone
from ..document.held import whole
from ..document.holding import hold
from ..document.live import remember
from ..document.size import set_size
from ..ids import DeviceKind
from .leaving import all_or_nothing, guest_of

_UPRIGHT_AT_ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class AddedDevice:
    """A device that was added to a scene.

    Attributes:
        root: Object that the whole device hangs on.
        eye: Its camera.
        kept_camera: The camera of the scene that stayed, or None where the eye is it now.
        settings: Names of the render settings that were changed.
    """

    root: bpy.types.Object
    eye: bpy.types.Object
    kept_camera: bpy.types.Object | None
    settings: tuple[str, ...]


def add_scene(preset: DeviceSpec | str | Path, folder: Path | None = None) -> bpy.types.Scene:
    """Make a new scene with all that a document says; what is open stays.

    Args:
        preset: Name of a preset, a JSON file, or a document.
        folder: Folder that pictures of a document are relative to.

    Returns:
        The scene; it holds the document, and its camera is the eye.

    Raises:
        SpecError: There is no such preset, the file is not valid, or a picture cannot be read.
        MissingOslError: This Blender, or its render device, cannot run OSL.
    """
    spec, folder = _found(preset, folder)
    with all_or_nothing():
        scene = bpy.data.scenes.new(spec.name)
        _built(scene, spec, folder)
    return scene


def add_device(
    scene: bpy.types.Scene,
    preset: DeviceSpec | str | Path,
    location: Sequence[float] = _UPRIGHT_AT_ORIGIN,
    folder: Path | None = None,
) -> AddedDevice:
    """Add a device without its room to a scene of the user's, upright, at its true size.

    Size, samples and look of the picture stay as they are.

    Args:
        scene: The scene.
        preset: Name of a preset, a JSON file, or a document.
        location: Where the origin of the document comes, in scene units: the eye, in most.
        folder: Folder that pictures of a document are relative to.

    Returns:
        What was added, and what was changed.

    Raises:
        SpecError: There is no such preset, the file is not valid, or a picture cannot be read.
        HoeError: The scene holds a device already.
        MissingOslError: This Blender, or its render device, cannot run OSL.
    """
    if scene.hologram.kind != DeviceKind.NONE and not is_gone(scene):
        raise HoeError(
            f"scene {scene.name}: holds a device already; delete all of it, or add this one as a "
            "scene of its own"
        )
    spec, folder = _found(preset, folder)
    nowhere = RoomSpec(kind="none", luminance_cd_m2=spec.room.luminance_cd_m2)
    with guest_of(scene) as settings:
        device = _built(scene, replace(spec, room=nowhere), folder)
        device.root.location = location
    set_size(scene)
    kept = scene.camera if scene.camera != device.eye else None
    return AddedDevice(device.root, device.eye, kept, tuple(settings))


def _found(preset: DeviceSpec | str | Path, folder: Path | None) -> tuple[DeviceSpec, Path]:
    if isinstance(preset, str | Path):
        return load_device(preset), folder or find_device(preset).parent
    return preset, folder or Path()


def _built(scene: bpy.types.Scene, spec: DeviceSpec, folder: Path) -> DeviceScene:
    """Build a document with all its effects, and let the scene hold it."""
    device = with_fields(build_device(scene, whole(spec), folder), spec=spec)
    clear_gone(scene)
    hold(device)
    remember(scene)
    return device
