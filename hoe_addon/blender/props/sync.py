# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Between a hologram's document, the properties of its material, and the shader in its nodes.

Properties are float32; `values` says what of a document's numbers comes back exactly.
"""

import contextlib
from collections.abc import Iterator, Mapping

import bpy

from ...core.errors import HoeError, MissingOslError, NotMadeError, SpecError
from ...model.document import hologram_from, to_document
from ...model.field_error import FieldError
from ...model.hologram import HologramSpec
from ...shading.hologram import Frame, hologram_shader, hologram_sockets
from .. import whole_undo
from ..shaders.following import Followed, drive, in_frame_of, waves_of
from ..shaders.maps import is_packed, keep_packed, prepare_map, update_map
from ..shaders.spectral import use_wavelength
from ..shaders.stand_in import Look, stand_in_for
from ..shaders.tables import prepare_table
from . import changes
from .followed import carrier_of, out_of_scene, properties_of, read_followed, read_followed_roles
from .followed import has_properties as has_properties
from .followed import read_frame as read_frame
from .made import a_wavelength, check_writable, follows_for_now, is_stale, note_made
from .shader_node import bring_up_to_date, needed_node, takes_wavelength
from .shader_node import hologram_node as hologram_node
from .values import make_whole, number, store


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
    properties = properties_of(material)
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


def read_spec(
    material: bpy.types.Material, carrier: bpy.types.Object | None = None
) -> HologramSpec:
    """Make the hologram that the properties of a material describe.

    Args:
        material: The material; its name is the name of the hologram.
        carrier: Object in whose frame a wave that follows another one is given; by default that
            of ``carrier_of``. It matters where several objects carry the material.

    Returns:
        The valid hologram. What `write_spec` wrote comes back within the limits of `values`. A
        wave that follows an object is given by where the object is now.

    Raises:
        SpecError: With the path of the field, the rule, and the value; or the material is no
            hologram; or a wave follows an object and nothing carries the hologram.
    """
    roles = read_followed_roles(material)
    if roles:
        # A script may have moved things since Blender last looked.
        bpy.context.view_layer.update()
        carrier = carrier or carrier_of(material)
        if carrier is None:
            rule = "must be off where no object carries the hologram; give its material to one"
            raise FieldError(f"recording.{roles[0]}.follows", rule, True)
    return _spec_of(material, carrier)


def _spec_of(material: bpy.types.Material, carrier: bpy.types.Object | None) -> HologramSpec:
    properties = properties_of(material)
    if not properties.enabled:
        raise SpecError(f"material {material.name}: is not a hologram")
    document = properties.to_document()
    for role, entry in read_followed(material).items():
        frame, units = read_frame(material), number(properties, "units_per_mm")
        wave = in_frame_of(entry, carrier, frame.matrix(), units)
        document["recording"][role] = to_document(wave)
    return hologram_from(document)


def refresh(
    material: bpy.types.Material,
    wavelength: bpy.types.NodeTree | None = None,
    *,
    make: bool = True,
) -> bool:
    """Make the shader of a material agree with its properties.

    As long as kinds and orders stay, only numbers are written; nothing is compiled. Else the
    shader node gets another text, and what both texts have in common keeps its links.

    Args:
        material: A hologram.
        wavelength: Node group of `spectral_scene`, for a shader node without a wavelength; by
            default that of a scene.
        make: Whether to make a map or a table that is not in the cache, which may take minutes.

    Returns:
        Whether the shader text was changed.

    Raises:
        SpecError: The properties do not make a valid hologram.
        NotMadeError: It needs a map or a table that is not to be made now.
        MissingOslError: The text would have to be compiled, and this Blender has no OSL.
        ShaderCompileError: The text does not compile.
        HoeError: The material is linked from another file; or a map that the pattern needs, or a
            table that the efficiencies need, cannot be made.
    """
    properties = properties_of(material)
    changes.forget(material)
    check_writable(material)
    make_whole(properties)
    # A script may have moved things since Blender last looked.
    if read_followed_roles(material):
        bpy.context.view_layer.update()
    with _told(material):
        changed = _write(material, material, make=make)
    group = wavelength or a_wavelength()
    if group is not None and not takes_wavelength(material):
        use_wavelength(material, group)
    return changed


def refresh_frame(material: bpy.types.Material, graph: bpy.types.Depsgraph) -> None:
    """Make the shader of an animated material agree with its properties in the current frame.

    Args:
        material: A hologram that is not linked.
        graph: What is evaluated for that frame; in a render its values are not in the material.

    Raises:
        HoeError: As ``refresh``; nothing is made that takes long.
    """
    check_writable(material)
    with _told(material):
        if _write(material, material.evaluated_get(graph), make=False):
            whole_undo.note_exchange()


def refresh_changed(_changed: frozenset[int] = frozenset()) -> None:
    """Refresh every hologram whose properties have changed; a timer does so in a window.

    What is wrong with one is kept in its ``hologram.problem``, and the others go on. In a window
    nothing is made that takes long.
    """
    for material in changes.taken(bpy.data.materials):
        _try(material, make=bpy.app.background)


def catch_up() -> None:
    """Refresh every hologram whose shader was made from other properties than it has now.

    So it is after an undo, or when a file was written by another version of the add-on.
    """
    for material in bpy.data.materials:
        if material.library is None and material.hologram.enabled and is_stale(material):
            _try(material, make=False)


def _try(material: bpy.types.Material, *, make: bool) -> None:
    if material.hologram.enabled and material.library is None:
        # What is wrong stands in the property, where a panel shows it.
        with contextlib.suppress(HoeError):
            if refresh(material, make=make):
                whole_undo.note_exchange()


def _write(material: bpy.types.Material, source: bpy.types.Material, *, make: bool) -> bool:
    """Write what the properties of ``source``, the material or its evaluated self, say."""
    # The shader knows where each object that has it stands: any of them will do here, or none.
    spec, followed = _spec_of(source, carrier_of(source)), read_followed(source)
    waves, frame = waves_of(followed), read_frame(source)
    units_per_mm = number(source.hologram, "units_per_mm")
    keep_packed(material)
    # What can fail comes first: the last good shader stays.
    prepare_map(spec, waves, make=make)
    table = prepare_table(spec, followed=waves, make=make)
    changed = bring_up_to_date(
        material,
        hologram_shader(spec, waves, table),
        hologram_sockets(spec, frame, units_per_mm, waves, table),
    )
    if source == material or changed:
        drive(needed_node(material), followed)
    update_map(material, spec, frame, units_per_mm, waves, pack=is_packed(material))
    note_made(material, source)
    return changed


@contextlib.contextmanager
def _told(material: bpy.types.Material) -> Iterator[None]:
    """Keep what goes wrong, or what a person should know, in the material's properties."""
    try:
        yield
    except HoeError as error:
        _tell(material, str(error), needs_bake=isinstance(error, NotMadeError))
        if isinstance(error, MissingOslError):
            stand_in_for(material, Look.PLATE)
        raise
    _tell(material, out_of_scene(material) or follows_for_now(material))


def _tell(material: bpy.types.Material, problem: str, *, needs_bake: bool = False) -> None:
    # Writing what is there already would have Blender evaluate the material anew.
    for field, value in (("problem", problem), ("needs_bake", needs_bake)):
        if getattr(material.hologram, field) != value:
            setattr(material.hologram, field, value)


def register() -> None:
    """Refresh holograms when their properties change."""
    changes.listen(refresh_changed)


def unregister() -> None:
    """Undo ``register``."""
    changes.stop(refresh_changed)
