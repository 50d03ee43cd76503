# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Take what an effect plan leaves out from a scene that was built as a whole.

It changes materials and settings for good, so it is for a copy of a scene that is rendered once.
"""

from collections.abc import Iterator
from dataclasses import replace as with_fields

import bpy
from msgspec.structs import replace

from ...core.errors import SpecError
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.effects import Effect, EffectPlan, planned
from ...model.effects.holograms import holograms_of
from ...model.scene import SceneSpec
from ..build.device import DeviceScene, guide_spectrum
from ..build.scene import scene_spectrum
from ..ids import Role
from ..pictures.diffracted import FLOOR, count_after_diffraction, is_worth_it
from ..props.sync import read_followed, read_frame, refresh, write_spec
from ..props.values import number
from . import remake, resample
from .elements import face_of, hologram_slot


def follow_plan(device: DeviceScene, plan: EffectPlan) -> DeviceScene:
    """Leave out of a scene what a plan leaves out of its document, and look through its eye.

    Args:
        device: A scene that holds its document, with all effects on.
        plan: The plan of that document.

    Returns:
        The same scene with the plan followed.

    Raises:
        HoeError: A shader of the simpler document cannot be made.
    """
    made = planned(device.spec, plan)
    late = is_worth_it(made)
    if late:
        floor = min(made.render.spectrum_floor, FLOOR)
        made = replace(made, render=replace(made.render, spectrum_floor=floor))
    scene = device.scene
    scene.camera = device.eye  # the user's may be another one
    _simplify_holograms(device, made)
    remake.settings(scene, made)
    if isinstance(made, LightGuideSpec):
        spectral = guide_spectrum(made)
    else:
        assert isinstance(made, SceneSpec)
        spectral = scene_spectrum(made)
    resample.resample(scene, made, spectral)
    if not spectral.drawn:
        remake.eye(scene, made)  # takes the filter away
    device.camera.dof.use_dof = plan.is_on(Effect.PUPIL)
    if late and isinstance(made, SceneSpec):
        count_after_diffraction(scene, made, spectral, device.elements)
    return with_fields(device, plan=plan, spectral=spectral)


def _simplify_holograms(device: DeviceScene, made: DeviceSpec) -> None:
    before, materials = holograms_of(device.spec), dict(_materials(device))
    for name, simple in holograms_of(made).items():
        if simple == before[name]:
            continue
        if name not in materials:
            raise SpecError(f"hologram {name}: has no material in the scene")
        material = materials[name]
        frame, units = read_frame(material), number(material.hologram, "units_per_mm")
        write_spec(material, simple, frame, units, read_followed(material))
        refresh(material)


def _materials(device: DeviceScene) -> Iterator[tuple[str, bpy.types.Material]]:
    """Materials of all holograms by their name in the document."""
    if isinstance(device.spec, LightGuideSpec):
        for patch in device.scene.hologram.patches:
            yield patch.name, patch.material
        return
    for name, item in device.elements.items():
        own = hologram_slot(item) if item.hologram.role == Role.HOLOGRAM else None
        if own is not None:
            yield name, own
        for child in item.children if item.hologram.role == Role.LENS else ():
            face = hologram_slot(child)
            if face is not None:
                yield f"{name} {face_of(child)}", face
