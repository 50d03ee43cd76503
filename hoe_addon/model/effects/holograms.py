# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms of a document, wherever they stand, and the document with another one in a place."""

from collections.abc import Iterator, Mapping
from typing import Any

from msgspec.structs import replace

from ..device import DeviceSpec, LightGuideSpec, PatchSpec
from ..hologram import HologramSpec
from ..scene import SceneSpec
from ..scene_lens import FACES, LensElement, LensFaceSpec
from ..scene_parts import ElementSpec, HologramElement


def holograms_of(spec: DeviceSpec) -> dict[str, HologramSpec]:
    """List the holograms of a document.

    Args:
        spec: The document.

    Returns:
        Each hologram in its own frame, by its name in the document; that on a face of a lens is
        named ``LENS front`` or ``LENS back``.
    """
    if isinstance(spec, LightGuideSpec):
        return {patch.name: patch.hologram(spec.guide) for patch in spec.holograms}
    return dict(_in_scene(spec))


def _in_scene(spec: SceneSpec) -> Iterator[tuple[str, HologramSpec]]:
    for element in spec.elements:
        if isinstance(element, HologramElement):
            yield element.name, element.hologram
        elif isinstance(element, LensElement):
            for face in FACES:
                hologram = element.hologram(face)
                if hologram is not None:
                    yield hologram.name, hologram


def with_holograms(spec: DeviceSpec, changed: Mapping[str, HologramSpec]) -> DeviceSpec:
    """Put other holograms in the place of some.

    Args:
        spec: The document.
        changed: Holograms by their name in the document, on the same surface, in the same media.

    Returns:
        The document with them.
    """
    if not changed:
        return spec
    if isinstance(spec, LightGuideSpec):
        patches = tuple(_patch(patch, changed) for patch in spec.holograms)
        return replace(spec, holograms=patches)
    return replace(spec, elements=tuple(_element(each, changed) for each in spec.elements))


def _patch(patch: PatchSpec, changed: Mapping[str, HologramSpec]) -> PatchSpec:
    new = changed.get(patch.name)
    return patch if new is None else replace(patch, **_recorded(new))


def _element(element: ElementSpec, changed: Mapping[str, HologramSpec]) -> ElementSpec:
    if isinstance(element, HologramElement) and element.name in changed:
        return replace(element, hologram=changed[element.name])
    if isinstance(element, LensElement):
        faces: dict[str, LensFaceSpec] = {}
        for face in FACES:
            new = changed.get(f"{element.name} {face}")
            own = element.face(face)
            if new is not None and own.hologram is not None:
                faces[face] = replace(own, hologram=replace(own.hologram, **_recorded(new)))
        return replace(element, **faces) if faces else element
    return element


def _recorded(new: HologramSpec) -> dict[str, Any]:
    return {
        "recording": new.recording,
        "characteristic": new.characteristic,
        "efficiency": new.efficiency,
        "orders": new.orders,
    }
