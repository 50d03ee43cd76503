# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Things of a scene that give no light: printed cards, blocks, holders of optical elements."""

from pathlib import Path

import bpy
import numpy as np

from ...model.scene_parts import BlockElement, CardElement, HolderElement
from ..room import materials as materials
from ..room import shapes as shapes
from ..shaders import nodes
from . import meshes
from .lights import picture_mesh
from .stage import display_image

_SIDES = 96
_ROD_RADIUS = 4.0
_FOOT_RADIUS, _FOOT_HEIGHT = 45.0, 10.0


def add_card(
    collection: bpy.types.Collection, element: CardElement, field: str, folder: Path
) -> bpy.types.Object:
    """Add a matte panel with a printed picture.

    Args:
        collection: Where it is linked.
        element: The card; its place is set by the caller.
        field: Field that names the picture, for messages.
        folder: Folder that an image file is relative to.

    Returns:
        The object.

    Raises:
        SpecError: The picture cannot be read.
    """
    image = display_image(element.image, element.size_mm, folder, field)
    material = materials.matte(element.name, (1.0, 1.0, 1.0))
    tree = nodes.tree_of(material)
    paper = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeBsdfDiffuse")
    print_ = tree.nodes.new("ShaderNodeTexImage")
    print_.image = image
    ink = tree.nodes.new("ShaderNodeVectorMath")
    ink.operation = "SCALE"
    ink.inputs["Scale"].default_value = element.reflectance
    tree.links.new(print_.outputs["Color"], ink.inputs[0])
    tree.links.new(ink.outputs[0], paper.inputs["Color"])
    return meshes.add(collection, picture_mesh(element.name, element.size_mm), material)


def add_block(collection: bpy.types.Collection, element: BlockElement) -> bpy.types.Object:
    """Add a matte body.

    Args:
        collection: Where it is linked.
        element: The body; its place is set by the caller.

    Returns:
        The object.
    """
    half = np.asarray(element.size_mm) / 2.0
    if element.shape == "box":
        body = shapes.box(-half, half)
    else:
        profile = [(0.0, -half[2]), (1.0, -half[2]), (1.0, half[2]), (0.0, half[2])]
        unit = shapes.lathe(profile, _SIDES)
        body = shapes.Shape(unit.corners * (half[0], half[1], 1.0), unit.faces)
    return meshes.add(
        collection, body.mesh(element.name), materials.matte(element.name, element.color)
    )


def add_holder(collection: bpy.types.Collection, element: HolderElement) -> bpy.types.Object:
    """Add a frame around an opening, on a rod or without one.

    Args:
        collection: Where it is linked.
        element: The frame; its place is set by the caller.

    Returns:
        The object.
    """
    half = np.asarray(element.opening_mm) / 2.0
    rim, depth = element.rim_mm, element.depth_mm / 2.0
    outline = _outline(element.outline)
    # Around the opening: inner edge to the back, out, to the front, and in again.
    rings = [(0.0, -depth), (rim, -depth), (rim, depth), (0.0, depth), (0.0, -depth)]
    rows = [np.c_[outline * (half + wide), np.full(len(outline), z)] for wide, z in rings]
    parts = [shapes.grid(np.stack(rows), wrapped=True)]
    if element.rod_mm > 0.0:
        top, low = -half[1] - rim / 2.0, -half[1] - rim - element.rod_mm
        rod = shapes.tube(np.asarray([(0.0, 0.0, low), (0.0, 0.0, top)]), _ROD_RADIUS, 24)
        high = low + _FOOT_HEIGHT
        profile = [(0.0, low), (_FOOT_RADIUS, low), (_FOOT_RADIUS, high), (0.0, high)]
        foot = shapes.lathe(profile, _SIDES)
        parts += [part.turned("x", -90.0) for part in (rod, foot)]
    mesh = shapes.joined(parts).mesh(element.name)
    return meshes.add(collection, mesh, materials.matte(element.name, element.color))


def _outline(kind: str) -> np.ndarray:
    """Points around an outline of half width and half height 1, counter-clockwise."""
    if kind == "rectangle":
        return np.asarray([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    angle = np.arange(_SIDES) * (2.0 * np.pi / _SIDES)
    return np.stack((np.cos(angle), np.sin(angle)), axis=1)
