# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a device made anew, in place of those that are there."""

from collections.abc import Sequence
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
from ..build.stage import add_room
from ..ids import Role, Shape
from ..pictures.render_settings import set_path_lengths
from ..props.sync import refresh
from ..props.values import store
from ..shaders import nodes
from ..units import scale_of
from . import resample
from .held import hologram_slot, spectrum_of


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
            _remove(screen)
        return
    if not screens:
        spectral = spectrum_of(spec, scene.hologram.wavelength)
        screen = add_filter(_collection_of(scene, camera), camera, spec.eye, spectral)
        screen.hologram.role = Role.FILTER
    for screen in screens:
        _swap_mesh(screen, filter_mesh(spec.eye))


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
    nodes.set_values(nodes.script_node(bare), values)
    rim = plate.material_slots[FIRST_PATCH - 1].material
    _swap_mesh(
        plate,
        guide_mesh(spec.guide, spec.holograms),
        (bare, rim, *(patch.material for patch in held.patches)),
    )
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
    for child in [each for each in mount.children if each.hologram.role == Role.PART]:
        _remove(child)
    mount.location = engine_place(spec)
    spectral = spectrum_of(spec, scene.hologram.wavelength)
    kept = set(mount.children)
    held.panel = add_engine(_collection_of(scene, mount), spec, Path(), spectral, mount)
    for child in set(mount.children) - kept:
        child.hologram.role = Role.PART


def room(scene: bpy.types.Scene, spec: DeviceSpec) -> None:
    """Make the room anew."""
    held = scene.hologram.room
    old = held.collection
    if old is not None:
        for item in list(old.all_objects):
            _remove(item)
        for part in [*old.children_recursive, old]:
            bpy.data.collections.remove(part)
    if held.world is not None and scene.world == held.world:
        scene.world = None
    before = scene.world
    unit, size = spec.render.luminance_per_unit_cd_m2, scale_of(scene.hologram.root)
    held.collection = add_room(scene, spec.room, unit, size)
    held.world = scene.world if scene.world != before else None


def hologram_mesh(scene: bpy.types.Scene, spec: DeviceSpec, item: bpy.types.Object) -> None:
    """Make the mesh of a hologram anew, unless the mesh is the user's own."""
    assert isinstance(spec, SceneSpec)
    material = hologram_slot(item)
    if material is None or material.hologram.surface.shape == Shape.MESH:
        return
    made, _ = element_datablock(spec.hologram(item.name).hologram)
    _swap_mesh(item, made, tuple(slot.material for slot in item.material_slots))


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
    for child in [each for each in item.children if each.hologram.role == Role.PART]:
        _remove(child)
    for child in made.children:
        child.parent = item
        child.hologram.role = Role.PART
    old, item.data = item.data, made.data
    bpy.data.objects.remove(made)
    _drop_mesh(old)


def luminance(item: bpy.types.Object, white: float) -> None:
    """Set how bright a display or a lamp is, in scene units."""
    material = resample.own_material(item)
    socket = nodes.input_socket(nodes.script_node(material), "white_luminance")
    socket.default_value = white


def _swap_mesh(
    item: bpy.types.Object,
    mesh: bpy.types.Mesh,
    materials: Sequence[bpy.types.Material | None] | None = None,
) -> None:
    """Give an object another mesh, with its materials or those given, and drop the old one."""
    old = item.data
    if materials is None:
        materials = tuple(slot.material for slot in item.material_slots)
    # Clearing the list would send all faces to the first slot.
    for place, material in enumerate(materials):
        if place < len(mesh.materials):
            mesh.materials[place] = material
        else:
            mesh.materials.append(material)
    name, item.data = old.name, mesh
    _drop_mesh(old)
    mesh.name = name


def _drop_mesh(mesh: bpy.types.Mesh) -> None:
    """Remove a mesh that nothing uses any more, with materials that only it had."""
    if mesh.users > int(mesh.use_fake_user):
        return
    materials = [material for material in mesh.materials if material is not None]
    bpy.data.meshes.remove(mesh)
    for material in materials:
        if material.users == int(material.use_fake_user):
            bpy.data.materials.remove(material)


def _remove(item: bpy.types.Object) -> None:
    """Remove an object with its parts, and what only it had."""
    for child in item.children_recursive:
        bpy.data.objects.remove(child)
    mesh = item.data if isinstance(item.data, bpy.types.Mesh) else None
    bpy.data.objects.remove(item)
    if mesh is not None:
        _drop_mesh(mesh)


def _collection_of(scene: bpy.types.Scene, item: bpy.types.Object) -> bpy.types.Collection:
    """The collection of a scene that holds an object."""
    for collection in (scene.collection, *scene.collection.children_recursive):
        if item.name in collection.objects:
            return collection
    return scene.collection
