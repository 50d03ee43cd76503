# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms added to the plate of a light guide that is in a scene, and taken from it."""

import bpy

from ...core.errors import SpecError
from ...model.default_patch import default_patch
from ...model.device import LightGuideSpec
from ...model.document import to_document
from ...model.field_error import FieldError
from ..build.guide import patch_frame
from ..ids import Choice
from ..props import changes
from ..shaders.materials import hologram_material
from . import chosen_effects
from .held import document_of, spectrum_of
from .refusing import settle_or_restore


class Purpose(Choice):
    """What a new hologram on a light guide is for."""

    OUT = "out", 0, "Out-Coupler", "Gives a part of the light in the plate to the eye"
    IN = "in", 1, "In-Coupler", "Takes light of the display into the plate"


def add_patch(scene: bpy.types.Scene, purpose: str = Purpose.OUT) -> bpy.types.PropertyGroup:
    """Add a hologram on a free place of the plate.

    Args:
        scene: A scene with a light guide.
        purpose: A `Purpose`.

    Returns:
        Its entry in ``Scene.hologram.patches``, the active one.

    Raises:
        SpecError: The scene's document is not valid, or there is no free place.
        HoeError: Its shader cannot be made. The scene stays as it was in all cases.
    """
    spec, held = _light_guide(scene), scene.hologram
    patch = default_patch(spec, Purpose(purpose).value)
    material = hologram_material(
        patch.hologram(spec.guide),
        spectrum_of(spec, held.wavelength),
        patch_frame(spec.guide, patch),
    )
    with changes.unmarked():
        entry = held.patches.add()
        entry.from_document(to_document(patch), f"holograms[{len(spec.holograms)}]")
        entry.material = material

    def restore() -> None:
        held.patches.remove(len(held.patches) - 1)
        bpy.data.materials.remove(material)

    settle_or_restore(scene, restore)
    held.active_patch = len(held.patches) - 1
    return held.patches[held.active_patch]


def remove_patch(scene: bpy.types.Scene, place: int) -> str:
    """Take a hologram off the plate.

    Args:
        scene: A scene with a light guide.
        place: Its place in ``Scene.hologram.patches``.

    Returns:
        Its name.

    Raises:
        SpecError: It has to stay, or the scene's document is not valid without it; it stays then.
    """
    held = scene.hologram
    if not 0 <= place < len(held.patches):
        raise FieldError("active_patch", f"must be below {len(held.patches)}", place)
    name = held.patches[place].name
    if name == held.engine.patch:
        raise SpecError(f"{name}: display and lens stand over it; choose another In-Coupler first")
    removed = held.patches[place]
    document, material = removed.to_document(), removed.material
    with changes.unmarked():
        held.patches.remove(place)

    def restore() -> None:
        entry = held.patches.add()
        entry.from_document(document, f"holograms[{place}]")
        entry.material = material
        held.patches.move(len(held.patches) - 1, place)

    settle_or_restore(scene, restore)
    chosen_effects.forget(scene, name)
    held.active_patch = min(held.active_patch, len(held.patches) - 1)
    return name


def _light_guide(scene: bpy.types.Scene) -> LightGuideSpec:
    spec = document_of(scene)
    if not isinstance(spec, LightGuideSpec):
        raise SpecError(f"scene {scene.name}: has no light guide; add one with Add > Hologram")
    return spec
