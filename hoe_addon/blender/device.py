# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole light-guide device in a scene: guide, light engine, eye, and the room beyond.

The device's frame (x right, y up, z toward the viewer) stands upright in the scene: the eye looks
along +y of the world, z of the world is up, and one scene unit is one millimetre.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import bpy

from ..core.spectrum import Spectrum
from ..core.wavelength_sampling import by_significance
from ..model.device import LightGuideSpec
from ..model.document import image_path
from ..model.field import field_degrees
from ..shading.pictures import built_in, check_picture
from .eye import add_eye
from .guide import add_guide
from .light_engine import add_light_engine
from .materials import picture
from .render_settings import set_up
from .room import add_living_room
from .spectral import SpectralScene, spectral_scene

_PICTURE_SIDE = 1920
_ROOM_BOUNCES = 2
_LIGHT_GROUPS = ("display", "ambient")


@dataclass(frozen=True, eq=False)
class DeviceScene:
    """A scene that holds a device, and what one changes in it.

    Attributes:
        spec: The document that it was built from.
        scene: The scene.
        eye: The camera object, in the frame of the device.
        panel: The display.
        room: Collection of the room.
        spectral: The sampled spectrum.
    """

    spec: LightGuideSpec
    scene: bpy.types.Scene
    eye: bpy.types.Object
    panel: bpy.types.Object
    room: bpy.types.Collection
    spectral: SpectralScene

    @property
    def camera(self) -> bpy.types.Camera:
        """The eye's lens and pupil."""
        assert isinstance(self.eye.data, bpy.types.Camera)
        return self.eye.data


def build_device(scene: bpy.types.Scene, spec: LightGuideSpec, folder: Path) -> DeviceScene:
    """Build a device in a scene.

    Args:
        scene: An empty scene.
        spec: The device.
        folder: Folder that the display's image file is relative to.

    Returns:
        The scene and its parts.

    Raises:
        MissingOslError: This Blender, or the scene's device, cannot run OSL.
        SpecError: The display's picture or its colours cannot be had.
    """
    _set_up_scene(scene, spec)
    primaries = spec.display.spectra()
    sampling = by_significance(primaries, floor=spec.render.spectrum_floor)
    spectral = spectral_scene(sampling, primaries, spec.render.preview_wavelength_nm)
    device = _collection(scene, "Device")
    root = _empty(device, "Device", None)
    root.rotation_euler = (math.radians(90.0), 0.0, 0.0)
    add_guide(device, spec.guide, spec.holograms, spectral, parent=root)
    image = display_image(spec, folder)
    panel = _add_engine(device, spec, primaries, image, spectral, root)
    eye = add_eye(device, spec.eye, spectral, parent=root)
    scene.camera = eye
    return DeviceScene(spec, scene, eye, panel, _add_room(scene, spec), spectral)


def display_image(spec: LightGuideSpec, folder: Path) -> bpy.types.Image:
    """The picture of a display as a packed image.

    Args:
        spec: The device; the image of its display is a built-in picture or a file.
        folder: Folder that a file is relative to.

    Returns:
        The image.
    """
    display = spec.display
    path = image_path(display, folder)
    if path is None:
        largest = max(display.size_mm)
        width, height = (max(4, round(_PICTURE_SIDE * side / largest)) for side in display.size_mm)
        return picture(display.image, built_in(display.image, width, height, field_degrees(spec)))
    check_picture(path)
    image = bpy.data.images.load(str(path))
    image.pack()
    return image


def _set_up_scene(scene: bpy.types.Scene, spec: LightGuideSpec) -> None:
    settings = spec.render
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.scale_length = 1e-3
    scene.unit_settings.length_unit = "MILLIMETERS"
    set_up(
        scene,
        samples=settings.samples,
        seed=settings.seed,
        spectral=settings.mode == "spectral",
        max_bounces=settings.max_bounces,
    )
    scene.render.resolution_x, scene.render.resolution_y = settings.size
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = settings.exposure_ev
    present = {group.name for group in scene.view_layers[0].lightgroups}
    for name in _LIGHT_GROUPS:
        if name not in present:
            scene.view_layers[0].lightgroups.add(name=name)


def _add_engine(
    collection: bpy.types.Collection,
    spec: LightGuideSpec,
    primaries: tuple[Spectrum, Spectrum, Spectrum],
    image: bpy.types.Image,
    spectral: SpectralScene,
    root: bpy.types.Object,
) -> bpy.types.Object:
    x, y = spec.patch(spec.source.patch).center_mm
    mount = _empty(collection, "Light Engine", root)
    mount.location = (x, y, spec.guide.face_z_mm("eye") + spec.lens.distance_mm)
    white = spec.display.luminance_cd_m2 / spec.render.luminance_per_unit_cd_m2
    return add_light_engine(
        collection, spec.display, spec.lens, image, primaries, white, spectral, mount
    )


def _add_room(scene: bpy.types.Scene, spec: LightGuideSpec) -> bpy.types.Collection:
    room = _collection(scene, "Room")
    if spec.room.kind == "living_room":
        # A third bounce between the walls would add 3 % of light and a quarter of the time.
        scene.cycles.diffuse_bounces = _ROOM_BOUNCES
        add_living_room(room, spec.room.luminance_cd_m2 / spec.render.luminance_per_unit_cd_m2)
    return room


def _collection(scene: bpy.types.Scene, name: str) -> bpy.types.Collection:
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    return collection


def _empty(
    collection: bpy.types.Collection, name: str, parent: bpy.types.Object | None
) -> bpy.types.Object:
    item = bpy.data.objects.new(name, None)
    item.empty_display_size = 5.0
    item.parent = parent
    collection.objects.link(item)
    return item
