# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every kind of device needs in its scene: units, settings, collections, pictures, the room.

A document's frame (x right, y up, z toward the viewer) stands upright in the scene: the eye looks
along +y of the world, z of the world is up, and one scene unit is one millimetre.
"""

import math
from pathlib import Path

import bpy

from ...model.device_parts import BUILT_IN_IMAGES, RenderSpec, RoomSpec
from ...shading.pictures import built_in, check_picture
from ..pictures.render_settings import set_up
from ..room.backdrops import add_backdrop
from ..room.living_room import add_living_room
from ..shaders.materials import picture
from ..units import use_millimetres

_PICTURE_SIDE = 1920
_ROOM_BOUNCES = 2
_LIGHT_GROUPS = ("display", "ambient")


def prepare_scene(scene: bpy.types.Scene, settings: RenderSpec) -> None:
    """Set units, render settings, picture size and light groups of a scene.

    Args:
        scene: The scene.
        settings: How the picture is made.

    Raises:
        MissingOslError: This Blender, or the scene's device, cannot run OSL.
    """
    use_millimetres(scene)
    set_up(
        scene,
        samples=settings.samples,
        seed=settings.seed,
        spectral=settings.mode == "spectral",
        max_bounces=settings.max_bounces,
    )
    scene.render.resolution_x, scene.render.resolution_y = settings.size
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = settings.exposure_ev
    present = {group.name for group in scene.view_layers[0].lightgroups}
    for name in _LIGHT_GROUPS:
        if name not in present:
            scene.view_layers[0].lightgroups.add(name=name)


def device_root(collection: bpy.types.Collection, units_per_mm: float = 1.0) -> bpy.types.Object:
    """Add the object whose frame, with lengths in mm, is that of the document."""
    root = empty(collection, "Device", None)
    root.scale = (units_per_mm,) * 3
    root.empty_display_type = "CUBE"  # around the eye, so that none of its lines is in the view
    root.rotation_euler = (math.radians(90.0), 0.0, 0.0)
    return root


def display_image(
    image: str,
    size_mm: tuple[float, float],
    folder: Path,
    field: str,
    field_deg: tuple[float, float] | None = None,
    title: str = "HOLOGRAM",
) -> bpy.types.Image:
    """The picture of a display or a card as a packed image.

    Args:
        image: A built-in picture, a file that exists, or the name of an image that is open.
        size_mm: Width and height that it is shown with.
        folder: Folder that a file is relative to.
        field: Field of the document that names it, for messages.
        field_deg: Field that a chart is labelled for; None for no label.
        title: What a chart is headed with.

    Returns:
        The image.

    Raises:
        SpecError: The file is no picture that can be read.
    """
    if image in BUILT_IN_IMAGES:
        largest = max(size_mm)
        width, height = (max(4, round(_PICTURE_SIDE * side / largest)) for side in size_mm)
        return picture(image, built_in(image, width, height, field_deg, title))
    path = folder / image
    open_already = _open_image(image, path)
    if open_already is not None:
        return open_already
    check_picture(path, field)
    loaded = bpy.data.images.load(str(path))
    loaded.pack()
    return loaded


def _open_image(name: str, path: Path) -> bpy.types.Image | None:
    """An image of the open .blend by its name or its file: it may be painted or packed."""
    for image in bpy.data.images:
        file = bpy.path.abspath(image.filepath, library=image.library)
        if image.name == name or (file and Path(file) == path):
            return image
    return None


def add_room(
    scene: bpy.types.Scene,
    spec: RoomSpec,
    luminance_per_unit_cd_m2: float,
    units_per_mm: float = 1.0,
) -> bpy.types.Collection:
    """Add what is behind and around a device, its floor and walls about the origin of the world.

    Args:
        scene: The scene.
        spec: Which room, and how bright it is.
        luminance_per_unit_cd_m2: Luminance that the scene-linear value 1 stands for.
        units_per_mm: Scene units in one mm.

    Returns:
        The collection that holds it.
    """
    room = new_collection(scene, "Room")
    white = spec.luminance_cd_m2 / luminance_per_unit_cd_m2
    if spec.kind != "none":
        # A third bounce between the walls would add 3 % of light and a quarter of the time.
        scene.cycles.diffuse_bounces = _ROOM_BOUNCES
    if spec.kind == "living_room":
        add_living_room(room, white)
    elif spec.kind != "none":
        add_backdrop(scene, room, spec.kind, white)
    if units_per_mm != 1.0:
        _resize(room, units_per_mm)
    return room


def _resize(room: bpy.types.Collection, factor: float) -> None:
    """Make a room larger about the origin of the world, and as bright as before."""
    for item in room.all_objects:
        if item.parent is None:
            item.location *= factor
            item.scale *= factor
        light = item.data
        if isinstance(light, bpy.types.Light) and not isinstance(light, bpy.types.SunLight):
            light.energy *= factor**2
            if isinstance(light, bpy.types.PointLight):
                light.shadow_soft_size *= factor  # an area's size follows its object, this does not


def new_collection(scene: bpy.types.Scene, name: str) -> bpy.types.Collection:
    """Add a collection to a scene."""
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    return collection


def empty(
    collection: bpy.types.Collection, name: str, parent: bpy.types.Object | None
) -> bpy.types.Object:
    """Add an empty."""
    item = bpy.data.objects.new(name, None)
    item.empty_display_size = 5.0
    item.parent = parent
    collection.objects.link(item)
    return item
