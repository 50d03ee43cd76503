# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole device in a scene: a light guide with its light engine and eye, or any scene.

The device's frame (x right, y up, z toward the viewer) stands upright in the scene: the eye looks
along +y of the world, z of the world is up, and one scene unit is one millimetre.
"""

from dataclasses import dataclass
from pathlib import Path

import bpy

from ..core.spectrum import Spectrum
from ..core.wavelength_sampling import by_significance
from ..model.device import DeviceSpec, LightGuideSpec
from ..model.field import field_degrees
from .eye import add_eye
from .guide import add_guide
from .light_engine import add_light_engine
from .scene import add_scene
from .spectral import SpectralScene, spectral_scene
from .stage import add_room, device_root, display_image, empty, new_collection, prepare_scene


@dataclass(frozen=True, eq=False)
class DeviceScene:
    """A scene that holds a device, and what one changes in it.

    Attributes:
        spec: The document that it was built from.
        scene: The scene.
        eye: The camera object, in the frame of the device.
        panel: The display of a light guide; None in a scene of another kind.
        room: Collection of the room.
        spectral: The sampled spectrum.
    """

    spec: DeviceSpec
    scene: bpy.types.Scene
    eye: bpy.types.Object
    panel: bpy.types.Object | None
    room: bpy.types.Collection
    spectral: SpectralScene

    @property
    def camera(self) -> bpy.types.Camera:
        """The eye's lens and pupil."""
        assert isinstance(self.eye.data, bpy.types.Camera)
        return self.eye.data

    @property
    def guide_spec(self) -> LightGuideSpec:
        """The document of a light guide; asked for only where the device is one."""
        assert isinstance(self.spec, LightGuideSpec)
        return self.spec


def build_device(scene: bpy.types.Scene, spec: DeviceSpec, folder: Path) -> DeviceScene:
    """Build a device in a scene.

    Args:
        scene: An empty scene.
        spec: The device.
        folder: Folder that image files are relative to.

    Returns:
        The scene and its parts.

    Raises:
        MissingOslError: This Blender, or the scene's device, cannot run OSL.
        SpecError: A picture or the colours of a display cannot be had.
    """
    prepare_scene(scene, spec.render)
    device = new_collection(scene, "Device")
    root = device_root(device)
    panel = None
    if isinstance(spec, LightGuideSpec):
        primaries = spec.display.spectra()
        sampling = by_significance(primaries, floor=spec.render.spectrum_floor)
        spectral = spectral_scene(sampling, primaries, spec.render.preview_wavelength_nm)
        add_guide(device, spec.guide, spec.holograms, spectral, parent=root)
        panel = _add_engine(device, spec, primaries, folder, spectral, root)
        eye = add_eye(device, spec.eye, spectral, parent=root)
    else:
        eye, spectral = add_scene(device, spec, folder, root)
    scene.camera = eye
    room = add_room(scene, spec.room, spec.render.luminance_per_unit_cd_m2)
    return DeviceScene(spec, scene, eye, panel, room, spectral)


def _add_engine(
    collection: bpy.types.Collection,
    spec: LightGuideSpec,
    primaries: tuple[Spectrum, Spectrum, Spectrum],
    folder: Path,
    spectral: SpectralScene,
    root: bpy.types.Object,
) -> bpy.types.Object:
    display = spec.display
    image = display_image(
        display.image,
        display.size_mm,
        folder,
        "display.image",
        field_degrees(spec),
        spec.name.replace("_", " "),
    )
    x, y = spec.patch(spec.source.patch).center_mm
    mount = empty(collection, "Light Engine", root)
    mount.location = (x, y, spec.guide.face_z_mm("eye") + spec.lens.distance_mm)
    white = display.luminance_cd_m2 / spec.render.luminance_per_unit_cd_m2
    return add_light_engine(
        collection, display, spec.lens, image, primaries, white, spectral, mount
    )
