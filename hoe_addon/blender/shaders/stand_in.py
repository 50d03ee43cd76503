# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain looks for where a shader cannot run: Eevee, the Solid view, and Cycles without OSL.

Every material has two outputs: one for Cycles with the shader, one for Eevee with a plain node. An
output for one engine goes before one for all. So where Cycles cannot run OSL, a third output gives
it the plain node too, and the first one stands back.
"""

from collections.abc import Sequence
from enum import Enum, unique

import bpy

from .osl import runs_osl

_NODE = "Stand-In"
_EEVEE, _CYCLES = "Stand-In in Eevee", "Stand-In in Cycles"
_OUTPUT = "ShaderNodeOutputMaterial"


@unique
class Look(Enum):
    """What a material looks like; colour, alpha and roughness."""

    PLATE = (0.55, 0.85, 0.95), 0.3, 0.05
    """A tinted clear plate, for holograms."""
    GLASS = (0.9, 0.97, 1.0), 0.12, 0.0
    """Clear glass."""
    LENS = (0.8, 0.88, 1.0), 0.2, 0.0
    """A lens without any error."""
    LIGHT = (0.0, 0.0, 0.0), 1.0, 1.0
    """A picture or a lamp."""
    NOTHING = (1.0, 1.0, 1.0), 0.0, 0.0
    """Not seen at all, for the filter of the eye."""


class _State:
    """Whether all materials show their shaders in Cycles; None where some are new."""

    runs: bool | None = None


_state = _State()


def stand_in_for(
    material: bpy.types.Material,
    look: Look,
    *,
    colour: Sequence[float] | None = None,
    image: bpy.types.NodeSocket | None = None,
) -> None:
    """Give a material its plain look; one that has it stays as it is.

    Args:
        material: A material with an output for its shader.
        look: What it looks like.
        colour: Linear RGB of the light of a lamp.
        image: Colour of a picture that gives light.
    """
    tree = material.node_tree
    assert tree is not None
    if tree.nodes.get(_NODE) is not None:
        return
    main_output(tree).target = "CYCLES"
    node = _plain_node(tree, look, colour or (1.0, 1.0, 1.0), image)
    node.name = node.label = _NODE
    node.location = (-300.0, 420.0)
    _add_output(tree, _EEVEE, "EEVEE")
    shown, alpha, roughness = look.value
    material.diffuse_color = (*(colour or shown), alpha) if look is Look.LIGHT else (*shown, alpha)
    material.roughness = roughness
    material.surface_render_method = "DITHERED" if look is Look.LIGHT else "BLENDED"
    _state.runs = None


def main_output(tree: bpy.types.NodeTree) -> bpy.types.Node:
    """The output of a material that its shader goes to; made where there is none.

    Args:
        tree: Nodes of a material.

    Returns:
        The output node.
    """
    found = tree.get_output_node("CYCLES")
    if found is None or found.name in (_EEVEE, _CYCLES):
        others = (node for node in tree.nodes if node.bl_idname == _OUTPUT)
        found = next((node for node in others if node.name not in (_EEVEE, _CYCLES)), None)
    return found or tree.nodes.new(_OUTPUT)


def settle(scene: bpy.types.Scene) -> None:
    """Let all materials show their shaders in Cycles, or plain looks where it cannot run OSL.

    Args:
        scene: The scene that is shown or rendered; its device and settings count.
    """
    _state.runs = runs = runs_osl(scene)
    for material in bpy.data.materials:
        tree = material.node_tree
        if tree is not None and material.library is None and _NODE in tree.nodes:
            _show(tree, plain=not runs)


def settle_if_changed(scene: bpy.types.Scene) -> None:
    """Settle where a setting of the scene has changed; cheap, for after every update.

    Args:
        scene: The scene that is shown.
    """
    if runs_osl(scene) != _state.runs:
        settle(scene)


def _show(tree: bpy.types.NodeTree, *, plain: bool) -> None:
    output = tree.nodes.get(_CYCLES)
    if plain == (output is not None):
        return
    main = main_output(tree)
    if output is not None:
        tree.nodes.remove(output)
        main.target = "CYCLES"
    else:
        main.target = "ALL"
        _add_output(tree, _CYCLES, "CYCLES")


def _add_output(tree: bpy.types.NodeTree, name: str, target: str) -> None:
    output = tree.nodes.new(_OUTPUT)
    output.name = output.label = name
    output.target = target
    output.location = (0.0, 420.0 if target == "EEVEE" else 560.0)
    tree.links.new(tree.nodes[_NODE].outputs[0], output.inputs["Surface"])


def _plain_node(
    tree: bpy.types.NodeTree,
    look: Look,
    colour: Sequence[float],
    image: bpy.types.NodeSocket | None,
) -> bpy.types.Node:
    if look is Look.NOTHING:
        return tree.nodes.new("ShaderNodeBsdfTransparent")
    shown, alpha, roughness = look.value
    # One node of a kind that nothing here searches for.
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    node.inputs["Base Color"].default_value = (*shown, 1.0)
    node.inputs["Alpha"].default_value = alpha
    node.inputs["Roughness"].default_value = roughness
    if look is Look.LIGHT:
        node.inputs["Emission Strength"].default_value = 1.0
        node.inputs["Emission Color"].default_value = (*colour, 1.0)
        if image is not None:
            tree.links.new(image, node.inputs["Emission Color"])
    return node
