# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene document in Blender: its elements, and the eye that looks at them."""

import math
from dataclasses import replace
from pathlib import Path

import bpy

from ..core.spectrum import Spectrum
from ..model.scene import SceneSpec
from ..model.scene_lens import LensElement
from ..model.scene_parts import (
    BlockElement,
    CardElement,
    DisplayElement,
    ElementSpec,
    HolderElement,
    HologramElement,
    LampElement,
)
from ..model.wavelengths import display_weights
from . import scene_lights, scene_things
from .diffracted import used_primaries
from .element import hologram_element
from .eye import add_eye
from .materials import hologram_material
from .scene_lens import add_lens
from .spectral import SpectralScene, rendered_spectrum


def add_scene(
    collection: bpy.types.Collection, spec: SceneSpec, folder: Path, root: bpy.types.Object
) -> tuple[bpy.types.Object, SpectralScene]:
    """Add all elements of a scene, and the eye.

    Args:
        collection: Where they are linked.
        spec: The scene; 1 scene unit is 1 mm.
        folder: Folder that image files are relative to.
        root: Object whose frame is that of the document.

    Returns:
        The eye's camera object, and the sampled spectrum.

    Raises:
        SpecError: A picture or the colours of a display cannot be had.
    """
    spectra = [_spectra(element) for element in spec.elements]
    emitters = [light for some in spectra for light in some]
    planned = spec.render.mode == "spectral" and "all" not in spec.render.effects
    weights = [weight for element in spec.elements for weight in _weights(element, planned)]
    spectral = rendered_spectrum(spec.render, emitters, weights)
    unit = spec.render.luminance_per_unit_cd_m2
    first = 0
    for place, (element, own) in enumerate(zip(spec.elements, spectra, strict=True)):
        part = _part(spectral, first, len(own))
        first += len(own)
        item = _add_element(collection, element, f"elements[{place}]", part, folder, unit)
        item.name = element.name
        item.parent = root
        item.location = element.position_mm
        item.rotation_euler = [math.radians(angle) for angle in element.rotation_deg]
    eye = add_eye(collection, spec.eye, spectral, parent=root)
    right, up = spec.gaze_deg
    eye.rotation_euler = (math.radians(up), math.radians(-right), 0.0)
    return eye, spectral


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


def _part(spectral: SpectralScene, first: int, count: int) -> SpectralScene:
    """The same sampling with the emission of one element alone."""
    emission = spectral.tables.emission[first : first + count]
    return replace(spectral, tables=replace(spectral.tables, emission=emission))


def _add_element(
    collection: bpy.types.Collection,
    element: ElementSpec,
    field: str,
    spectral: SpectralScene,
    folder: Path,
    luminance_per_unit: float,
) -> bpy.types.Object:
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
