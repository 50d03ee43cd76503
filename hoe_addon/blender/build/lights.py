# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Displays and lamps of a scene: meshes that give light by the tables of their spectra."""

from pathlib import Path

import bpy
import numpy as np

from ...model.scene_parts import DisplayElement, LampElement
from ...shading.wavelength import display_shader, one_wavelength_display_shader
from ..room import shapes as shapes
from ..shaders import nodes
from ..shaders.materials import display_material
from ..shaders.spectral import SpectralScene
from ..shaders.stand_in import Look, stand_in_for
from . import meshes
from .stage import display_image

EMITTERS = "display"
"""Light group of displays and lamps; the room's own light is apart from it."""

_ROD_SIDES = 48
_BALL_RINGS = 48


def add_display(
    collection: bpy.types.Collection,
    element: DisplayElement,
    field: str,
    spectral: SpectralScene,
    folder: Path,
    luminance_per_unit: float,
) -> bpy.types.Object:
    """Add a picture that gives light to the side z > 0.

    Args:
        collection: Where it is linked.
        element: The display; its place is set by the caller.
        field: Field that names the picture, for messages.
        spectral: Sampled spectrum with the emission of its three primaries.
        folder: Folder that an image file is relative to.
        luminance_per_unit: Luminance that the scene-linear value 1 stands for, cd/m^2.

    Returns:
        The object.

    Raises:
        SpecError: The picture cannot be read.
    """
    display = element.display
    image = display_image(display.image, display.size_mm, folder, field)
    material = display_material(
        image,
        display.spectra(),
        display.white,
        display.luminance_cd_m2 / luminance_per_unit,
        spectral,
    )
    mesh = picture_mesh(element.name, display.size_mm, mirrored=element.mirrored)
    panel = meshes.add(collection, mesh, material)
    panel.lightgroup = EMITTERS
    return panel


def add_lamp(
    collection: bpy.types.Collection,
    element: LampElement,
    spectral: SpectralScene,
    luminance_per_unit: float,
) -> bpy.types.Object:
    """Add a lamp.

    Args:
        collection: Where it is linked.
        element: The lamp; its place is set by the caller.
        spectral: Sampled spectrum with the emission of its light.
        luminance_per_unit: Luminance that the scene-linear value 1 stands for, cd/m^2.

    Returns:
        The object.
    """
    item = meshes.add(collection, _lamp_mesh(element), lamp_material(element, spectral))
    socket = nodes.input_socket(nodes.script_node(item.active_material), "white_luminance")
    socket.default_value = element.luminance_cd_m2 / luminance_per_unit
    item.lightgroup = EMITTERS
    return item


def picture_mesh(
    name: str, size_mm: tuple[float, float], *, mirrored: bool = False
) -> bpy.types.Mesh:
    """A rectangle with its front to +z and a picture upright on it, mirrored or not."""
    mesh = meshes.rectangle(name, *size_mm)
    layer = mesh.uv_layers.new(name="UVMap")
    uv = np.asarray([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], dtype=np.float32)
    if mirrored:
        uv[:, 0] = 1.0 - uv[:, 0]
    layer.uv.foreach_set("vector", uv.ravel())
    return mesh


def lamp_material(element: LampElement, spectral: SpectralScene) -> bpy.types.Material:
    """The material of a lamp: a display with one primary, fully driven, of luminance 0.

    Args:
        element: The lamp.
        spectral: Sampled spectrum with the emission of its light.

    Returns:
        A new material.
    """
    emission = spectral.tables.emission[:1]
    dark = np.zeros_like(emission)
    if spectral.drawn:
        source = display_shader(np.concatenate((emission, dark, dark)), len(spectral.samplings))
    else:
        source = one_wavelength_display_shader()
    (preview,) = spectral.preview_rgb(emission).tolist()
    values: dict[str, nodes.SocketValue] = {
        "image": (1.0, 0.0, 0.0),
        "preview_red": tuple(preview),
    }
    material = nodes.script_material(element.name, source, values)
    brightest = max(preview) or 1.0
    stand_in_for(material, Look.LIGHT, colour=[max(part, 0.0) / brightest for part in preview])
    return material


def _lamp_mesh(element: LampElement) -> bpy.types.Mesh:
    width, height = element.size_mm
    match element.shape:
        case "rectangle":
            return meshes.rectangle(element.name, width, height)
        case "disc":
            mesh = meshes.disk(element.name, 1.0)
            return _scaled(mesh, (width, height, 1.0))
        case "sphere":
            angle = np.linspace(0.0, np.pi, _BALL_RINGS)
            profile = [(np.sin(a) / 2.0, -np.cos(a) / 2.0) for a in angle]
            ball = shapes.lathe(profile, _ROD_SIDES).mesh(element.name, smooth=True)
            return _scaled(ball, (width, width, height))
        case "line":
            rod = shapes.lathe([(0.0, -0.5), (0.5, -0.5), (0.5, 0.5), (0.0, 0.5)], _ROD_SIDES)
            return _scaled(rod.turned("x", -90.0).mesh(element.name), (width, height, width))


def _scaled(mesh: bpy.types.Mesh, scale: tuple[float, float, float]) -> bpy.types.Mesh:
    corners = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", corners)
    mesh.vertices.foreach_set("co", (corners.reshape(-1, 3) * np.float32(scale)).ravel())
    mesh.update()
    return mesh
