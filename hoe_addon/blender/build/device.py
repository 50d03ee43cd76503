# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole device in a scene: a light guide with its light engine and eye, or any scene.

The device's frame (x right, y up, z toward the viewer) stands upright in the scene: the eye looks
along +y of the world, z of the world is up, and one scene unit is one millimetre.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import bpy
from msgspec.structs import replace

from ...model.device import DeviceSpec, LightGuideSpec
from ...model.effects import Effect, EffectPlan, plan_effects, planned
from ...model.field import field_degrees
from ...model.scene import SceneSpec
from ...model.wavelengths import display_weights
from ..pictures.diffracted import FLOOR, count_after_diffraction, is_worth_it
from ..shaders.spectral import SpectralScene, rendered_spectrum
from .eye import add_eye
from .guide import add_guide
from .light_engine import add_light_engine
from .scene import add_scene
from .stage import add_room, device_root, display_image, empty, new_collection, prepare_scene

GUIDE, ENGINE = "guide", "engine"
"""Names of the elements of a light guide."""


@dataclass(frozen=True, eq=False)
class DeviceScene:
    """A scene that holds a device, and what one changes in it.

    Attributes:
        spec: The document, as it was asked for.
        plan: Which of its effects were built.
        scene: The scene.
        root: Object whose frame is that of the document.
        elements: Objects by the name of their element; the plate (`GUIDE`) and the mount of
            display and lens (`ENGINE`) of a light guide.
        eye: The camera object, in the frame of the device.
        panel: The display of a light guide; None in a scene of another kind.
        room: Collection of the room.
        spectral: The sampled spectrum.
    """

    spec: DeviceSpec
    plan: EffectPlan
    scene: bpy.types.Scene
    root: bpy.types.Object
    elements: Mapping[str, bpy.types.Object]
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
        spectral = guide_spectrum(made)
        plate = add_guide(device, made.guide, made.holograms, spectral, parent=root)
        mount = empty(device, "Light Engine", root)
        mount.location = engine_place(made)
        panel = add_engine(device, made, folder, spectral, mount)
        elements = {GUIDE: plate, ENGINE: mount}
        eye = add_eye(device, made.eye, spectral, parent=root)
    else:
        eye, elements, spectral = add_scene(device, made, folder, root)
    _camera(eye).dof.use_dof = plan.is_on(Effect.PUPIL)
    scene.camera = eye
    room = add_room(scene, made.room, made.render.luminance_per_unit_cd_m2)
    if late and isinstance(made, SceneSpec):
        count_after_diffraction(scene, made, spectral, elements)
    return DeviceScene(spec, plan, scene, root, elements, eye, panel, room, spectral)


def guide_spectrum(spec: LightGuideSpec, group: bpy.types.NodeTree | None = None) -> SpectralScene:
    """The sampled spectrum of a light guide.

    Args:
        spec: The device.
        group: The node group, where it is made already.

    Returns:
        The spectrum; its emission has the rows of the display's primaries.
    """
    weights = display_weights(spec.display)
    return rendered_spectrum(spec.render, spec.display.spectra(), weights, group)


def _camera(eye: bpy.types.Object) -> bpy.types.Camera:
    assert isinstance(eye.data, bpy.types.Camera)
    return eye.data


def add_engine(
    collection: bpy.types.Collection,
    spec: LightGuideSpec,
    folder: Path,
    spectral: SpectralScene,
    mount: bpy.types.Object,
) -> bpy.types.Object:
    """Add display, lens and housing of a light guide.

    Args:
        collection: Where they are linked.
        spec: The device.
        folder: Folder that image files are relative to.
        spectral: The sampled spectrum of the scene.
        mount: Object that they hang on; it stands at ``engine_place``.

    Returns:
        The display.

    Raises:
        SpecError: The picture cannot be read.
    """
    display = spec.display
    image = display_image(
        display.image,
        display.size_mm,
        folder,
        "display.image",
        field_degrees(spec),
        spec.name.replace("_", " "),
    )
    white = display.luminance_cd_m2 / spec.render.luminance_per_unit_cd_m2
    return add_light_engine(
        collection, display, spec.lens, image, display.spectra(), white, spectral, mount
    )


def engine_place(spec: LightGuideSpec) -> tuple[float, float, float]:
    """Where the lens of a light guide stands, in the frame of the device, in mm."""
    x, y = spec.patch(spec.source.patch).center_mm
    return x, y, spec.guide.face_z_mm("eye") + spec.lens.distance_mm
