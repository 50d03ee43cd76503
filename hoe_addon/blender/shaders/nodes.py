# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Script nodes: text, bytecode and sockets, so that a .blend renders without this add-on."""

import hashlib
import struct
from collections.abc import Mapping, Sequence

import bpy

from ...shading.interface import Parameter, ParameterKind, parameters
from ...shading.source import ShaderSource
from ..marks import mark
from ..quiet import captured_output
from .osl import compiled

type SocketValue = float | int | Sequence[float]

_ATTRIBUTE = "attribute_"
_FEEDER = "For the hologram"

_SOCKET_TYPES = {
    ParameterKind.FLOAT: "NodeSocketFloat",
    ParameterKind.INT: "NodeSocketInt",
    ParameterKind.VECTOR: "NodeSocketVector",
    ParameterKind.COLOR: "NodeSocketColor",
    ParameterKind.CLOSURE: "NodeSocketShader",
}


def add_script_node(
    tree: bpy.types.NodeTree, source: ShaderSource, values: Mapping[str, SocketValue]
) -> bpy.types.Node:
    """Add a Script node that runs a shader.

    Args:
        tree: Node tree of a material, or a node group.
        source: The flat text.
        values: Socket identifier to value; others keep the shader's default.

    Returns:
        The node; its sockets are addressed by the shader's identifiers.

    Raises:
        ShaderCompileError: The text does not compile.
        KeyError: A value for a socket that the shader does not have; our own mistake.
    """
    compiled(source)  # what can fail comes first: no node is left behind
    node = tree.nodes.new("ShaderNodeScript")
    node.label = source.name.replace("_", " ")
    set_script(node, source)
    set_values(node, values)
    return node


def set_script(node: bpy.types.Node, source: ShaderSource) -> None:
    """Give a Script node another text. Sockets that both texts have keep value and links."""
    bytecode = compiled(source)
    # Where the module oslquery is missing (the bpy module ships one that does not fit the
    # OpenImageIO beside it), Cycles' own socket update prints a traceback. The sockets are made
    # here, so the message would only frighten.
    with captured_output():
        node.mode = "INTERNAL"
        node.script = _text_block(source)
    node.bytecode = bytecode
    # Cycles compares this hash, not the bytecode, to know that the shader has changed.
    node.bytecode_hash = hashlib.md5(bytecode.encode(), usedforsecurity=False).hexdigest()
    _match_sockets(node, parameters(bytecode))
    _feed_attributes(node)


def set_values(node: bpy.types.Node, values: Mapping[str, SocketValue]) -> None:
    """Write socket values; nothing is compiled, and what is there already is not written."""
    sockets = {socket.identifier: socket for socket in node.inputs}
    for name, value in values.items():
        socket = sockets[name]
        if socket.type == "RGBA" and isinstance(value, Sequence):
            value = (*value[:3], 1.0)
        if not _holds(socket, value):
            socket.default_value = value


def _holds(socket: bpy.types.NodeSocket, value: SocketValue) -> bool:
    """Whether a socket has this value, as far as its float32 can tell."""
    held = socket.default_value
    if isinstance(value, Sequence):
        return tuple(held) == struct.unpack(f"{len(value)}f", struct.pack(f"{len(value)}f", *value))
    if isinstance(held, int):
        return held == value
    return held == struct.unpack("f", struct.pack("f", value))[0]


def socket_names(source: ShaderSource) -> frozenset[str]:
    """Identifiers of the inputs that this text has."""
    return frozenset(p.name for p in parameters(compiled(source)) if not p.is_output)


def script_material(
    name: str, source: ShaderSource, values: Mapping[str, SocketValue]
) -> bpy.types.Material:
    """A material whose surface is one Script node.

    Args:
        name: Name of the datablock.
        source: The flat text; its closure is called ``result``.
        values: Socket identifier to value.

    Returns:
        The material.
    """
    material = mark(bpy.data.materials.new(name))
    tree = new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    node = add_script_node(tree, source, values)
    node.location = (-300.0, 0.0)
    tree.links.new(output_socket(node, "result"), output.inputs["Surface"])
    return material


