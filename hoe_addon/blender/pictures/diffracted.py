# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelengths only where light is diffracted: less noise, and the same picture on average.

With the eye's response in front of the camera, every path has a wavelength, and all that is seen
has the noise of it. But order 0 of a thin hologram in one medium, with a constant share, goes alike
at all wavelengths. So here the response stands at the light sources, and counts for the paths that
have gone through a portal alone; order 0 is a refraction by 1, and what comes by it has
its colour at once. The mean of the response is 1, and its mean with the emission of a display is
the display's colour, so both pictures have the same mean.
"""

from collections.abc import Iterator, Mapping

import bpy

from ...core.orders import TRANSMITTED_ZERO
from ...model.device import DeviceSpec
from ...model.effects.light import USED_PRIMARIES
from ...model.efficiency import ConstantSpec
from ...model.hologram import HologramSpec
from ...model.scene import SceneSpec
from ...model.scene_parts import DisplayElement, HologramElement, LampElement
from ...model.scene_spectra import IlluminantSpec
from ...shading.source import ShaderSource, defining
from ...shading.wavelength import response_shader
from ..shaders import nodes
from ..shaders.spectral import SpectralScene

_RESPONSE = "Response"
_AT_LIGHTS = "HOE_FILTER_AT_LIGHTS"
FLOOR = 0.1
"""Largest share of the wavelength samples for light other than the emitters': the room is seen by
diffraction only in part, and needs no wavelengths for the rest."""


def is_plain(spec: HologramSpec) -> bool:
    """Tell whether order 0 goes straight through a hologram, alike at all wavelengths.

    Args:
        spec: The hologram.

    Returns:
        True for constant shares with order 0 among them, one medium on both sides, and no haze.
    """
    model = spec.efficiency
    if not isinstance(model, ConstantSpec) or model.haze is not None:
        return False
    branches = model.branches(spec.orders, spec.pattern.wavelength_nm)
    return TRANSMITTED_ZERO in branches and spec.media.back == spec.media.front


def is_worth_it(spec: DeviceSpec) -> bool:
    """Tell whether a scene gains by it.

    Wavelengths that are drawn for the colours of a display are a bad choice for the room, which the
    plain order of a hologram shows. Those that are drawn for a white lamp suit the room, too.

    Args:
        spec: The document.

    Returns:
        Whether it draws wavelengths, and has a display, or a lamp of one colour, and a plain order.
    """
    if not isinstance(spec, SceneSpec) or spec.render.mode != "spectral":
        return False
    if "all" in spec.render.effects or spec.render.wavelengths != "spectrum":
        return False
    coloured = any(
        isinstance(each, DisplayElement)
        or (isinstance(each, LampElement) and not isinstance(each.spectrum, IlluminantSpec))
        for each in spec.elements
    )
    return coloured and any(is_plain(each) for each in _holograms(spec).values())


def used_primaries(element: DisplayElement) -> tuple[float, float, float]:
    """Which primaries the picture of a display has any of: 1 or 0 for red, green and blue."""
    used = USED_PRIMARIES.get(element.display.image, (0, 1, 2))
    red, green, blue = (float(place in used) for place in range(3))
    return red, green, blue


def count_after_diffraction(
    scene: bpy.types.Scene,
    spec: SceneSpec,
    spectral: SpectralScene,
    elements: Mapping[str, bpy.types.Object],
) -> None:
    """Move the eye's response from the camera to the light sources of a scene.

    Light sources that are added later have to get it too, or they are seen without colours in the
    diffracted orders.

    Args:
        scene: A whole scene, with its eye and its room.
        spec: The document of its elements.
        spectral: Its sampled spectrum.
        elements: Objects of its elements by their name.
    """
    _add_response(spectral)
    for material in _materials(scene):
        _specialise_material(material, spectral)
    for name, hologram in _holograms(spec).items():
        if is_plain(hologram):
            _make_plain(elements[name])
    lights = {item.data for item in scene.objects if isinstance(item.data, bpy.types.Light)}
    for light in lights:
        _respond(_white_tree(light), "ShaderNodeEmission", spectral)
    if scene.world is not None and scene.world.node_tree is not None:
        _respond(scene.world.node_tree, "ShaderNodeBackground", spectral)
    settings = scene.cycles
    # Order 0 counts as a bounce now: as many as before stay free of Russian roulette.
    settings.min_light_bounces = 1
    settings.max_bounces = max(settings.max_bounces, spec.render.max_bounces)
    settings.transmission_bounces = max(settings.transmission_bounces, spec.render.max_bounces)
    settings.caustics_refractive = True


def _holograms(spec: SceneSpec) -> Mapping[str, HologramSpec]:
    return {each.name: each.hologram for each in spec.elements if isinstance(each, HologramElement)}


def _add_response(spectral: SpectralScene) -> None:
    """Give the group of the wavelength a second output."""
    group = spectral.group
    group.interface.new_socket(_RESPONSE, in_out="OUTPUT", socket_type="NodeSocketVector")
    output = next(node for node in group.nodes if node.bl_idname == "NodeGroupOutput")
    source = response_shader(spectral.tables.filter_rgb, len(spectral.samplings))
    node = nodes.add_script_node(group, source, {})
    node.location = (-300.0, -300.0)
    group.links.new(nodes.output_socket(node, "response"), output.inputs[_RESPONSE])


def _materials(scene: bpy.types.Scene) -> Iterator[bpy.types.Material]:
    slots = (slot for item in scene.objects for slot in item.material_slots)
    yield from {slot.material for slot in slots if slot.material is not None}


def _specialise_material(material: bpy.types.Material, spectral: SpectralScene) -> None:
    tree = nodes.tree_of(material)
    for node in [each for each in tree.nodes if each.bl_idname == "ShaderNodeScript"]:
        if node.label in ("hoe display", "hoe spectral filter"):
            nodes.set_script(node, defining(_source(node), _AT_LIGHTS))
        if node.label == "hoe display":
            response = _response(tree, spectral)
            tree.links.new(response, nodes.input_socket(node, "response"))
    _respond(tree, "ShaderNodeEmission", spectral)


def _make_plain(item: bpy.types.Object) -> None:
    node = nodes.script_node(item.active_material)
    nodes.set_script(node, defining(_source(node), "HOE_PLAIN"))
    # Cycles counts portals only where a material has Blender's own node for them; no face has this
    # material.
    counter = bpy.data.materials.new("Portal Counter")
    tree = nodes.new_tree(counter)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    portal = tree.nodes.new("ShaderNodeBsdfRayPortal")
    tree.links.new(portal.outputs[0], output.inputs["Surface"])
    assert isinstance(item.data, bpy.types.Mesh)
    item.data.materials.append(counter)


def _white_tree(light: bpy.types.Light) -> bpy.types.NodeTree:
    """The nodes of a light, made to give what it gives without them."""
    tree = nodes.new_tree(light)
    output = tree.nodes.new("ShaderNodeOutputLight")
    glow = tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    glow.inputs["Strength"].default_value = 1.0
    tree.links.new(glow.outputs["Emission"], output.inputs["Surface"])
    return tree


def _respond(tree: bpy.types.NodeTree, kind: str, spectral: SpectralScene) -> None:
    """Multiply the colour of all sources of light in a tree with the response."""
    for node in [each for each in tree.nodes if each.bl_idname == kind]:
        colour = node.inputs["Color"]
        product = tree.nodes.new("ShaderNodeVectorMath")
        product.operation = "MULTIPLY"
        if colour.links:
            tree.links.new(colour.links[0].from_socket, product.inputs[0])
        else:
            product.inputs[0].default_value = tuple(colour.default_value)[:3]
        tree.links.new(_response(tree, spectral), product.inputs[1])
        tree.links.new(product.outputs[0], colour)


def _response(tree: bpy.types.NodeTree, spectral: SpectralScene) -> bpy.types.NodeSocket:
    source = tree.nodes.new("ShaderNodeGroup")
    source.node_tree = spectral.group
    source.location = (-560.0, -300.0)
    return source.outputs[_RESPONSE]


def _source(node: bpy.types.Node) -> ShaderSource:
    name = node.label.replace(" ", "_")
    return ShaderSource(name, node.script.as_string())
