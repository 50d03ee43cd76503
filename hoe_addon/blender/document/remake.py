# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a device made anew, in place of those that are there."""

from pathlib import Path

import bpy

from ...model.device import DeviceSpec, LightGuideSpec
from ...model.document import to_document
from ...model.scene import SceneSpec
from ...shading.medium import medium_sockets
from ..build.device import add_engine, engine_place
from ..build.element import element_datablock
from ..build.eye import add_filter, filter_mesh, set_pupil
from ..build.guide import FIRST_PATCH, guide_mesh, patch_frame
from ..build.scene import add_element, element_spectra
from ..build.stage import add_room, new_collection
from ..ids import Role, Shape
from ..marks import is_made
from ..pictures.render_settings import set_path_lengths
from ..props.sync import refresh
from ..props.values import store
from ..shaders import nodes
from ..units import scale_of
from . import exchange, resample
from .elements import face_of, hologram_slot
from .held import spectrum_of
from .holding import hold_room


def settings(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Set the length of paths, and whether ray time carries the wavelength."""
    set_path_lengths(scene, spec.render.max_bounces)
    scene.render.use_motion_blur = spec.render.mode == "spectral"


def spectrum(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Draw the wavelengths of a scene for the lights that it has now."""
    resample.resample(scene, spec, spectrum_of(spec))


def preview(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Set the wavelength of the viewport."""
    resample.set_preview(scene.hologram.wavelength, spec.render.preview_wavelength_nm)


def eye(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Set pupil, focus and field of the eye, and put its filter there or take it away."""
    camera = scene.hologram.eye.camera
    if camera is None:
        return
    pupil(scene, spec)
    screens = [child for child in camera.children if child.hologram.role == Role.FILTER]
    if spec.render.mode != "spectral":
        for screen in screens:
            exchange.remove(screen)
        return
    if not screens:
        spectral = spectrum_of(spec, scene.hologram.wavelength)
        screen = add_filter(_collection_of(scene, camera), camera, spec.eye, spectral)
        screen.hologram.role = Role.FILTER
    for screen in screens:
        exchange.exchange_mesh(screen, filter_mesh(spec.eye))


def pupil(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Set pupil, focus and field of the eye at the size that it has in the scene."""
    camera = scene.hologram.eye.camera
    if camera is not None:
        set_pupil(camera.data, spec.eye, scale_of(camera))


def guide(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Make the plate of a light guide anew, and place its holograms."""
    assert isinstance(spec, LightGuideSpec)
    held = scene.hologram
    plate = held.guide.plate
    bare = plate.material_slots[0].material
    values = medium_sockets("inside", spec.guide.medium)
    values |= medium_sockets("outside", spec.guide.outside)
    if is_made(bare):
        nodes.set_values(nodes.script_node(bare), values)
    rim = plate.material_slots[FIRST_PATCH - 1].material
    mesh = guide_mesh(spec.guide, spec.holograms)
    for material in (bare, rim, *(patch.material for patch in held.patches)):
        mesh.materials.append(material)
    exchange.put_mesh(plate, mesh)
    for entry, patch in zip(held.patches, spec.holograms, strict=True):
        _place_patch(entry.material, spec, patch.name)


def _place_patch(material: bpy.types.Material, spec: LightGuideSpec, name: str) -> None:
    patch, plate = spec.patch(name), to_document(spec.guide)
    properties, frame = material.hologram, patch_frame(spec.guide, patch)
    for field in ("origin", "x", "y"):
        store(properties.frame, field, getattr(frame, field), "frame")
    store(properties.surface, "size_mm", patch.size_mm, "surface")
    properties.media.from_document({"back": plate["medium"], "front": plate["outside"]}, "media")
    refresh(material)


def engine(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Make display, lens and housing of a light guide anew."""
    assert isinstance(spec, LightGuideSpec)
    held = scene.hologram.engine
    mount = held.mount
    mount.location = engine_place(spec)
    spectral = spectrum_of(spec, scene.hologram.wavelength)
    there = set(mount.children)
    panel = add_engine(_collection_of(scene, mount), spec, Path(), spectral, mount)
    panels = (held.panel, panel)

    def kind_of(part: bpy.types.Object) -> str:
        return "panel" if part in panels else part.data.name.partition(".")[0]

    if held.panel not in there:
        held.panel = panel
    exchange.join_parts(mount, set(mount.children) - there, kind_of)


def room(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Make the room anew; what the user put into its collection stays in it."""
    held = scene.hologram.room
    held.collection = _room_without_its_parts(scene, held.collection)
    sky = held.world
    if sky is not None and scene.world == sky:
        scene.world = None
    before = scene.world
    unit, size = spec.render.luminance_per_unit_cd_m2, scale_of(scene.hologram.root)
    made = add_room(scene, spec.room, unit, size)
    hold_room(made)
    for item in made.objects:
        held.collection.objects.link(item)
    bpy.data.collections.remove(made)
    held.world = scene.world if scene.world != before else None
    if sky is not None and before is not None:
        scene.world = before  # the user has put it in place of the sky


def _room_without_its_parts(
    scene: bpy.types.Scene, old: bpy.types.Collection | None
) -> bpy.types.Collection:
    """The collection for the room of a scene, with nothing in it but what is the user's."""
    inside = scene.collection.children_recursive
    if old is None or old not in inside:
        return new_collection(scene, "Room")
    if not _is_elsewhere(scene, old):
        for item in list(old.all_objects):
            if item.hologram.role == Role.ROOM:
                exchange.take_out(item, {old, *old.children_recursive})
        return old
    own = new_collection(scene, "Room")
    for item in old.all_objects:
        if item.hologram.role != Role.ROOM:
            own.objects.link(item)
    for parent in (scene.collection, *inside):
        if old in parent.children.values() and not _is_elsewhere(scene, parent):
            parent.children.unlink(old)
    return own


def _is_elsewhere(scene: bpy.types.Scene, collection: bpy.types.Collection) -> bool:
    """Tell whether another scene or file has a collection, so that it cannot be changed here."""
    others = [other for other in bpy.data.scenes if other != scene]
    return collection.library is not None or any(
        collection == other.hologram.room.collection
        or collection in other.collection.children_recursive
        for other in others
    )


def hologram_mesh(scene: bpy.types.Scene, spec: DeviceSpec, item: bpy.types.Object) -> None:
    """Make the mesh of a hologram anew, unless the mesh is the user's own."""
    assert isinstance(spec, SceneSpec)
    material = hologram_slot(item)
    if material is None or material.hologram.surface.shape == Shape.MESH:
        return
    made, _ = element_datablock(spec.hologram(item.name).hologram)
    exchange.exchange_mesh(item, made)


def element(scene: bpy.types.Scene, spec: DeviceSpec, item: bpy.types.Object) -> None:
    """Make the mesh, the material and the parts of another element anew."""
    assert isinstance(spec, SceneSpec)
    spectral = spectrum_of(spec, scene.hologram.wavelength)
    made = add_element(
        _collection_of(scene, item),
        spec.element(item.name),
        item.name,
        element_spectra(spec, spectral)[item.name],
        Path(),
        spec.render.luminance_per_unit_cd_m2,
    )
    exchange.join_parts(item, made.children, face_of)
    exchange.exchange_mesh(item, made.data)
    bpy.data.objects.remove(made)


def luminance(item: bpy.types.Object, white: float) -> None:
    """Set how bright a display or a lamp is, in scene units."""
    material = resample.own_material(item)
    if material is None:
        return
    socket = nodes.input_socket(nodes.script_node(material), "white_luminance")
    socket.default_value = white


def _collection_of(scene: bpy.types.Scene, item: bpy.types.Object) -> bpy.types.Collection:
    """The collection of a scene that holds an object."""
    for collection in (scene.collection, *scene.collection.children_recursive):
        if item.name in collection.objects:
            return collection
    return scene.collection
