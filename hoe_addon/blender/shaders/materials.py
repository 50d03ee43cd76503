# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of optical elements."""

from collections.abc import Mapping, Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.colour import white_balance
from ...core.gradient_map import Progress
from ...core.spectrum import Spectrum
from ...model.hologram import HologramSpec
from ...model.medium import MediumRef
from ...shading.hologram import Frame, hologram_shader, hologram_sockets
from ...shading.medium import medium_sockets
from ...shading.source import specialised
from ...shading.wavelength import display_shader, filter_shader, one_wavelength_display_shader
from ..marks import mark
from ..props import sync
from ..props.made import note_made
from . import nodes
from .following import Followed, drive, waves_of
from .maps import prepare_map, update_map
from .spectral import SpectralScene, use_wavelength
from .stand_in import Look, stand_in_for
from .tables import prepare_table


def hologram_material(
    spec: HologramSpec,
    spectral: SpectralScene,
    frame: Frame | None = None,
    units_per_mm: float = 1.0,
    followed: Mapping[str, Followed] | None = None,
    *,
    pack: bool = True,
    progress: Progress | None = None,
) -> bpy.types.Material:
    """The material of a hologram; it can be edited by its properties where they are registered.

    Args:
        spec: The hologram.
        spectral: The sampled spectrum of the scene.
        frame: Where the recording's frame lies in the object; by default it is the object's own.
        units_per_mm: Scene units in one mm.
        followed: Waves of its recording that follow an object, by role (``object``,
            ``reference``); they take the place of those of ``spec``.
        pack: Keep a map that the pattern may need inside the .blend.
        progress: Told the share that is done, where such a map, or a table of efficiencies, has
            to be made.

    Returns:
        A new material.

    Raises:
        SpecError: A number is outside what the properties can hold.
        HoeError: A map that the pattern needs, or a table that the efficiencies need, cannot be
            made; nothing is left behind.
    """
    sources = followed or {}
    waves = waves_of(sources)
    prepare_map(spec, waves, progress)
    table = prepare_table(spec, progress, followed=waves)
    values = hologram_sockets(spec, frame or Frame(), units_per_mm, waves, table)
    material = nodes.script_material(spec.name, hologram_shader(spec, waves, table), values)
    use_wavelength(material, spectral.group)
    stand_in_for(material, Look.PLATE)
    drive(nodes.script_node(material), sources)
    update_map(material, spec, frame, units_per_mm, waves, pack=pack)
    if sync.has_properties():
        sync.write_spec(material, spec, frame, units_per_mm, sources)
        note_made(material, material)
    return material


def dielectric_material(
    name: str,
    inside: MediumRef,
    outside: MediumRef,
    spectral: SpectralScene,
    flat_normal: Sequence[float] | None = None,
) -> bpy.types.Material:
    """The boundary of a dispersive body; the normals of its mesh point outward.

    Args:
        name: Name of the material.
        inside: Medium behind the normals.
        outside: Medium before them.
        spectral: The sampled spectrum of the scene.
        flat_normal: Unit normal, in object space, of all faces that have it, where these are
            planes: more exact than that of a mesh far from the world's origin.

    Returns:
        A new material.
    """
    values = medium_sockets("inside", inside) | medium_sockets("outside", outside)
    if flat_normal is not None:
        values["flat_normal"] = tuple(flat_normal)
    material = nodes.script_material(name, specialised("hoe_dielectric", {}), values)
    use_wavelength(material, spectral.group)
    stand_in_for(material, Look.GLASS)
    return material


def thin_lens_material(focal_length: float) -> bpy.types.Material:
    """An ideal thin lens in the plane z = 0 of its object.

    Args:
        focal_length: In scene units.

    Returns:
        A new material.
    """
    values = {"focal_length": focal_length}
    material = nodes.script_material("Ideal Lens", specialised("hoe_thin_lens", {}), values)
    stand_in_for(material, Look.LENS)
    return material


def display_material(
    image: bpy.types.Image,
    primaries: tuple[Spectrum, Spectrum, Spectrum],
    white: str,
    luminance: float,
    spectral: SpectralScene,
) -> bpy.types.Material:
    """A picture that gives light, on the front of its mesh, by its UV map.

    Args:
        image: Its colours are the drives of the primaries.
        primaries: Spectra of red, green and blue, the first three emitters of ``spectral``.
        white: White point that full drives give.
        luminance: Luminance of white in scene units.
        spectral: The sampled spectrum of the scene.

    Returns:
        A new material.

    Raises:
        SpecError: The white lies outside what the primaries can mix.
    """
    shares = white_balance(primaries, white)
    preview = spectral.preview_rgb(spectral.tables.emission[:3]) * shares[:, None]
    values: dict[str, nodes.SocketValue] = {
        f"preview_{name}": tuple(rgb)
        for name, rgb in zip(("red", "green", "blue"), preview.tolist(), strict=True)
    }
    values["white_luminance"] = luminance
    if spectral.drawn:
        source = display_shader(
            spectral.tables.emission[:3] * shares[:, None], len(spectral.samplings)
        )
    else:
        source = one_wavelength_display_shader()
    material = nodes.script_material("Display", source, values)
    tree = nodes.tree_of(material)
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    texture.interpolation = "Linear"
    texture.extension = "CLIP"
    texture.location = (-640.0, 0.0)
    display = nodes.script_node(material)
    tree.links.new(texture.outputs["Color"], nodes.input_socket(display, "image"))
    stand_in_for(material, Look.LIGHT, image=texture.outputs["Color"])
    return material


def filter_material(spectral: SpectralScene) -> bpy.types.Material:
    """The eye's response, for the surface in front of the camera."""
    source = filter_shader(spectral.tables.filter_rgb, len(spectral.samplings))
    material = nodes.script_material("Spectral Filter", source, {})
    stand_in_for(material, Look.NOTHING)
    return material


def absorber_material(name: str = "Black") -> bpy.types.Material:
    """A perfectly black surface."""
    material = mark(bpy.data.materials.new(name))
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    black = tree.nodes.new("ShaderNodeBsdfDiffuse")
    black.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    tree.links.new(black.outputs["BSDF"], output.inputs["Surface"])
    return material


def picture(name: str, pixels: NDArray[np.float32]) -> bpy.types.Image:
    """A packed image of linear drive values.

    Args:
        name: Name of the datablock.
        pixels: Values 0 to 1, shape ``(height, width, 3)``, top row first.

    Returns:
        The image; it travels inside the .blend.
    """
    height, width, _ = pixels.shape
    image = bpy.data.images.new(name, width, height, float_buffer=True, is_data=True)
    rgba = np.ones((height, width, 4), dtype=np.float32)
    rgba[..., :3] = pixels[::-1]
    image.pixels.foreach_set(rgba.ravel())
    image.pack()
    return image
