# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a scene samples wavelengths: the tables, and the node group that hands out the wavelength.

All materials of a scene read the wavelength from one node group, so that another sampling, or
another preview wavelength, is one change in one place.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import bpy

from ..core.spectrum import Spectrum
from ..core.wavelength_sampling import SpectralTables, WavelengthSampling
from ..shading.wavelength import wavelength_shader
from . import nodes

_OUTPUT = "Wavelength"


@dataclass(frozen=True, eq=False)
class SpectralScene:
    """The sampled spectrum of one scene.

    Attributes:
        sampling: The distribution of wavelengths.
        tables: Its tables, with one row of emission for each given spectrum.
        group: Node group whose output is the wavelength of the path, in nm.
    """

    sampling: WavelengthSampling
    tables: SpectralTables
    group: bpy.types.NodeTree


def spectral_scene(
    sampling: WavelengthSampling,
    spectra: Sequence[Spectrum],
    preview_wavelength_nm: float,
    name: str = "Hologram Wavelength",
) -> SpectralScene:
    """Make the tables and the node group of a scene.

    Args:
        sampling: The distribution of wavelengths.
        spectra: Emitters whose emission the shaders need.
        preview_wavelength_nm: Wavelength of the one-colour preview, in nm.
        name: Name of the node group.

    Returns:
        The sampled spectrum.
    """
    tables = sampling.shader_tables(spectra)
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    group.interface.new_socket(_OUTPUT, in_out="OUTPUT", socket_type="NodeSocketFloat")
    output = group.nodes.new("NodeGroupOutput")
    node = nodes.add_script_node(
        group,
        wavelength_shader(tables.wavelength_nm),
        {"preview_wavelength_nm": preview_wavelength_nm},
    )
    node.location = (-300.0, 0.0)
    group.links.new(nodes.output_socket(node, "wavelength_nm"), output.inputs[_OUTPUT])
    return SpectralScene(sampling, tables, group)


def use_wavelength(material: bpy.types.Material, group: bpy.types.NodeTree) -> None:
    """Let every shader of a material that asks for the wavelength read it from the group.

    Args:
        material: A material with Script nodes.
        group: Node group of ``spectral_scene``.
    """
    tree = nodes.tree_of(material)
    source = tree.nodes.new("ShaderNodeGroup")
    source.node_tree = group
    source.location = (-560.0, 0.0)
    for node in tree.nodes:
        for socket in node.inputs:
            if socket.identifier == "wavelength_nm":
                tree.links.new(source.outputs[_OUTPUT], socket)
