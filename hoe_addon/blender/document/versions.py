# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of older versions of the add-on, brought to this one step by step.

A file says in each scene which version wrote it. One of a newer version is left alone.
"""

from collections.abc import Callable, Mapping

import bpy

from ..ids import Role
from ..marks import mark
from ..props import changes
from ..props.device import VERSION
from ..props.shader_node import hologram_node
from ..shaders import nodes
from ..shaders.maps import MAP_NODE
from ..shaders.nodes import input_socket
from ..shaders.stand_in import Look, stand_in_for

type Step = Callable[[bpy.types.Scene], None]

_BARE = 0
"""What a scene says that no version of the add-on has written a version into."""


def migrate_file() -> None:
    """Bring all scenes of the open file to this version; those of other files are left alone."""
    for scene in bpy.data.scenes:
        if scene.library is None:
            migrate(scene)


def migrate(scene: bpy.types.Scene) -> None:
    """Bring a scene to this version of the add-on.

    Args:
        scene: The scene; one of a newer version gets nothing but words in its ``problem``.
    """
    held = scene.hologram
    if held.version > VERSION:
        held.problem = newer_words(held.version)
        return
    found = held.version or _version_of(scene)
    with changes.unmarked():
        for version in range(found or VERSION, VERSION):
            _STEPS[version](scene)
            held.version = version + 1


def is_newer(scene: bpy.types.Scene) -> bool:
    """Tell whether a newer version of the add-on wrote a scene.

    Args:
        scene: The scene.
    """
    return scene.hologram.version > VERSION


def file_is_newer() -> bool:
    """Tell whether a newer version of the add-on wrote the open file."""
    return any(is_newer(scene) for scene in bpy.data.scenes if scene.library is None)


def newer_words(version: int) -> str:
    """Say that a file is of a newer version.

    Args:
        version: Its version.

    Returns:
        One line.
    """
    return f"made by a newer version {version} of the add-on; this one knows {VERSION}: update it"


def _version_of(scene: bpy.types.Scene) -> int:
    """Version of a scene that does not tell: 1 where it has holograms, else none."""
    slots = (slot for item in scene.objects for slot in item.material_slots)
    holograms = (slot.material is not None and slot.material.hologram.enabled for slot in slots)
    return 1 if any(holograms) else _BARE


def _tell_parts(scene: bpy.types.Scene) -> None:
    """From 1 to 2: objects say what they are, and the scene knows its eye and its wavelength."""
    give_roles(scene)
    _give_stand_ins(scene)
    held = scene.hologram
    if scene.camera is not None and scene.camera.hologram.role == Role.EYE:
        held.eye.camera = scene.camera
    for item in scene.objects:
        for slot in item.material_slots:
            if slot.material is not None and slot.material.hologram.enabled:
                held.wavelength = held.wavelength or _wavelength_of(slot.material)


def _give_stand_ins(scene: bpy.types.Scene) -> None:
    """Materials of version 1 are black in Eevee."""
    slots = (slot for item in scene.objects for slot in item.material_slots)
    for material in {slot.material for slot in slots if slot.material is not None}:
        for shader, look in _LOOKS.items():
            if material.library is None and _runs(material, shader):
                stand_in_for(material, look, image=_shown(material))


def _shown(material: bpy.types.Material) -> bpy.types.NodeSocket | None:
    """The colour of the picture in a material, where it shows one."""
    for node in nodes.tree_of(material).nodes:
        if node.bl_idname == "ShaderNodeTexImage" and node.name != MAP_NODE:
            return node.outputs["Color"]
    return None


def give_roles(scene: bpy.types.Scene) -> None:
    """Let objects say what they are that do not yet, such as those appended from an older file.

    Args:
        scene: The scene.
    """
    for item in scene.objects:
        if item.library is not None or item.hologram.role != Role.NONE:
            continue
        role = _role_of(scene, item)
        if role is not None:
            item.hologram.role = role


def _role_of(scene: bpy.types.Scene, item: bpy.types.Object) -> Role | None:
    materials = [slot.material for slot in item.material_slots if slot.material is not None]
    if any(_runs(each, "hoe_spectral_filter") for each in materials):
        return Role.FILTER
    if any(_runs(each, "hoe_thin_lens") for each in materials):
        return Role.IDEAL_LENS
    if any(each.hologram.enabled for each in materials):
        return Role.HOLOGRAM
    if item == scene.camera and any(_is_filter(child) for child in item.children):
        return Role.EYE
    return None


def _is_filter(item: bpy.types.Object) -> bool:
    slots = (slot.material for slot in item.material_slots if slot.material is not None)
    return any(_runs(each, "hoe_spectral_filter") for each in slots)


def _wavelength_of(material: bpy.types.Material) -> bpy.types.NodeTree | None:
    """The node group that gives a hologram's shader its wavelength."""
    node = hologram_node(material)
    links = input_socket(node, "wavelength_nm").links if node is not None else None
    return getattr(links[0].from_node, "node_tree", None) if links else None