def new_tree(
    owner: bpy.types.Material | bpy.types.World | bpy.types.Light,
) -> bpy.types.NodeTree:
    """The node tree of a new material, world or light, emptied."""
    if owner.node_tree is None:
        owner.use_nodes = True
    tree = owner.node_tree
    assert tree is not None
    tree.nodes.clear()
    return tree


def tree_of(material: bpy.types.Material) -> bpy.types.NodeTree:
    """The node tree of a material made here, which always has one."""
    assert material.node_tree is not None
    return material.node_tree


def script_node(material: bpy.types.Material) -> bpy.types.Node:
    """The one Script node of a material made here."""
    return next(node for node in tree_of(material).nodes if node.bl_idname == "ShaderNodeScript")


def input_socket(node: bpy.types.Node, identifier: str) -> bpy.types.NodeSocket:
    """The input with this identifier."""
    return next(socket for socket in node.inputs if socket.identifier == identifier)


def output_socket(node: bpy.types.Node, identifier: str) -> bpy.types.NodeSocket:
    """The output with this identifier."""
    return next(socket for socket in node.outputs if socket.identifier == identifier)


def _text_block(source: ShaderSource) -> bpy.types.Text:
    name = f"{source.name}_{source.digest}.osl"
    # Not one of a library: the material would need that file from then on.
    text = bpy.data.texts.get((name, None))
    if text is None:
        text = bpy.data.texts.new(name)
        text.write(source.text)
    elif text.as_string() != source.text:
        text.from_string(source.text)
    return text


def _match_sockets(node: bpy.types.Node, wanted: Sequence[Parameter]) -> None:
    for is_output, sockets in ((False, node.inputs), (True, node.outputs)):
        named = {p.name: p for p in wanted if p.is_output is is_output}
        for socket in list(sockets):
            parameter = named.get(socket.identifier)
            if parameter is None or socket.bl_idname != _SOCKET_TYPES[parameter.kind]:
                sockets.remove(socket)
        present = {socket.identifier for socket in sockets}
        for parameter in named.values():
            if parameter.name not in present:
                _add_socket(sockets, parameter)


def _feed_attributes(node: bpy.types.Node) -> None:
    """Link each socket called ``attribute_NAME`` to the mesh's attribute of that name.

    Cycles hands attributes to a shader only where an Attribute node asks for them.
    """
    tree = node.id_data
    wanted = {
        socket.identifier.removeprefix(_ATTRIBUTE): socket
        for socket in node.inputs
        if socket.identifier.startswith(_ATTRIBUTE)
    }
    for feeder in [item for item in tree.nodes if item.label == _FEEDER]:
        if not feeder.outputs["Vector"].is_linked:
            tree.nodes.remove(feeder)
    for name, socket in wanted.items():
        if not socket.is_linked:
            feeder = tree.nodes.new("ShaderNodeAttribute")
            feeder.label, feeder.attribute_name = _FEEDER, name
            feeder.location = (-560.0, -200.0)
            tree.links.new(feeder.outputs["Vector"], socket)


def _add_socket(
    sockets: bpy.types.NodeInputs | bpy.types.NodeOutputs, parameter: Parameter
) -> None:
    socket = sockets.new(_SOCKET_TYPES[parameter.kind], parameter.label, identifier=parameter.name)
    match parameter.kind:
        case ParameterKind.FLOAT:
            socket.default_value = parameter.default[0]
        case ParameterKind.INT:
            socket.default_value = int(parameter.default[0])
        case ParameterKind.VECTOR:
            socket.default_value = parameter.default
        case ParameterKind.COLOR:
            socket.default_value = (*parameter.default, 1.0)
        case ParameterKind.CLOSURE:
            pass
