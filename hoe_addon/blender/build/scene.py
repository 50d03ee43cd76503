# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene document in Blender: its elements, and the eye that looks at them."""

import math
from dataclasses import replace
from pathlib import Path

import bpy

from ...core.spectrum import Spectrum
from ...model.scene import SceneSpec
from ...model.scene_lens import LensElement
from ...model.scene_parts import (
    BlockElement,
    CardElement,
    DisplayElement,
    ElementSpec,
    HolderElement,
    HologramElement,
    LampElement,
)
from ...model.wavelengths import display_weights
from ..pictures.diffracted import used_primaries
from ..shaders.materials import hologram_material
from ..shaders.spectral import SpectralScene, rendered_spectrum
from . import lights as scene_lights
from . import things as scene_things
from .element import hologram_element
from .eye import add_eye
from .lens import add_lens


def add_scene(
    collection: bpy.types.Collection, spec: SceneSpec, folder: Path, root: bpy.types.Object
) -> tuple[bpy.types.Object, dict[str, bpy.types.Object], SpectralScene]:
    """Add all elements of a scene, and the eye.

    Args:
        collection: Where they are linked.
        spec: The scene; 1 scene unit is 1 mm.
        folder: Folder that image files are relative to.
        root: Object whose frame is that of the document.

    Returns:
        The eye's camera object, the elements by their name, and the sampled spectrum.

    Raises:
        SpecError: A picture or the colours of a display cannot be had.
    """
    spectral = scene_spectrum(spec)
    unit = spec.render.luminance_per_unit_cd_m2
    parts = element_spectra(spec, spectral)
    made: dict[str, bpy.types.Object] = {}
    for place, element in enumerate(spec.elements):
        part, field = parts[element.name], f"elements[{place}]"
        item = add_element(collection, element, field, part, folder, unit)
        item.name = element.name
        made[element.name] = item
        item.parent = root
        item.location = element.position_mm
        item.rotation_euler = [math.radians(angle) for angle in element.rotation_deg]
    eye = add_eye(collection, spec.eye, spectral, parent=root)
    right, up = spec.gaze_deg
    eye.rotation_euler = (math.radians(up), math.radians(-right), 0.0)
    return eye, made, spectral


def scene_spectrum(spec: SceneSpec, group: bpy.types.NodeTree | None = None) -> SpectralScene:
    """The sampled spectrum of a scene.

    Args:
        spec: The scene.
        group: The node group, where it is made already.

    Returns:
        The spectrum; its emission has the rows of all displays and lamps in turn.
    """
    emitters = [light for element in spec.elements for light in _spectra(element)]
    planned = spec.render.mode == "spectral" and "all" not in spec.render.effects
    weights = [weight for element in spec.elements for weight in _weights(element, planned)]
    return rendered_spectrum(spec.render, emitters, weights, group)


def element_spectra(spec: SceneSpec, spectral: SpectralScene) -> dict[str, SpectralScene]:
    """The sampled spectrum with the emission of one element alone, by the element's name."""
    found: dict[str, SpectralScene] = {}
    first = 0
    for element in spec.elements:
        count = len(_spectra(element))
        found[element.name] = part_of(spectral, first, count)
        first += count
    return found


def _spectra(element: ElementSpec) -> tuple[Spectrum, ...]:
    """Spectra of an element's light."""
    if isinstance(element, DisplayElement):
        return element.display.spectra()
    if isinstance(element, LampElement):
        return (element.spectrum.spectrum(),)
    return ()


def _weights(element: ElementSpec, planned: bool) -> tuple[float, ...]:
    """How often the spectra of an element's light are drawn; one element counts like another.

    A plan leaves out the primaries that the picture has nothing of.
    """
    if isinstance(element, DisplayElement):
        used = used_primaries(element) if planned else (1.0, 1.0, 1.0)
        shares = zip(display_weights(element.display), used, strict=True)
        return tuple(weight * factor for weight, factor in shares)
    return (1.0,) if isinstance(element, LampElement) else ()


def part_of(spectral: SpectralScene, first: int, count: int) -> SpectralScene:
    """The same sampling with the emission of one element alone."""
    emission = spectral.tables.emission[first : first + count]
    return replace(spectral, tables=replace(spectral.tables, emission=emission))


def add_element(
    collection: bpy.types.Collection,
    element: ElementSpec,
    field: str,
    spectral: SpectralScene,
    folder: Path,
    luminance_per_unit: float,
) -> bpy.types.Object:
    """Add one element.

    Args:
        collection: Where it is linked.
        element: The element; name and place are set by the caller.
        field: Its path in the document, for messages.
        spectral: Sampled spectrum with the emission of this element alone.
        folder: Folder that image files are relative to.
        luminance_per_unit: Luminance that the scene-linear value 1 stands for, cd/m^2.

    Returns:
        The object; parts of it are its children.

    Raises:
        SpecError: A picture or the colours of a display cannot be had.
    """
    match element:
        case HologramElement():
            return _add_hologram(collection, element, spectral)
        case LensElement():
            return add_lens(collection, element, spectral)
        case DisplayElement():
            return scene_lights.add_display(
                collection, element, f"{field}.display.image", spectral, folder, luminance_per_unit
            )
        case LampElement():
            return scene_lights.add_lamp(collection, element, spectral, luminance_per_unit)
        case CardElement():
            return scene_things.add_card(collection, element, f"{field}.image", folder)
        case BlockElement():
            return scene_things.add_block(collection, element)
        case HolderElement():
            return scene_things.add_holder(collection, element)


def _add_hologram(
    collection: bpy.types.Collection, element: HologramElement, spectral: SpectralScene
) -> bpy.types.Object:
    return hologram_element(
        collection, element.hologram, hologram_material(element.hologram, spectral)
    )
