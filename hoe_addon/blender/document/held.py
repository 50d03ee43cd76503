# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document that a scene holds, read back whenever it is needed.

What the whole has in common stands in ``Scene.hologram``, what an element is in
``Object.hologram``, a hologram in ``Material.hologram``. Places are those of the objects, in the
frame of the device's root.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import bpy
from msgspec.structs import replace

from ...core.errors import SpecError
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.document import SCHEMA, device_from, to_document
from ...model.effects import EffectPlan
from ...model.field_error import FieldError
from ...model.scene import SceneSpec
from ...model.scene_lens import Face
from ...model.scene_view import gaze_of
from ..build.device import ENGINE, GUIDE, DeviceScene, guide_spectrum
from ..build.scene import scene_spectrum
from ..ids import DeviceKind, Role
from ..props.sync import read_spec
from ..props.values import shortest
from ..shaders.spectral import SpectralScene
from . import foreign

ELEMENT_ROLES = frozenset(
    (Role.HOLOGRAM, Role.LENS, Role.DISPLAY, Role.LAMP, Role.CARD, Role.BLOCK, Role.HOLDER)
)
"""Roles of objects that are elements of a scene's document."""

_OF_HOLOGRAM = ("recording", "characteristic", "efficiency", "orders")
"""What a hologram on a guide or a lens has of its own; surface and media are those of its place."""

_DECIMALS = 6
"""Of angles in degrees and exposures: what is left is the rounding of float32."""

_SCALE = 1e-4
"""How far the scale of an element may be from 1."""


def has_device(scene: bpy.types.Scene) -> bool:
    """Tell whether a scene holds a document."""
    # A file of a stranger may hold a number that no kind has; it reads as no word at all.
    return scene.hologram.kind not in ("", DeviceKind.NONE)


def whole(spec: DeviceSpec) -> DeviceSpec:
    """The document with all its effects on, as it is built in a window.

    Args:
        spec: The document.

    Returns:
        One that no plan takes anything from.
    """
    return replace(spec, render=replace(spec.render, effects=("all",)))


def document_of(scene: bpy.types.Scene) -> DeviceSpec:
    """Read the document that a scene holds, as its objects and properties are now.

    Args:
        scene: The scene.

    Returns:
        The valid document; a scene without an eye has it at the origin. All its effects are on
        where the scene holds things that it does not know, for nobody knows which effects their
        light needs.

    Raises:
        SpecError: The scene holds no document, or one that is not valid; with the path.
    """
    held = scene.hologram
    if not has_device(scene):
        raise SpecError(f"scene {scene.name}: holds no device; add one with Add > Hologram")
    # A script may have moved things since Blender last looked.
    for layer in scene.view_layers:
        layer.update()
    document: dict[str, Any] = {
        "kind": held.kind,
        "schema": SCHEMA,
        "name": held.short_name or scene.name,
        "title": held.title or scene.name,
        "description": held.description,
        "eye": held.eye.to_document() | {"position_mm": _eye_place(scene)},
        "room": held.room.to_document(),
        "render": _render_document(scene),
    }
    if held.kind == DeviceKind.LIGHT_GUIDE:
        return device_from(document | _guide_document(scene))
    elements = [_element_document(scene, item) for item in element_objects(scene)]
    return device_from(document | {"elements": elements, "gaze_deg": _gaze(scene)})


def device_of(scene: bpy.types.Scene) -> DeviceScene:
    """What render functions take, of a scene that holds a document.

    Args:
        scene: The scene.

    Returns:
        The device, with all its effects on.

    Raises:
        SpecError: As ``document_of``, or a part of the scene is gone.
    """
    spec, held = document_of(scene), scene.hologram
    panel, room = held.engine.panel, held.room.collection
    if isinstance(spec, LightGuideSpec):
        parts = {GUIDE: held.guide.plate, ENGINE: held.engine.mount, "display": panel}
        for name, item in parts.items():
            if item is None:
                raise FieldError(name, "must have its object; undo, or add the device anew", None)
        elements: Mapping[str, bpy.types.Object] = {GUIDE: parts[GUIDE], ENGINE: parts[ENGINE]}
    else:
        elements, panel = {item.name: item for item in element_objects(scene)}, None
    if room is None:
        raise FieldError("room", "must have its collection; undo, or add the device anew", None)
    plan = EffectPlan((), 0.0)
    spectral = spectrum_of(spec, held.wavelength)
    return DeviceScene(
        spec, plan, scene, _root(scene), elements, _eye(scene), panel, room, spectral
    )


def spectrum_of(spec: DeviceSpec, group: bpy.types.NodeTree | None = None) -> SpectralScene:
    """The sampled spectrum of a document in a window, with all effects on.

    Args:
        spec: The document.
        group: The node group, where it is made already.

    Returns:
        The spectrum.
    """
    full = whole(spec)
    if isinstance(full, LightGuideSpec):
        return guide_spectrum(full, group)
    assert isinstance(full, SceneSpec)
    return scene_spectrum(full, group)


def element_objects(scene: bpy.types.Scene) -> Iterator[bpy.types.Object]:
    """Objects that are elements of a scene's document, in order of name."""
    for item in sorted(scene.objects, key=lambda each: each.name):
        if item.hologram.role in ELEMENT_ROLES:
            yield item


def hologram_slot(item: bpy.types.Object) -> bpy.types.Material | None:
    """The first material of an object that is a hologram, or None."""
    for slot in item.material_slots:
        if slot.material is not None and slot.material.hologram.enabled:
            return slot.material
    return None


