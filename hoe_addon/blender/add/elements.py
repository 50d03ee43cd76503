# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What all single elements have in common: the document that they go into, and their place.

The first element makes a scene one that holds a document. Without an eye all paths have the one
wavelength of the preview; with an eye each draws its own.
"""

import json
import math
from collections.abc import Sequence
from typing import Any

import bpy
from mathutils import Matrix

from ...core.errors import HoeError
from ...core.spectrum import Spectrum
from ...model.device_parts import RenderSpec, RoomSpec
from ...model.document import to_document
from ...model.scene_parts import ElementSpec
from ..build.lights import EMITTERS
from ..build.stage import add_room, device_root
from ..document import live
from ..document.elements import rank_of
from ..document.gone import clear_gone, is_gone
from ..document.holding import hold_element
from ..document.places import is_in
from ..ids import DeviceKind, Mode, Role
from ..pictures.render_settings import set_up
from ..props import changes
from ..props.device import VERSION
from ..props.values import number
from ..shaders.spectral import SpectralScene, rendered_spectrum
from ..units import scale_of, units_per_mm


def begin(scene: bpy.types.Scene) -> None:
    """Let a scene hold a document, if it holds none.

    Args:
        scene: The scene; ``leaving.guest_of`` keeps what is the user's.

    Raises:
        MissingOslError: This Blender, or the scene's device, cannot run OSL.
    """
    clear_gone(scene)
    held = scene.hologram
    if held.kind == DeviceKind.NONE:
        with changes.unmarked():
            held.version, held.kind = VERSION, DeviceKind.SCENE
            held.render.mode = Mode.PREVIEW
        settings = scene.cycles
        set_up(
            scene,
            samples=settings.samples,
            seed=settings.seed,
            spectral=False,
            max_bounces=held.render.max_bounces,
        )
        groups = scene.view_layers[0].lightgroups
        if EMITTERS not in {group.name for group in groups}:
            groups.add(name=EMITTERS)
        held.wavelength = spectrum(scene).group
        held.room.collection = add_room(scene, RoomSpec(kind="none", luminance_cd_m2=0.0), 1.0)
    root = held.root
    if root is None or not is_in(scene, root):
        held.root = device_root(scene.collection, units_per_mm(scene))
        held.root.hologram.role = Role.ROOT


def spectrum(
    scene: bpy.types.Scene, spectra: Sequence[Spectrum] = (), weights: Sequence[float] = ()
) -> SpectralScene:
    """The sampled spectrum of some lights alone, with the scene's node group.

    Args:
        scene: A scene that holds a document, or begins to.
        spectra: The lights.
        weights: How often each is drawn.

    Returns:
        The spectrum.
    """
    held = scene.hologram.render
    render = RenderSpec(
        mode=held.mode,
        preview_wavelength_nm=number(held, "preview_wavelength_nm"),
        spectrum_floor=number(held, "spectrum_floor"),
    )
    return rendered_spectrum(render, spectra, weights, scene.hologram.wavelength)


def luminance_per_unit(scene: bpy.types.Scene) -> float:
    """Luminance that the scene-linear value 1 stands for, cd/m^2."""
    return number(scene.hologram.render, "luminance_per_unit_cd_m2")


def upright(location: Sequence[float] = (0.0, 0.0, 0.0)) -> Matrix:
    """The place of an element that stands upright, its front (z > 0) toward -y of the world.

    Args:
        location: Where, in scene units.

    Returns:
        Its matrix.
    """
    return Matrix.Translation(location) @ Matrix.Rotation(math.radians(90.0), 4, "X")


def put(
    scene: bpy.types.Scene,
    item: bpy.types.Object,
    matrix: Matrix | None,
    collection: bpy.types.Collection | None = None,
) -> None:
    """Put an object to its place; it hangs on the scene's device.

    Args:
        scene: A scene that holds a document.
        item: The object; it may be linked somewhere already.
        matrix: Where, in the world, in scene units; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.
    """
    wanted = collection or scene.collection
    for part in (item, *item.children_recursive):
        for other in part.users_collection:
            if other != wanted:
                other.objects.unlink(part)
        if part.name not in wanted.objects:
            wanted.objects.link(part)
    for layer in scene.view_layers:
        layer.update()
    root = scene.hologram.root
    item.parent = root
    item.matrix_parent_inverse = root.matrix_world.inverted_safe()
    size = Matrix.Scale(scale_of(root), 4)
    item.matrix_basis = (matrix if matrix is not None else upright()) @ size


def join(scene: bpy.types.Scene, item: bpy.types.Object, element: ElementSpec) -> None:
    """Make an object part of the scene's document, and bring the scene up to date.

    Args:
        scene: A scene that holds a document of elements.
        item: The object.
        element: What it is.
    """
    if scene.hologram.kind == DeviceKind.SCENE:
        hold_element(item, to_document(element), item.name, rank_of(scene, item))
    settle(scene)


def call(item: bpy.types.Object, role: Role, **facts: Any) -> None:
    """Say what an object is that documents have no words for.

    Args:
        item: The object.
        role: What it is.
        facts: Plain data to remember with it.
    """
    with changes.unmarked():
        item.hologram.role = role
        item.hologram.details = json.dumps(facts)


def facts_of(item: bpy.types.Object) -> dict[str, Any]:
    """Plain data that ``call`` has put to an object."""
    try:
        found = json.loads(item.hologram.details or "{}")
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def has_eye(scene: bpy.types.Scene) -> bool:
    """Tell whether the eye of a scene's document is there."""
    camera = scene.hologram.eye.camera
    return camera is not None and is_in(scene, camera)