def _runs(material: bpy.types.Material, shader: str) -> bool:
    tree = material.node_tree
    return any(
        node.bl_idname == "ShaderNodeScript"
        and node.script is not None
        and node.script.name.startswith(shader)
        for node in (tree.nodes if tree is not None else ())
    )


def _tell_made(scene: bpy.types.Scene) -> None:
    """From 2 to 3: what the add-on made says so, and all else is the user's."""
    room = scene.hologram.room.collection
    for item in room.objects if room is not None else ():
        if item.library is None and item.hologram.role == Role.NONE and _is_of_room(item):
            item.hologram.role = Role.ROOM
    for item in scene.objects:
        if item.hologram.role in (Role.NONE, Role.ROOM):
            continue
        materials = {slot.material for slot in item.material_slots if slot.material is not None}
        made = [material for material in materials if _is_made(material)]
        if isinstance(item.data, bpy.types.Mesh) and item.hologram.role != Role.HOLOGRAM:
            made.append(item.data)  # of a hologram it may be the user's
        for block in made:
            if block.library is None:
                mark(block)


def _is_of_room(item: bpy.types.Object) -> bool:
    """Tell whether version 2 put an object into its room; what is in doubt is the user's."""
    if item.type not in ("MESH", "LIGHT"):
        return False
    names = {each.name.partition(".")[0].rstrip(" 0123456789") for each in (item, item.data)}
    # Blender too calls its suns Sun, but puts them into no light group.
    return names <= _ROOMS and (item.type == "MESH" or item.lightgroup == _AMBIENT)


def _is_made(material: bpy.types.Material) -> bool:
    """Tell whether a material of an element is as version 2 made it."""
    if any(_runs(material, shader) for shader in _LOOKS):
        return True
    tree = material.node_tree
    kinds = {node.bl_idname for node in tree.nodes} if tree is not None else set()
    return "ShaderNodeBsdfDiffuse" in kinds and kinds <= _MATTE


_AMBIENT = "ambient"
"""Light group of a room."""

_MATTE = frozenset(
    (
        "ShaderNodeBsdfDiffuse",
        "ShaderNodeOutputMaterial",
        "ShaderNodeTexImage",
        "ShaderNodeVectorMath",
    )
)
"""Nodes of what version 2 made cards, blocks, holders and housings of."""

_ROOMS = frozenset((
    "Bonnet", "Bookcase", "Books", "Bowl", "Car", "Car Glass", "Cushion", "Desk", "Floor", "Ground",
    "Hills", "Jar", "Lamp", "Lamp Stand", "Lampshade", "Lines", "Passe-partout", "Picture Frame",
    "Plant", "Posts", "Pot", "Print", "Print Sun", "Road", "Room", "Rug", "Skirting", "Sofa",
    "Stool", "Sun", "Tail Lights", "Tall Vase", "Target", "Trees", "Vase", "Wall", "Window",
))  # fmt: skip
"""Names of what version 2 put into its rooms, without the numbers behind them."""

_LOOKS = {
    "hoe_hologram": Look.PLATE,
    "hoe_dielectric": Look.GLASS,
    "hoe_thin_lens": Look.LENS,
    "hoe_display": Look.LIGHT,
    "hoe_spectral_filter": Look.NOTHING,
}
"""Plain look of a material by the shader in it."""

_STEPS: Mapping[int, Step] = {1: _tell_parts, 2: _tell_made}
"""For each older version, the step to the next one."""
