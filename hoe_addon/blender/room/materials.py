# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of the room: procedural, no picture files, and cheap.

Every path that the room throws back and forth evaluates some of them, so what is matte is one
diffuse node, and only what the eye sees closely has a pattern.
"""

from collections.abc import Sequence

import bpy

from ..marks import mark
from ..shaders import nodes

type Colour = tuple[float, float, float]


def matte(name: str, colour: Colour) -> bpy.types.Material:
    """One colour, seen equally bright from everywhere."""
    material, _ = _surface(name, "ShaderNodeBsdfDiffuse", "BSDF", {"Color": (*colour, 1.0)})
    return material


def polished(
    name: str, colour: Colour, roughness: float, metallic: float = 0.0
) -> bpy.types.Material:
    """One colour with a sheen; keep it rough, or lamps make caustics."""
    values = {"Base Color": (*colour, 1.0), "Roughness": roughness, "Metallic": metallic}
    material, _ = _surface(name, "ShaderNodeBsdfPrincipled", "BSDF", values)
    return material


def mottled(
    name: str, colours: tuple[Colour, Colour], period: Sequence[float]
) -> bpy.types.Material:
    """Two colours mixed by noise: grain of wood, weave of cloth.

    Args:
        name: Name of the material.
        colours: Scene-linear colours of the extremes.
        period: Size of the pattern along the object's axes, in scene units.

    Returns:
        A new material.
    """
    material, surface = _surface(name, "ShaderNodeBsdfDiffuse", "BSDF", {})
    tree = material.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 1.0
    noise.inputs["Detail"].default_value = 1.0
    tree.links.new(_scaled_position(tree, period), noise.inputs["Vector"])
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    for element, place, colour in zip(ramp.color_ramp.elements, (0.3, 0.7), colours, strict=True):
        element.position, element.color = place, (*colour, 1.0)
    tree.links.new(noise.outputs[0], ramp.inputs[0])
    tree.links.new(ramp.outputs["Color"], surface.inputs["Color"])
    return material


def glowing(name: str, colour: Colour, radiance: float) -> bpy.types.Material:
    """A surface that only gives light, the same in all directions."""
    values = {"Color": (*colour, 1.0), "Strength": radiance}
    material, _ = _surface(name, "ShaderNodeEmission", "Emission", values)
    return material


def _surface(
    name: str, kind: str, output_name: str, values: dict[str, float | tuple[float, ...]]
) -> tuple[bpy.types.Material, bpy.types.Node]:
    material = mark(bpy.data.materials.new(name))
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = tree.nodes.new(kind)
    surface.location = (-300.0, 0.0)
    for socket, value in values.items():
        surface.inputs[socket].default_value = value
    tree.links.new(surface.outputs[output_name], output.inputs["Surface"])
    return material, surface


def _scaled_position(tree: bpy.types.NodeTree, period: Sequence[float]) -> bpy.types.NodeSocket:
    position = tree.nodes.new("ShaderNodeTexCoord")
    scale = tree.nodes.new("ShaderNodeVectorMath")
    scale.operation = "DIVIDE"
    scale.inputs[1].default_value = tuple(period)
    tree.links.new(position.outputs["Object"], scale.inputs[0])
    return scale.outputs[0]
