# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Between a hologram's document, the properties of its material, and the shader in its nodes.

Properties are float32; `values` says what of a document's numbers comes back exactly.
"""

import math
from collections.abc import Mapping

import bpy

from ...core.errors import HoeError, SpecError
from ...model.document import hologram_from, to_document
from ...model.field_error import FieldError
from ...model.hologram import HologramSpec
from ...model.motion import to_wave
from ...shading.following import ROLES
from ...shading.hologram import Frame, hologram_shader, hologram_sockets
from ...shading.source import ShaderSource
from .. import nodes
from ..following import Followed, drive, in_frame_of, lamp_like, waves_of
from ..ids import PatternKind, WaveKind
from ..maps import is_packed, prepare_map, update_map
from ..spectral import use_wavelength
from ..tables import prepare_table
from . import changes
from .values import number, numbers, store

_SHADER = "hoe_hologram"
_ORTHONORMAL = 1e-5
"""How far axes may be from unit length and a right angle; float32 is good to 1e-7."""


def has_properties() -> bool:
    """Whether materials have the properties of a hologram, that is, the add-on is registered."""
    return hasattr(bpy.types.Material, "hologram")


def write_spec(
    material: bpy.types.Material,
    spec: HologramSpec,
    frame: Frame | None = None,
    units_per_mm: float = 1.0,
    followed: Mapping[str, Followed] | None = None,
) -> None:
    """Write a hologram to the properties of a material; its nodes stay as they are.

    Args:
        material: The material, which keeps its name.
        spec: The hologram.
        frame: Where the recording's frame lies in the object; by default it is the object's own.
        units_per_mm: Scene units in one mm.
        followed: Waves of its recording that follow an object, by role.

    Raises:
        SpecError: A number is outside what the properties can hold.
    """
    properties = _properties(material)
    placed = frame or Frame()
    with changes.unmarked():
        properties.from_document(to_document(spec))
        for field in ("origin", "x", "y"):
            store(properties.frame, field, getattr(placed, field), "frame")
        store(properties, "units_per_mm", units_per_mm, "hologram")
        for role, entry in (followed or {}).items():
            wave = getattr(properties.recording, role)
            wave.from_document(to_document(entry.wave), f"recording.{role}")
            wave.follows, wave.target = True, entry.target
        properties.enabled = True


def read_spec(material: bpy.types.Material) -> HologramSpec:
    """Make the hologram that the properties of a material describe.

    Args:
        material: The material; its name is the name of the hologram.

    Returns:
        The valid hologram. What `write_spec` wrote comes back within the limits of `values`. A
        wave that follows an object is given by where the object is now.

    Raises:
        SpecError: With the path of the field, the rule, and the value; or the material is no
            hologram.
    """
    properties = _properties(material)
    if not properties.enabled:
        raise SpecError(f"material {material.name}: is not a hologram")
    document = properties.to_document()
    followed = read_followed(material)
    if followed:
        # A script may have moved things since Blender last looked.
        bpy.context.view_layer.update()
    for role, entry in followed.items():
        frame, units = read_frame(material), number(properties, "units_per_mm")
        wave = in_frame_of(entry, carrier_of(material), frame.matrix(), units)
        document["recording"][role] = to_document(wave)
    return hologram_from(document)


def read_followed(material: bpy.types.Material) -> dict[str, Followed]:
    """Read which waves of a hologram follow an object.

    Args:
        material: The material.

    Returns:
        Waves by role.

    Raises:
        SpecError: The object is gone, or the wave cannot follow one.
    """
    properties = _properties(material)
    found: dict[str, Followed] = {}
    if properties.pattern != PatternKind.RECORDING:
        return found
    for role in ROLES:
        group = getattr(properties.recording, role)
        if group.follows:
            found[role] = _followed(group, f"recording.{role}")
    return found


def _followed(group: bpy.types.PropertyGroup, path: str) -> Followed:
    if group.target is None:
        raise FieldError(f"{path}.target", "must be an object of the scene", None)
    if group.target.matrix_world.determinant() < 0.0:
        rule = "must not be mirrored; apply its scale, or that of its parents"
        raise FieldError(f"{path}.target", rule, group.target.name)
    if group.kind == WaveKind.SYSTEM:
        raise FieldError(f"{path}.follows", "must be off for a source behind optics", True)
    try:
        wave = to_wave(group.to_document(path))
    except FieldError as error:
        raise error.inside(path) from error
    return Followed(group.target, lamp_like(wave))


def carrier_of(material: bpy.types.Material) -> bpy.types.Object | None:
    """Find the object that carries a hologram.

    Args:
        material: The material.

    Returns:
        The first object by name whose mesh has the material, or None.
    """
    for item in bpy.data.objects:
        slots = getattr(item.data, "materials", None) or ()
        if any(slot == material for slot in slots):
            return item
    return None


def read_frame(material: bpy.types.Material) -> Frame:
    """Read where the frame of the recording lies in the object.

    Args:
        material: The material.

    Returns:
        The frame.

    Raises:
        SpecError: Its axes are not two unit vectors at a right angle.
    """
    frame = _properties(material).frame
    origin, x, y = (tuple(numbers(frame, field)) for field in ("origin", "x", "y"))
    dots = (math.sumprod(x, x) - 1.0, math.sumprod(y, y) - 1.0, math.sumprod(x, y))
    if max(map(abs, dots)) > _ORTHONORMAL:
        raise SpecError(f"frame: must have two unit axes at a right angle, got {x} and {y}")
    return Frame(origin, x, y)


def refresh(material: bpy.types.Material, wavelength: bpy.types.NodeTree | None = None) -> bool:
    """Make the shader of a material agree with its properties.

    As long as kinds and orders stay, only numbers are written; nothing is compiled. Else the
    shader node gets another text, and what both texts have in common keeps its links.

    Args:
        material: A hologram.
        wavelength: Node group of `spectral_scene`, for a shader node without a wavelength.

    Returns:
        Whether the shader text was changed.

    Raises:
        SpecError: The properties do not make a valid hologram.
        MissingOslError: The text would have to be compiled, and this Blender has no OSL.
        ShaderCompileError: The text does not compile.
        HoeError: A map that the pattern needs, or a table that the efficiencies need, cannot be
            made.
    """
    properties = _properties(material)
    changes.forget(material)
    try:
        spec = read_spec(material)
        followed = read_followed(material)
        waves = waves_of(followed)
        frame, units_per_mm = read_frame(material), number(properties, "units_per_mm")
        # What can fail comes first: the last good shader stays.
        prepare_map(spec, waves)
        table = prepare_table(spec, followed=waves)
        changed = _bring_up_to_date(
            material,
            hologram_shader(spec, waves, table),
            hologram_sockets(spec, frame, units_per_mm, waves, table),
        )
        drive(_shader_node(material), followed)
        update_map(material, spec, frame, units_per_mm, waves, pack=is_packed(material))
    except HoeError as error:
        properties.problem = str(error)
        raise
    if wavelength is not None and not _takes_wavelength(material):
        use_wavelength(material, wavelength)
    properties.problem = out_of_scene(material)
    return changed


def out_of_scene(material: bpy.types.Material) -> str:
    """Say whether a source object was deleted, or never came along with its material.

    Blender keeps a deleted object while something points to it, only in no collection. Its last
    place goes on to count.

    Args:
        material: A hologram.

    Returns:
        What is wrong, or nothing.
    """
    recording = _properties(material).recording
    for role in ROLES:
        group = getattr(recording, role)
        if group.follows and group.target is not None and not group.target.users_collection:
            name = group.target.name
            return f"recording.{role}.target: {name} is in no scene; its last place counts"
    return ""


def refresh_changed() -> None:
    """Refresh every hologram whose properties have changed; a timer does so in a window.

    What is wrong with one is kept in its ``hologram.problem``, and the others go on.
    """
    for material in changes.taken():
        if material.hologram.enabled:
            try:
                refresh(material)
            except HoeError:
                # It stands in the property, where a panel shows it.
                continue


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


def register() -> None:
    """Refresh holograms when their properties change."""
    changes.listen(refresh_changed)


def unregister() -> None:
    """Undo ``register``."""
    changes.stop()


def _properties(material: bpy.types.Material) -> bpy.types.PropertyGroup:
    if not has_properties():
        raise HoeError("materials have no hologram properties; call hoe_addon.register() first")
    return material.hologram


def _shader_node(material: bpy.types.Material) -> bpy.types.Node:
    node = hologram_node(material)
    assert node is not None
    return node


def _bring_up_to_date(
    material: bpy.types.Material, source: ShaderSource, values: dict[str, nodes.SocketValue]
) -> bool:
    node = hologram_node(material)
    if node is None:
        _add_node(material, source, values)
        return True
    before = node.script
    changed = before.name != f"{source.name}_{source.digest}.osl"
    if changed:
        drive(node, {})  # a driver of a socket that goes would stay behind
        nodes.set_script(node, source)
        _drop_unused(before)
    nodes.set_values(node, values)
    return changed


def _add_node(
    material: bpy.types.Material, source: ShaderSource, values: dict[str, nodes.SocketValue]
) -> None:
    tree = material.node_tree or nodes.new_tree(material)
    node = nodes.add_script_node(tree, source, values)
    node.location = (-300.0, 0.0)
    output = tree.get_output_node("CYCLES") or tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])


def _drop_unused(text: bpy.types.Text) -> None:
    # Else a .blend collects a text for every setting that was ever tried. A text counts itself.
    if text.library is None and text.users <= int(text.use_fake_user):
        bpy.data.texts.remove(text)


def _takes_wavelength(material: bpy.types.Material) -> bool:
    node = hologram_node(material)
    return node is not None and nodes.input_socket(node, "wavelength_nm").is_linked
