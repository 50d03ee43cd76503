# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A display or a lamp."""

from pathlib import Path

import bpy
from mathutils import Matrix

from ...core.spectrum import DISPLAY_PRIMARIES
from ...model.device_parts import DisplaySpec
from ...model.scene_parts import DisplayElement, LampElement
from ...model.scene_spectra import IlluminantSpec, SpectrumSpec
from ...model.wavelengths import display_weights
from ..build import lights as scene_lights
from . import elements
from .leaving import guest_of

_HERE = (0.0, 0.0, 0.0)
"""Of a document; the object's own place counts."""

_WHY = "a display"


def plain_display(
    image: str = "chart",
    size_mm: tuple[float, float] = (64.0, 36.0),
    luminance_cd_m2: float = 500.0,
) -> DisplaySpec:
    """A display to begin with, its primaries the first set that is known.

    Args:
        image: A built-in picture, or a file.
        size_mm: Width and height.
        luminance_cd_m2: Luminance of its white.

    Returns:
        The display.
    """
    primaries = next(iter(DISPLAY_PRIMARIES))
    return DisplaySpec(
        image=image, size_mm=size_mm, luminance_cd_m2=luminance_cd_m2, primaries=primaries
    )


def add_display(
    scene: bpy.types.Scene,
    spec: DisplaySpec | None = None,
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
    folder: Path | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a picture that gives light.

    Args:
        scene: The scene; it begins to hold a document.
        spec: The display; by default a test chart of 64 x 36 mm and 500 cd/m^2.
        matrix: Where it stands, its front to +z; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.
        folder: Folder that a picture is relative to.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        SpecError: The picture cannot be read.
        HoeError: The scene holds a light guide.
    """
    spec = spec or plain_display()
    elements.refuse_light_guide(scene, _WHY)
    element = DisplayElement(name="Display", position_mm=_HERE, display=spec)
    with guest_of(scene) as settings:
        elements.begin(scene)
        item = scene_lights.add_display(
            collection or scene.collection,
            element,
            "image",
            elements.spectrum(scene, spec.spectra(), display_weights(spec)),
            folder or Path(),
            elements.luminance_per_unit(scene),
        )
        elements.put(scene, item, matrix, collection)
        elements.join(scene, item, element)
    return item, tuple(settings)


def add_lamp(
    scene: bpy.types.Scene,
    shape: str = "disc",
    size_mm: tuple[float, float] = (10.0, 10.0),
    luminance_cd_m2: float = 1000.0,
    light: SpectrumSpec | None = None,
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a lamp whose light has a spectrum.

    Args:
        scene: The scene; it begins to hold a document.
        shape: ``disc``, ``rectangle``, ``sphere`` or ``line``.
        size_mm: Width and height; of a sphere and a line, thickness and height.
        luminance_cd_m2: Luminance.
        light: Its spectrum; by default daylight.
        matrix: Where it stands, its front to +z; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        SpecError: A number breaks a rule.
        HoeError: The scene holds a light guide.
    """
    elements.refuse_light_guide(scene, _WHY)
    element = LampElement(
        name="Lamp",
        position_mm=_HERE,
        shape=shape,
        size_mm=size_mm,
        luminance_cd_m2=luminance_cd_m2,
        spectrum=light or IlluminantSpec(),
    )
    with guest_of(scene) as settings:
        elements.begin(scene)
        item = scene_lights.add_lamp(
            collection or scene.collection,
            element,
            elements.spectrum(scene, (element.spectrum.spectrum(),), (1.0,)),
            elements.luminance_per_unit(scene),
        )
        elements.put(scene, item, matrix, collection)
        elements.join(scene, item, element)
    return item, tuple(settings)
