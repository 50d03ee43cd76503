# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Another sampling of wavelengths for a scene that is there already.

The node group of the wavelength, the eye's filter and all displays and lamps hold tables of the
same sampling; all are exchanged together, and whatever used them uses the new ones.
"""

import bpy

from ...model.device import DeviceSpec, LightGuideSpec
from ...model.device_parts import DisplaySpec
from ...model.scene import SceneSpec
from ...model.scene_parts import DisplayElement, LampElement
from ..build.lights import lamp_material
from ..build.scene import element_spectra
from ..ids import Role
from ..marks import is_made
from ..shaders import nodes
from ..shaders.materials import display_material, filter_material
from ..shaders.spectral import SpectralScene
from .elements import elements_by_name


def resample(scene: bpy.types.Scene, spec: DeviceSpec, spectral: SpectralScene) -> None:
    """Let a scene draw its wavelengths by another sampling.

    Args:
        scene: A scene that holds a document.
        spec: The document.
        spectral: The new sampling, with a node group that nothing uses yet, and the emission of
            all lights of the document in turn.
    """
    held = scene.hologram
    _exchange(held.wavelength, spectral.group, bpy.data.node_groups)
    held.wavelength = spectral.group
    camera = held.eye.camera
    for child in camera.children if camera is not None and spectral.drawn else ():
        if child.hologram.role == Role.FILTER:
            _exchange(child.active_material, filter_material(spectral), bpy.data.materials)
    unit = spec.render.luminance_per_unit_cd_m2
    if isinstance(spec, LightGuideSpec):
        _exchange_display(held.engine.panel, spec.display, spectral, unit)
        return
    assert isinstance(spec, SceneSpec)
    parts, items = element_spectra(spec, spectral), elements_by_name(scene)
    for element in spec.elements:
        item, part = items[element.name], parts[element.name]
        if isinstance(element, DisplayElement):
            _exchange_display(item, element.display, part, unit)
        elif isinstance(element, LampElement):
            _exchange_lamp(item, element, part, unit)


def set_preview(group: bpy.types.NodeTree, wavelength_nm: float) -> None:
    """Set the wavelength of the preview.

    Args:
        group: Node group of a sampled spectrum.
        wavelength_nm: Vacuum wavelength in nm.
    """
    for node in group.nodes:
        if node.bl_idname == "ShaderNodeScript":
            for socket in node.inputs:
                if socket.identifier == "preview_wavelength_nm":
                    socket.default_value = wavelength_nm
        elif node.bl_idname == "ShaderNodeValue":
            node.outputs[0].default_value = wavelength_nm


def own_material(item: bpy.types.Object) -> bpy.types.Material | None:
    """The material of a display or a lamp, which a duplicate shares no longer after this.

    Args:
        item: The object.

    Returns:
        The material, a copy where another object had it too; None where the user has put another
        one in its place.
    """
    if not item.material_slots:
        return None
    slot = item.material_slots[0]
    if slot.material is not None and not is_made(slot.material):
        return None
    if item.data.users > 1:
        slot.link = "OBJECT"  # one mesh, but brightness of its own
    if slot.material is None:
        slot.material = item.data.materials[0]
    if slot.material.users - int(slot.material.use_fake_user) > 1:
        slot.material = slot.material.copy()
    assert slot.material is not None
    return slot.material


def _exchange_display(
    item: bpy.types.Object, display: DisplaySpec, spectral: SpectralScene, unit: float
) -> None:
    old = own_material(item)
    if old is None:
        return
    texture = next(node for node in nodes.tree_of(old).nodes if node.type == "TEX_IMAGE")
    light = display.luminance_cd_m2 / unit
    new = display_material(texture.image, display.spectra(), display.white, light, spectral)
    _exchange(old, new, bpy.data.materials)


def _exchange_lamp(
    item: bpy.types.Object, lamp: LampElement, spectral: SpectralScene, unit: float
) -> None:
    old = own_material(item)
    if old is None:
        return
    new = lamp_material(lamp, spectral)
    _set_luminance(new, lamp.luminance_cd_m2 / unit)
    _exchange(old, new, bpy.data.materials)


def _set_luminance(material: bpy.types.Material, white: float) -> None:
    nodes.input_socket(nodes.script_node(material), "white_luminance").default_value = white


def _exchange[B: bpy.types.ID](
    old: B | None, new: B, blocks: bpy.types.bpy_prop_collection
) -> None:
    """Let all users of a datablock use another one, under the same name."""
    if old is None or old == new:
        return
    old.user_remap(new)
    name = old.name
    blocks.remove(old)
    new.name = name