def face_of(child: bpy.types.Object) -> Face:
    """Which face of a lens a part of it is."""
    return "front" if child.location.z > 0.0 else "back"


def _guide_document(scene: bpy.types.Scene) -> dict[str, Any]:
    held = scene.hologram
    return {
        "guide": held.guide.to_document(),
        "holograms": [
            patch.to_document() | _own_hologram(patch.material, f"holograms[{place}]")
            for place, patch in enumerate(held.patches)
        ],
        "source": {"patch": held.engine.patch},
        "display": held.engine.display.to_document(),
        "lens": held.engine.lens_document(),
        "eyebox": held.eyebox.to_document(),
    }


def _element_document(scene: bpy.types.Scene, item: bpy.types.Object) -> dict[str, Any]:
    document = item.hologram.to_document() | _place(scene, item)
    if item.hologram.role == Role.HOLOGRAM:
        document["hologram"] = to_document(read_spec(_hologram(item, item.name)))
    elif item.hologram.role == Role.LENS:
        for child in item.children:
            material, face = hologram_slot(child), face_of(child)
            if material is not None:
                own = _own_hologram(material, f"{item.name}.{face}.hologram")
                document[face] = {**document[face], "hologram": own}
    return document


def _own_hologram(material: bpy.types.Material | None, path: str) -> dict[str, Any]:
    if material is None:
        raise FieldError(path, "must have a material that is a hologram", None)
    whole_document = to_document(read_spec(material))
    return {name: whole_document[name] for name in _OF_HOLOGRAM if name in whole_document}


def _hologram(item: bpy.types.Object, path: str) -> bpy.types.Material:
    material = hologram_slot(item)
    if material is None:
        raise FieldError(path, "must have a material that is a hologram", None)
    return material


def _render_document(scene: bpy.types.Scene) -> dict[str, Any]:
    render = scene.render
    share = render.resolution_percentage / 100.0
    document = scene.hologram.render.to_document() | {
        "size": [max(4, int(side * share)) for side in (render.resolution_x, render.resolution_y)],
        "samples": scene.cycles.samples,
        "seed": scene.cycles.seed,
        "exposure_ev": round(scene.view_settings.exposure, _DECIMALS),
    }
    if "all" not in document["effects"] and foreign.things(scene):
        document["effects"] = ["all", *document["effects"]]
    return document


def _place(scene: bpy.types.Scene, item: bpy.types.Object) -> dict[str, Any]:
    """Place of an element in the frame of the device."""
    matrix = _in_device(scene, item)
    scale = matrix.to_scale()
    if max(abs(side - 1.0) for side in scale) > _SCALE or matrix.determinant() < 0.0:
        rule = "must be 1; apply the scale (Object > Apply > Scale), or change the size in mm"
        raise FieldError(f"{item.name}.scale", rule, [round(side, 4) for side in scale])
    place, turns = matrix.translation, matrix.to_euler("XYZ")
    if _hangs_plainly(scene, item):
        # As they were typed, without the rounding of matrices.
        place, turns = item.location, item.rotation_euler
    return {
        "name": item.name,
        "position_mm": [shortest(value) for value in place],
        "rotation_deg": [shortest(math.degrees(angle)) for angle in turns],
    }


def _hangs_plainly(scene: bpy.types.Scene, item: bpy.types.Object) -> bool:
    """Tell whether the location and rotation of an object are those in the frame of the device."""
    return (
        item.parent == _root(scene)
        and item.rotation_mode == "XYZ"
        and not item.constraints
        and item.matrix_parent_inverse.is_identity
        and not any((*item.delta_location, *item.delta_rotation_euler))
    )


def _gaze(scene: bpy.types.Scene) -> list[float]:
    if scene.hologram.eye.camera is None:
        return [0.0, 0.0]
    eye = _eye(scene)
    ahead = _in_device(scene, eye).to_3x3() @ _ahead()
    if not 0.0 < ahead.length_squared < math.inf:
        scale = [round(side, 4) for side in eye.scale]
        raise FieldError("eye.scale", "must be 1; clear it (Object > Clear > Scale)", scale)
    gaze = gaze_of(ahead)
    return [round(angle, _DECIMALS) for angle in gaze]


def _eye_place(scene: bpy.types.Scene) -> list[float]:
    if scene.hologram.eye.camera is None:
        return [0.0, 0.0, 0.0]
    eye = _eye(scene)
    plain = _hangs_plainly(scene, eye)
    place = eye.location if plain else _in_device(scene, eye).translation
    return [shortest(value) for value in place]


def _in_device(scene: bpy.types.Scene, item: bpy.types.Object) -> Any:
    """Matrix of an object in the frame of the device."""
    return _root(scene).matrix_world.inverted_safe() @ item.matrix_world


def _ahead() -> Any:
    from mathutils import Vector

    return Vector((0.0, 0.0, -1.0))


def _root(scene: bpy.types.Scene) -> bpy.types.Object:
    root = scene.hologram.root
    if root is None:
        raise FieldError("root", "must be an object; undo, or add the device anew", None)
    return root


def _eye(scene: bpy.types.Scene) -> bpy.types.Object:
    eye = scene.hologram.eye.camera
    if eye is None or eye.type != "CAMERA":
        raise FieldError("eye", "must be a camera; add one with Add > Hologram > Eye", None)
    return eye
