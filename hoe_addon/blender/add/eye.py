# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The eye: a camera with a pupil, and the spectral filter that gives a scene its colours."""

import bpy
from mathutils import Matrix

from ...core.errors import HoeError
from ...model.device_parts import EyeSpec
from ...model.document import to_document
from ..build.eye import add_eye
from ..ids import DeviceKind, Mode, Role
from ..props import changes
from . import elements
from .leaving import guest_of


def give_eye(
    scene: bpy.types.Scene,
    spec: EyeSpec | None = None,
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Give a scene its eye; from then on its paths have wavelengths of their own.

    It becomes the camera of the scene where that has none.

    Args:
        scene: The scene; it begins to hold a document.
        spec: Pupil, focus and field; its place is not looked at.
        matrix: Where the pupil is; it looks along -z. By default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The camera object, and the names of the render settings that were changed.

    Raises:
        HoeError: The scene has an eye already.
    """
    spec = spec or EyeSpec(pupil_diameter_mm=4.0, field_deg=40.0)
    held = scene.hologram
    if held.kind != DeviceKind.NONE and elements.has_eye(scene):
        raise HoeError(
            f"scene {scene.name}: has an eye already, {held.eye.camera.name}; move it, or delete "
            "it first"
        )
    elements.refuse_light_guide(scene, "an eye")
    with guest_of(scene) as settings:
        elements.begin(scene)
        with changes.unmarked():
            held.render.mode = Mode.SPECTRAL
            held.eye.from_document(to_document(spec), "eye")
        scene.render.use_motion_blur = True
        seeing = elements.new_sampling(scene)
        eye = add_eye(collection or scene.collection, spec, seeing)
        held.eye.camera, eye.hologram.role = eye, Role.EYE
        for child in eye.children:
            child.hologram.role = Role.FILTER
        elements.put(scene, eye, matrix, collection)
        if scene.camera is None:
            scene.camera = eye
        elements.settle(scene)
    return eye, tuple(settings)
