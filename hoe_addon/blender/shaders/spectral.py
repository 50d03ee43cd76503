# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a scene samples wavelengths: the tables, and the node group that hands out the wavelength.

All materials of a scene read the wavelength from one node group, so that another sampling, or
another preview wavelength, is one change in one place.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...core.arrays import FloatArray
from ...core.spectrum import Spectrum
from ...core.wavelength_sampling import SpectralTables, WavelengthSampling
from ...model.device_parts import RenderSpec
from ...model.wavelengths import samplings
from ...shading.wavelength import wavelength_shader
from . import nodes

_OUTPUT = "Wavelength"


@dataclass(frozen=True, eq=False)
class SpectralScene:
    """The sampled spectrum of one scene.

    Attributes:
        samplings: S distributions of wavelengths, with equally many nodes; the first is in use.
        tables: Their tables one behind the other, with a row of emission for each given spectrum.
        group: Node group whose output is the wavelength of the path, in nm.
        drawn: Whether each path draws its wavelength; else all have the one of the preview.
    """

    samplings: tuple[WavelengthSampling, ...]
    tables: SpectralTables
    group: bpy.types.NodeTree
    drawn: bool = True

    def preview_rgb(self, emission: FloatArray) -> FloatArray:
        """Colours of emitters as the eye sees them, for the preview.

        Args:
            emission: Rows of the tables, shape ``(P, S (K + 1))``.

        Returns:
            Linear RGB, shape ``(P, 3)``.
        """
        sampling = self.samplings[0]
        return sampling.mean_rgb(emission[:, : sampling.cells + 1])


def spectral_scene(
    sampling: WavelengthSampling,
    spectra: Sequence[Spectrum],
    preview_wavelength_nm: float,
    name: str = "Hologram Wavelength",
    *,
    drawn: bool = True,
    others: Sequence[WavelengthSampling] = (),
    group: bpy.types.NodeTree | None = None,
) -> SpectralScene:
    """Make the tables and the node group of a scene.

    Args:
        sampling: The distribution of wavelengths.
        spectra: Emitters whose emission the shaders need.
        preview_wavelength_nm: Wavelength of the one-colour preview, in nm.
        name: Name of the node group.
        drawn: Whether each path draws its wavelength; else all have that of the preview, and the
            shaders have no tables in them.
        others: Further distributions that a pass of a render may use.
        group: The node group, where it is made already.

    Returns:
        The sampled spectrum.
    """
    all_of_them = (sampling, *others)
    tables = _stacked([each.shader_tables(spectra) for each in all_of_them])
    if group is None:
        group = _group(tables, len(all_of_them), preview_wavelength_nm, name, drawn=drawn)
    return SpectralScene(all_of_them, tables, group, drawn)


def _group(
    tables: SpectralTables, samplings: int, preview_wavelength_nm: float, name: str, *, drawn: bool
) -> bpy.types.NodeTree:
    """The node group that draws a wavelength."""
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    group.interface.new_socket(_OUTPUT, in_out="OUTPUT", socket_type="NodeSocketFloat")
    output = group.nodes.new("NodeGroupOutput")
    if drawn:
        node = nodes.add_script_node(
            group,
            wavelength_shader(tables.wavelength_nm, samplings),
            {"preview_wavelength_nm": preview_wavelength_nm},
        )
        found = nodes.output_socket(node, "wavelength_nm")
    else:
        node = group.nodes.new("ShaderNodeValue")
        found = node.outputs[0]
        found.default_value = preview_wavelength_nm
    node.location = (-300.0, 0.0)
    group.links.new(found, output.inputs[_OUTPUT])
    return group


def rendered_spectrum(
    render: RenderSpec,
    spectra: Sequence[Spectrum],
    weights: Sequence[float],
    group: bpy.types.NodeTree | None = None,
) -> SpectralScene:
    """The sampled spectrum of a device or a scene, as its render settings ask for.

    Args:
        render: How the picture is made.
        spectra: Spectra of all emitters.
        weights: How often each is drawn among them.
        group: The node group, where it is made already.

    Returns:
        The sampled spectrum.
    """
    first, *others = samplings(render, spectra, weights)
    drawn = render.mode == "spectral"
    wavelength = render.preview_wavelength_nm
    return spectral_scene(first, spectra, wavelength, drawn=drawn, others=others, group=group)


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


def _stacked(tables: Sequence[SpectralTables]) -> SpectralTables:
    return SpectralTables(
        np.concatenate([each.wavelength_nm for each in tables]),
        np.concatenate([each.filter_rgb for each in tables]),
        np.concatenate([each.emission for each in tables], axis=1),
    )
