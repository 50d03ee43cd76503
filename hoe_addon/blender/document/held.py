# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document that a scene holds, read back whenever it is needed.

What the whole has in common stands in ``Scene.hologram``, what an element is in
``Object.hologram``, a hologram in ``Material.hologram``. Places are those of the objects, in the
frame of the device's root.
"""

from collections.abc import Mapping
from typing import Any

import bpy
from msgspec.structs import replace

from ...core.errors import SpecError
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.document import SCHEMA, device_from, to_document
from ...model.effects import EffectPlan
from ...model.field_error import FieldError
from ...model.reading import naming
from ...model.scene import SceneSpec
from ..build.device import ENGINE, GUIDE, DeviceScene, guide_spectrum
from ..build.scene import scene_spectrum
from ..ids import DeviceKind, Role
from ..pictures.render_settings import picture_size
from ..props.sync import read_spec
from ..shaders.spectral import SpectralScene
from . import chosen_effects, foreign, places
from .elements import element_objects, elements_by_name, face_of, hologram_slot

_OF_HOLOGRAM = ("recording", "characteristic", "efficiency", "orders")
"""What a hologram on a guide or a lens has of its own; surface and media are those of its place."""

_DECIMALS = 6
"""Of an exposure: what is left is the rounding of float32."""


def has_device(scene: bpy.types.Scene) -> bool:
    """Tell whether a scene holds a document, and its root or its eye.

    Where both are deleted the rest of the document stays, for undo gives them back.
    """
    held = scene.hologram
    # A file of a stranger may hold a number that no kind has; it reads as no word at all.
    if held.kind in ("", DeviceKind.NONE):
        return False
    return any(item and places.is_in(scene, item) for item in (held.root, held.eye.camera))


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
    places.check_scales(scene)
    document: dict[str, Any] = {
        "kind": held.kind,
        "schema": SCHEMA,
        "name": held.short_name or scene.name,
        "title": held.title or scene.name,
        "description": held.description,
        "eye": held.eye.to_document() | {"position_mm": places.eye_place(scene)},
        "room": held.room.to_document(),
        "render": _render_document(scene),
    }
    if held.kind == DeviceKind.LIGHT_GUIDE:
        return chosen_effects.of_present(device_from(document | _guide_document(scene)))
    elements = [_element_document(scene, item) for item in element_objects(scene)]
    spec = device_from(document | {"elements": elements, "gaze_deg": places.gaze(scene)})
    return chosen_effects.of_present(spec)


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
        places.check_fixed(scene, spec)
        for name, item in parts.items():
            if item is None:
                raise FieldError(name, "must have its object; undo, or add the device anew", None)
        elements: Mapping[str, bpy.types.Object] = {GUIDE: parts[GUIDE], ENGINE: parts[ENGINE]}
    else:
        elements, panel = elements_by_name(scene), None
    if room is None:
        raise FieldError("room", "must have its collection; undo, or add the device anew", None)
    plan = EffectPlan((), 0.0)
    spectral = spectrum_of(spec, held.wavelength)
    return DeviceScene(
        spec,
        plan,
        scene,
        places.root_of(scene),
        elements,
        places.eye_of(scene),
        panel,
        room,
        spectral,
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


def _guide_document(scene: bpy.types.Scene) -> dict[str, Any]:
    held = scene.hologram
    return {
        "guide": held.guide.to_document(),
        "holograms": [
            patch.to_document()
            | _own_hologram(patch.material, f"holograms[{place}] ({patch.name})", held.guide.plate)
            for place, patch in enumerate(held.patches)
        ],
        "source": {"patch": held.engine.patch},
        "display": held.engine.display.to_document(),
        "lens": held.engine.lens_document(),
        "eyebox": held.eyebox.to_document(),
    }


def _element_document(scene: bpy.types.Scene, item: bpy.types.Object) -> dict[str, Any]:
    if not isinstance(item.data, bpy.types.Mesh):
        rule = f"must be a mesh to be a {Role(item.hologram.role).label.lower()}; delete it"
        raise FieldError(item.name, rule, item.type)
    document = item.hologram.to_document() | places.place(scene, item)
    if item.hologram.role == Role.HOLOGRAM:
        document["hologram"] = _hologram(hologram_slot(item), f"{item.name}.hologram", item)
    elif item.hologram.role == Role.LENS:
        for child in item.children:
            material, face = hologram_slot(child), face_of(child)
            if material is not None:
                own = _own_hologram(material, f"{item.name}.{face}.hologram", child)
                document[face] = {**document[face], "hologram": own}
    return document


def _own_hologram(
    material: bpy.types.Material | None, path: str, carrier: bpy.types.Object | None
) -> dict[str, Any]:
    document = _hologram(material, path, carrier)
    return {name: document[name] for name in _OF_HOLOGRAM if name in document}


def _hologram(
    material: bpy.types.Material | None, path: str, carrier: bpy.types.Object | None
) -> dict[str, Any]:
    if material is None:
        raise FieldError(path, "must have a material that is a hologram", None)
    # A hologram does not know what it is part of.
    with naming(path):
        return to_document(read_spec(material, carrier))


def _render_document(scene: bpy.types.Scene) -> dict[str, Any]:
    document = scene.hologram.render.to_document() | {
        "size": list(picture_size(scene)),
        "samples": scene.cycles.samples,
        "seed": scene.cycles.seed,
        "exposure_ev": round(scene.view_settings.exposure, _DECIMALS),
    }
    if "all" not in document["effects"] and foreign.things(scene):
        document["effects"] = ["all", *document["effects"]]
    return document
