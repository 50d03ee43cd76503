# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole device in a scene: a light guide with its light engine and eye, or any scene.

The device's frame (x right, y up, z toward the viewer) stands upright in the scene: the eye looks
along +y of the world, z of the world is up, and one scene unit is one millimetre.
"""

from dataclasses import dataclass
from pathlib import Path

import bpy
from msgspec.structs import replace

from ..core.spectrum import Spectrum
from ..model.device import DeviceSpec, LightGuideSpec
from ..model.effects import Effect, EffectPlan, plan_effects, planned
from ..model.field import field_degrees
from ..model.scene import SceneSpec
from ..model.wavelengths import display_weights
from .diffracted import FLOOR, count_after_diffraction, is_worth_it
from .eye import add_eye
from .guide import add_guide
from .light_engine import add_light_engine
from .scene import add_scene
from .spectral import SpectralScene, rendered_spectrum
from .stage import add_room, device_root, display_image, empty, new_collection, prepare_scene


@dataclass(frozen=True, eq=False)
class DeviceScene:
    """A scene that holds a device, and what one changes in it.

    Attributes:
        spec: The document, as it was asked for.
        plan: Which of its effects were built.
        scene: The scene.
        eye: The camera object, in the frame of the device.
        panel: The display of a light guide; None in a scene of another kind.
        room: Collection of the room.
        spectral: The sampled spectrum.
    """

    spec: DeviceSpec
    plan: EffectPlan
    scene: bpy.types.Scene
    eye: bpy.types.Object
    panel: bpy.types.Object | None
    room: bpy.types.Collection
    spectral: SpectralScene

    @property
    def camera(self) -> bpy.types.Camera:
        """The eye's lens and pupil."""
        return _camera(self.eye)

    @property
    def guide_spec(self) -> LightGuideSpec:
        """The document of a light guide; asked for only where the device is one."""
        assert isinstance(self.spec, LightGuideSpec)
        return self.spec


def build_device(
    scene: bpy.types.Scene, spec: DeviceSpec, folder: Path, plan: EffectPlan | None = None
) -> DeviceScene:
    """Build a device in a scene, with the effects that it calls for.

    Args:
        scene: An empty scene.
        spec: The device.
        folder: Folder that image files are relative to.
        plan: Which effects are built; by default what ``plan_effects`` finds.

    Returns:
        The scene and its parts.

    Raises:
        MissingOslError: This Blender, or the scene's device, cannot run OSL.
        SpecError: A picture or the colours of a display cannot be had.
    """
    plan = plan or plan_effects(spec)
    made = planned(spec, plan)
    late = is_worth_it(made)
    if late:
        floor = min(made.render.spectrum_floor, FLOOR)
        made = replace(made, render=replace(made.render, spectrum_floor=floor))
    prepare_scene(scene, made.render)
    device = new_collection(scene, "Device")
    root = device_root(device)
    panel = None
    if isinstance(made, LightGuideSpec):
        primaries = made.display.spectra()
        spectral = rendered_spectrum(made.render, primaries, display_weights(made.display))
        add_guide(device, made.guide, made.holograms, spectral, parent=root)
        panel = _add_engine(device, made, primaries, folder, spectral, root)
        eye = add_eye(device, made.eye, spectral, parent=root)
    else:
        eye, spectral = add_scene(device, made, folder, root)
    _camera(eye).dof.use_dof = plan.is_on(Effect.PUPIL)
    scene.camera = eye
    room = add_room(scene, made.room, made.render.luminance_per_unit_cd_m2)
    if late and isinstance(made, SceneSpec):
        count_after_diffraction(scene, made, spectral)
    return DeviceScene(spec, plan, scene, eye, panel, room, spectral)


def _camera(eye: bpy.types.Object) -> bpy.types.Camera:
    assert isinstance(eye.data, bpy.types.Camera)
    return eye.data


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
