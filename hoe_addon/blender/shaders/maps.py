# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V in materials: a node finds the place, an Image Texture looks the gradient up.

Cycles' cubic interpolation is the B-spline that the map holds the coefficients of.
"""

from dataclasses import dataclass
from pathlib import Path

import bpy

from ...core.errors import HoeError
from ...core.gradient_map import GradientMap, Progress
from ...core.units import m_to_mm
from ...files import replacing
from ...model.hologram import HologramSpec
from ...model.map_cache import cache_folder, map_path
from ...model.maps import MapRequest, map_file
from ...shading.hologram import Frame
from ...shading.map import GRADIENT_SOCKET, RECORDED_SOCKET, coordinates_shader
from ...shading.part import SocketValues
from ...shading.pattern import Followed, pattern_part
from ...shading.surface import surface_part
from ..paths import own_folder
from . import nodes

_COORDINATES, MAP_NODE = "Map Coordinates", "Map"
"""Names of the two nodes."""

_KEY = "hoe_map"
"""Custom property of an image: the hash of what its map was made from."""


@dataclass(frozen=True)
class PreparedMap:
    """A map that is ready in its file.

    Attributes:
        path: The file.
        key: Hash of what it was made from.
        map: What is in it.
    """

    path: Path
    key: str
    map: GradientMap


def prepare_map(
    spec: HologramSpec,
    followed: Followed | None = None,
    progress: Progress | None = None,
    *,
    make: bool = True,
) -> PreparedMap | None:
    """Make sure of the map of a hologram, before anything in the scene is changed.

    Args:
        spec: The hologram.
        followed: Waves of its recording that follow an object; these need no map.
        progress: Told the share that is done while the map is made; what it raises, such as
            `CancelledError`, stops the work.
        make: Whether to make the map where it is not in the cache.

    Returns:
        The map from the cache, or made now, which may take seconds; None where every term of the
        pattern has a formula.

    Raises:
        NotMadeError: It is not in the cache, and is not to be made.
        HoeError: The map can not be made or written.
    """
    source = pattern_part(spec.pattern, 1.0, followed).map
    if not source.terms:
        return None
    request = MapRequest(source, spec.surface, spec.pattern.wavelength_nm)
    path, made = map_file(request, own_folder(), progress, make=make)
    return PreparedMap(path, request.key, made)


def update_map(
    material: bpy.types.Material,
    spec: HologramSpec,
    frame: Frame | None = None,
    units_per_mm: float = 1.0,
    followed: Followed | None = None,
    *,
    pack: bool = True,
    progress: Progress | None = None,
) -> GradientMap | None:
    """Give a hologram's material the map that its pattern needs, or take it away.

    The map is that of `prepare_map`. An image that no material uses any more is removed.

    Args:
        material: The material, whose hologram shader is that of ``spec``.
        spec: The hologram.
        frame: Where its recording's frame lies in the object; by default it is the object's own.
        units_per_mm: Scene units in one mm.
        followed: Waves of its recording that follow an object; these need no map.
        pack: Keep the map inside the .blend, so that it renders elsewhere; else the image stays
            in the file of the cache.
        progress: Told the share that is done while the map is made; what it raises, such as
            `CancelledError`, stops the work and leaves the material as it was.

    Returns:
        The map, or None where every term has a formula.

    Raises:
        HoeError: The map can not be made or written.
    """
    prepared = prepare_map(spec, followed, progress)
    if prepared is None:
        remove_map(material)
        return None
    image = _image(prepared.path, prepared.key, pack=pack)
    values = _sockets(spec, prepared.map, frame or Frame(), units_per_mm)
    _attach(material, spec, image, values)
    return prepared.map


def is_packed(material: bpy.types.Material) -> bool:
    """Tell whether the map of a material is inside the .blend.

    Args:
        material: The material.

    Returns:
        False if its image stays in the file of the cache; True otherwise, as for a new map.
    """
    image = map_image(material)
    return image is None or image.packed_file is not None


def map_image(material: bpy.types.Material) -> bpy.types.Image | None:
    """Find the image of the map of a material.

    Args:
        material: Any material.

    Returns:
        The image, or None.
    """
    texture = material.node_tree.nodes.get(MAP_NODE) if material.node_tree else None
    image = getattr(texture, "image", None)
    return image if image is not None and _KEY in image.keys() else None  # noqa: SIM118


def keep_packed(material: bpy.types.Material) -> None:
    """Put the packed map of a material into the cache, where it is missing: made elsewhere.

    Args:
        material: Any material.
    """
    image = map_image(material)
    if image is None or image.packed_file is None or image.packed_file.size == 0:
        return
    path = map_path(cache_folder(own_folder()), str(image[_KEY]))
    if not path.is_file():
        with replacing(path) as part:
            part.write_bytes(image.packed_file.data)


def remove_map(material: bpy.types.Material) -> None:
    """Take the map out of a material, with its image where nothing else uses it.

    Args:
        material: The material, with a map or without.
    """
    tree = nodes.tree_of(material)
    texture = tree.nodes.get(MAP_NODE)
    image = None if texture is None else texture.image
    for name in (MAP_NODE, _COORDINATES):
        node = tree.nodes.get(name)
        if node is not None:
            script = getattr(node, "script", None)
            tree.nodes.remove(node)
            _drop_unused(bpy.data.texts, script)
    _drop_unused(bpy.data.images, image)


def _image(path: Path, key: str, *, pack: bool) -> bpy.types.Image:
    """The image of a map: one that is there already, or the file, packed when asked."""
    for image in bpy.data.images:
        if image.get(_KEY) == key and (image.packed_file is not None) == pack:
            if not pack:
                # Its file may have been made anew.
                image.filepath = str(path)
                image.reload()
            return image
    image = bpy.data.images.load(str(path))
    image.name = MAP_NODE
    image[_KEY] = key
    image.colorspace_settings.name = "Non-Color"
    # Alpha says what is recorded; it is no cover for the colours.
    image.alpha_mode = "CHANNEL_PACKED"
    if pack:
        image.pack()
        if image.packed_file is None:
            raise HoeError(f"{path}: cannot be packed into the .blend")
    return image


def _sockets(
    spec: HologramSpec, made: GradientMap, frame: Frame, units_per_mm: float
) -> SocketValues:
    scale = m_to_mm(units_per_mm)
    return {
        "frame_origin": frame.origin,
        "frame_x": frame.x,
        "frame_y": frame.y,
        "map_corner": (made.corner[0] * scale, made.corner[1] * scale, 0.0),
        "map_extent": (made.extent[0] * scale, made.extent[1] * scale, 0.0),
        **surface_part(spec.surface, units_per_mm).sockets,
    }


def _attach(
    material: bpy.types.Material,
    spec: HologramSpec,
    image: bpy.types.Image,
    values: SocketValues,
) -> None:
    tree = nodes.tree_of(material)
    hologram = next(
        node for node in tree.nodes if GRADIENT_SOCKET in {s.identifier for s in node.inputs}
    )
    before = getattr(tree.nodes.get(MAP_NODE), "image", None)
    coordinates = _coordinates(tree, spec)
    nodes.set_values(coordinates, values)
    texture = tree.nodes.get(MAP_NODE)
    if texture is None:
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.name = texture.label = MAP_NODE
        texture.interpolation = "Cubic"
        texture.extension = "EXTEND"
        texture.location = (-640.0, -300.0)
    texture.image = image
    link = tree.links.new
    link(nodes.output_socket(coordinates, "coordinates"), texture.inputs["Vector"])
    link(texture.outputs["Color"], nodes.input_socket(hologram, GRADIENT_SOCKET))
    link(texture.outputs["Alpha"], nodes.input_socket(hologram, RECORDED_SOCKET))
    if before != image:
        _drop_unused(bpy.data.images, before)


def _coordinates(tree: bpy.types.NodeTree, spec: HologramSpec) -> bpy.types.Node:
    """The node that finds the place on the map, with the shader for the element's surface."""
    shader = coordinates_shader(spec.surface)
    node = tree.nodes.get(_COORDINATES)
    if node is None:
        node = nodes.add_script_node(tree, shader, {})
        node.name = _COORDINATES
        node.location = (-900.0, -300.0)
        return node
    before = node.script
    nodes.set_script(node, shader)
    if node.script != before:
        _drop_unused(bpy.data.texts, before)
    return node


def _drop_unused(
    collection: bpy.types.BlendDataImages | bpy.types.BlendDataTexts, item: bpy.types.ID | None
) -> None:
    # A fake user, which texts have by themselves, is none.
    if item is not None and item.library is None and item.users <= int(item.use_fake_user):
        collection.remove(item)
