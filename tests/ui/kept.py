# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file has to keep: documents, holograms, and their shaders; all without pointers."""

from typing import Any

import bpy
import numpy as np

from hoe_addon.blender.document.held import document_of, has_device
from hoe_addon.blender.props.sync import read_spec
from hoe_addon.core.errors import HoeError
from hoe_addon.model.document import to_document

FLOAT32 = 3e-7
"""Properties are float32; what is built of a document has its numbers unrounded."""


def documents() -> dict[str, Any]:
    """The document of every scene, and every hologram that is used; or what is wrong with it."""
    found: dict[str, Any] = {}
    for scene in bpy.data.scenes:
        if has_device(scene):
            found[f"scene {scene.name}"] = _told(lambda scene=scene: document_of(scene))
    for material in bpy.data.materials:
        if material.hologram.enabled and material.users:
            found[f"material {material.name}"] = _told(lambda m=material: read_spec(m))
    return found


def shaders() -> dict[str, Any]:
    """Text and numbers of every shader of a material that is used."""
    return {
        f"{material.name}.{node.name}": _shader(node)
        for material in bpy.data.materials
        if material.users and material.node_tree is not None
        for node in material.node_tree.nodes
        if node.bl_idname == "ShaderNodeScript"
    }


def holograms() -> list[Any]:
    """Materials of this file that are valid holograms."""
    return [
        material
        for material in bpy.data.materials
        if material.hologram.enabled and material.users and not material.hologram.problem
    ]


def differences(one: Any, other: Any, *, rounded: bool = False) -> dict[str, Any]:
    """What differs between two, by name.

    Args:
        one: The one.
        other: The other.
        rounded: Whether rounding to float32 is no difference.
    """
    found: dict[str, Any] = {}
    for name in sorted(one.keys() | other.keys()):
        mine, its = one.get(name), other.get(name)
        if isinstance(mine, dict) and isinstance(its, dict):
            inner = differences(mine, its, rounded=rounded)
            if inner:
                found[name] = inner
        elif mine != its and not (rounded and _close(mine, its)):
            found[name] = mine, its
    return found


def _close(one: Any, other: Any) -> bool:
    kinds = (int, float, tuple)
    if not isinstance(one, kinds) or not isinstance(other, kinds):
        return False
    return bool(np.allclose(one, other, rtol=FLOAT32, atol=FLOAT32))


def _told(read: Any) -> Any:
    try:
        return to_document(read())
    except HoeError as error:
        return str(error)


def _shader(node: Any) -> dict[str, Any]:
    numbers = {
        socket.identifier: _plain(socket.default_value)
        for socket in node.inputs
        if hasattr(socket, "default_value")
    }
    return {"script": node.script and node.script.name, "code": hash(node.bytecode)} | numbers


def _plain(value: Any) -> Any:
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
