# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The node that runs a hologram's shader, and how it is brought up to date."""

import bpy

from ...shading.source import ShaderSource, defining
from ..shaders import nodes
from ..shaders.following import drive
from ..shaders.stand_in import Look, main_output, stand_in_for

_SHADER = "hoe_hologram"
_PLAIN = "HOE_PLAIN"
"""Defined in a text by ``diffracted``, by the orders and the model, as the text itself is."""


def hologram_node(material: bpy.types.Material) -> bpy.types.Node | None:
    """Find the node that runs the hologram's shader.

    Args:
        material: Any material.

    Returns:
        The node, or None.
    """
    tree = material.node_tree
    for node in tree.nodes if tree is not None else ():
        if node.bl_idname == "ShaderNodeScript" and node.script is not None:
            name: str = node.script.name
            if name.startswith(f"{_SHADER}_"):
                return node
    return None


def needed_node(material: bpy.types.Material) -> bpy.types.Node:
    """The node of a material that has one."""
    node = hologram_node(material)
    assert node is not None
    return node


def bring_up_to_date(
    material: bpy.types.Material, source: ShaderSource, values: dict[str, nodes.SocketValue]
) -> bool:
    """Give the node of a material a text and numbers; a material without one gets it.

    Args:
        material: The material.
        source: The text.
        values: Its numbers.

    Returns:
        Whether the text was changed.
    """
    node = hologram_node(material)
    if node is None:
        _add_node(material, source, values)
        return True
    before = node.script
    changed = not _runs(node, source)
    if changed:
        drive(node, {})  # a driver of a socket that goes would stay behind
        nodes.set_script(node, source)
        if node.script != before:
            _drop_unused(before)
    nodes.set_values(node, values)
    return changed


def takes_wavelength(material: bpy.types.Material) -> bool:
    """Tell whether the shader of a material is given the wavelength."""
    node = hologram_node(material)
    return node is not None and nodes.input_socket(node, "wavelength_nm").is_linked


def _runs(node: bpy.types.Node, source: ShaderSource) -> bool:
    """Whether a node has this text, or the one that a render job makes of it."""
    name: str = node.script.name
    # An appended text may have got a number behind its name.
    if name.startswith(f"{source.name}_{source.digest}.osl"):
        return True
    return name.startswith(f"{source.name}_{defining(source, _PLAIN).digest}.osl")


def _add_node(
    material: bpy.types.Material, source: ShaderSource, values: dict[str, nodes.SocketValue]
) -> None:
    tree = material.node_tree or nodes.new_tree(material)
    node = nodes.add_script_node(tree, source, values)
    node.location = (-300.0, 0.0)
    output = main_output(tree)
    tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
    stand_in_for(material, Look.PLATE)


def _drop_unused(text: bpy.types.Text) -> None:
    # Else a .blend collects a text for every setting that was ever tried. A text counts itself.
    if text.library is None and text.users <= int(text.use_fake_user):
        bpy.data.texts.remove(text)
