# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of the room: procedural, few nodes, no picture files."""

from collections.abc import Sequence

import bpy

from . import nodes

type Colour = tuple[float, float, float]


def plain(
    name: str, colour: Colour, roughness: float = 0.7, metallic: float = 0.0
) -> bpy.types.Material:
    """One colour."""
    material, _ = _principled(name, colour, roughness, metallic)
    return material


def mottled(
    name: str,
    colours: tuple[Colour, Colour],
    period: Sequence[float],
    *,
    roughness: float = 0.7,
    relief: float = 0.0,
) -> bpy.types.Material:
    """Two colours mixed by noise: grain of wood, weave of cloth, paint.

    Args:
        name: Name of the material.
        colours: Scene-linear colours of the extremes.
        period: Size of the pattern along the object's axes, in scene units.
        roughness: Of the surface.
        relief: Height of the pattern as a bump, in scene units.

    Returns:
        A new material.
    """
    material, surface = _principled(name, colours[0], roughness)
    tree = material.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 1.0
    noise.inputs["Detail"].default_value = 3.0
    tree.links.new(_scaled_position(tree, period), noise.inputs["Vector"])
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    for element, place, colour in zip(ramp.color_ramp.elements, (0.3, 0.7), colours, strict=True):
        element.position, element.color = place, (*colour, 1.0)
    tree.links.new(noise.outputs["Factor"], ramp.inputs["Factor"])
    tree.links.new(ramp.outputs["Color"], surface.inputs["Base Color"])
    if relief > 0.0:
        bump = tree.nodes.new("ShaderNodeBump")
        bump.inputs["Distance"].default_value = relief
        tree.links.new(noise.outputs["Factor"], bump.inputs["Height"])
        tree.links.new(bump.outputs["Normal"], surface.inputs["Normal"])
    return material


def glowing(name: str, colour: Colour, radiance: float) -> bpy.types.Material:
    """A surface that only gives light, the same in all directions."""
    material = bpy.data.materials.new(name)
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (*colour, 1.0)
    emission.inputs["Strength"].default_value = radiance
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


def _principled(
    name: str, colour: Colour, roughness: float, metallic: float = 0.0
) -> tuple[bpy.types.Material, bpy.types.Node]:
    material = bpy.data.materials.new(name)
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
    surface.location = (-300.0, 0.0)
    surface.inputs["Base Color"].default_value = (*colour, 1.0)
    surface.inputs["Roughness"].default_value = roughness
    surface.inputs["Metallic"].default_value = metallic
    surface.inputs["Specular IOR Level"].default_value = 0.3
    tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    return material, surface


def _scaled_position(tree: bpy.types.NodeTree, period: Sequence[float]) -> bpy.types.NodeSocket:
    position = tree.nodes.new("ShaderNodeTexCoord")
    scale = tree.nodes.new("ShaderNodeVectorMath")
    scale.operation = "DIVIDE"
    scale.inputs[1].default_value = tuple(period)
    tree.links.new(position.outputs["Object"], scale.inputs[0])
    return scale.outputs[0]