def settle(scene: bpy.types.Scene) -> None:
    """Bring a scene up to date after something was added."""
    used = [image for image in bpy.data.images if image.users]
    live.settle(scene)
    # A picture that was made anew; a test chart has 30 MB.
    bpy.data.batch_remove([image for image in used if not image.users])


def refuse_light_guide(scene: bpy.types.Scene, what: str) -> None:
    """Refuse an element where the scene's document has no place for it.

    Args:
        scene: The scene.
        what: The element, in words.

    Raises:
        HoeError: The scene holds a light guide.
    """
    if scene.hologram.kind == DeviceKind.LIGHT_GUIDE and not is_gone(scene):
        raise HoeError(
            f"scene {scene.name}: holds a light guide, which has {what} of its own; "
            "use a scene without one"
        )


def new_sampling(scene: bpy.types.Scene) -> SpectralScene:
    """Exchange the node group of the wavelength for one that goes with the mode of now.

    Args:
        scene: A scene that holds a document.

    Returns:
        The sampling, without the light of any element; `settle` puts that in.
    """
    held = scene.hologram
    old, held.wavelength = held.wavelength, None
    made = spectrum(scene)
    held.wavelength = made.group
    if old is not None:
        old.user_remap(made.group)
        bpy.data.node_groups.remove(old)
    return made


def own_mesh(item: bpy.types.Object, *roles: Role) -> bpy.types.Mesh:
    """The mesh of an object of the user's, or refuse it.

    Args:
        item: The object.
        roles: What it may be already, beside nothing.

    Returns:
        Its mesh, which may be written.

    Raises:
        HoeError: It is no mesh, comes from another file, or is part of a device.
    """
    mesh = item.data
    if not isinstance(mesh, bpy.types.Mesh):
        raise HoeError(f"object {item.name}: must be a mesh; convert it (Object > Convert > Mesh)")
    for block in (item, mesh):
        if block.library is not None:
            raise HoeError(
                f"{block.name}: comes from another file; make it local first "
                "(Object > Relations > Make Local)"
            )
    if item.hologram.role not in (Role.NONE, *roles):
        role = Role(item.hologram.role).label.lower()
        raise HoeError(f"object {item.name}: is a {role} already; choose another one")
    return mesh
