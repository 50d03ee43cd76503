# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From which properties a shader was made, and whether a material's shader can be written at all.

Properties and shader lie in the same datablock, and so does the note of what the shader was made
from: an undo, a copy or a file bring all three, and the note tells whether they agree.
"""

import hashlib
import json

import bpy

from ...core.errors import HoeError, SpecError
from ...resources import version
from ..document.versions import is_newer, newer_words
from .followed import read_followed_roles
from .shader_node import hologram_node
from .values import numbers, shortest

_UNREADABLE = "unreadable"


def fingerprint(material: bpy.types.Material) -> str:
    """What the shader of a hologram is made from, as a short text.

    Args:
        material: The material, or its evaluated self.

    Returns:
        A hash of its properties and the version of the add-on.
    """
    properties = material.hologram
    try:
        document = properties.to_document()
    except SpecError:
        return _UNREADABLE
    del document["name"]  # that of the datablock, which the shader does not depend on
    frame = [numbers(properties.frame, field) for field in ("origin", "x", "y")]
    sources = []
    for role in read_followed_roles(material):
        target = getattr(properties.recording, role).target
        sources.append((role, target and target.name))
    text = json.dumps([version(), document, frame, shortest(properties.units_per_mm), sources])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def note_made(material: bpy.types.Material, source: bpy.types.Material) -> None:
    """Note that the shader of a material agrees with properties.

    Args:
        material: The material.
        source: What has the properties: itself, or its evaluated self.
    """
    now = fingerprint(source)
    if material.hologram.made_of != now:
        material.hologram.made_of = now


def is_stale(material: bpy.types.Material) -> bool:
    """Tell whether the shader of a hologram was made from other properties than it has now.

    Args:
        material: A hologram.

    Returns:
        True also where it has no shader.
    """
    held: str = material.hologram.made_of
    return held != fingerprint(material) or hologram_node(material) is None


def check_writable(material: bpy.types.Material) -> None:
    """Refuse to write a material of another file.

    Args:
        material: A hologram.

    Raises:
        HoeError: It is linked, or in a file of a newer version of the add-on.
    """
    for scene in bpy.data.scenes:
        if scene.library is None and is_newer(scene):
            raise HoeError(f"scene {scene.name}: {newer_words(scene.hologram.version)}")
    if material.library is not None:
        raise HoeError(
            f"material {material.name}: is linked from {material.library.filepath}; edit it there, "
            "or make it local (Object > Relations > Make Local > All)"
        )


def follows_for_now(material: bpy.types.Material) -> str:
    """Say what does not last where properties override those of another file.

    Args:
        material: A hologram.

    Returns:
        What a person should know, or nothing.
    """
    override = material.override_library
    if override is None or fingerprint(material) == fingerprint(override.reference):
        return ""
    return (
        "overrides a linked material: Blender does not save its shader, which is made anew where "
        "the add-on opens the file; make the material local to render it anywhere"
    )


def a_wavelength() -> bpy.types.NodeTree | None:
    """Find the node group that hands out wavelengths: that of the scene shown, or of another.

    Returns:
        The group, or None where no scene has one.
    """
    for scene in (bpy.context.scene, *bpy.data.scenes):
        group = scene.hologram.wavelength if scene is not None else None
        if group is not None and group.library is None:
            return group
    return None
