# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hologram on a plate of its own, or on faces of a mesh."""

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix

from ...core.errors import HoeError
from ...model.efficiency import KinoformSpec
from ...model.hologram import HologramSpec, SideMedia
from ...model.medium import MediumRef
from ...model.recording import RecordingSpec
from ...model.scene_parts import HologramElement
from ...model.surface import PlaneSurface, SurfaceSpec
from ...model.waves import PlaneWaveSpec, PointSourceSpec
from ..build.element import hologram_element
from ..ids import Role
from ..shaders.materials import hologram_material
from . import elements
from .faces import Patch, patch_of, slot_given
from .leaving import guest_of

SIZE_MM = (40.0, 40.0)
WAVELENGTH_NM = 532.0
DISTANCE_MM = 100.0


def plain_hologram(
    surface: SurfaceSpec | None = None,
    *,
    wavelength_nm: float = WAVELENGTH_NM,
    distance_mm: float = DISTANCE_MM,
    back: MediumRef = "air",
    name: str = "Hologram",
) -> HologramSpec:
    """A hologram to begin with: a burning glass, recorded by a plane wave and one to its focus.

    Args:
        surface: Its shape; by default a square of 40 mm.
        wavelength_nm: Vacuum wavelength of the recording.
        distance_mm: Distance of the point behind that the object wave runs to.
        back: Medium behind it.
        name: Its name.

    Returns:
        The hologram, a kinoform with orders 0 and 1.
    """
    return HologramSpec(
        name=name,
        surface=surface or PlaneSurface(size_mm=SIZE_MM),
        media=SideMedia(back=back, front="air"),
        recording=RecordingSpec(
            wavelength_nm=wavelength_nm,
            object=PointSourceSpec(position_mm=(0.0, 0.0, -distance_mm), beam="converging"),
            reference=PlaneWaveSpec(direction=(0.0, 0.0, -1.0)),
        ),
        efficiency=KinoformSpec(levels=0, design_wavelength_nm=wavelength_nm, relief="PMMA"),
        orders=(0, 1),
    )


def add_hologram(
    scene: bpy.types.Scene,
    spec: HologramSpec | None = None,
    matrix: Matrix | None = None,
    collection: bpy.types.Collection | None = None,
) -> tuple[bpy.types.Object, tuple[str, ...]]:
    """Add a hologram on a new plate.

    Args:
        scene: The scene; it begins to hold a document.
        spec: The hologram; by default a lens of 40 x 40 mm.
        matrix: Where it stands, its front to +z; by default upright at the origin.
        collection: Collection that it is in; by default that of the scene.

    Returns:
        The object, and the names of the render settings that were changed.

    Raises:
        HoeError: The hologram cannot be made; nothing is left behind.
    """
    spec = spec or plain_hologram()
    with guest_of(scene) as settings:
        elements.begin(scene)
        material = hologram_material(spec, elements.spectrum(scene))
        item = hologram_element(collection or scene.collection, spec, material)
        elements.put(scene, item, matrix, collection)
        place = (0.0, 0.0, 0.0)
        elements.join(
            scene, item, HologramElement(name=item.name, position_mm=place, hologram=spec)
        )
    return item, tuple(settings)


def hologram_on_faces(
    scene: bpy.types.Scene,
    item: bpy.types.Object,
    faces: Sequence[int] | None = None,
    *,
    wavelength_nm: float = WAVELENGTH_NM,
    distance_mm: float | None = None,
) -> tuple[bpy.types.Material, tuple[str, ...]]:
    """Make faces of a mesh a hologram: a lens, its origin in their middle, its front outside.

    Where the object is a slab or a piece of glass made here, its medium is behind the hologram.

    Args:
        scene: The scene; it begins to hold a document.
        item: A mesh object of it, in object mode.
        faces: Numbers of the faces; by default all.
        wavelength_nm: Vacuum wavelength of the recording.
        distance_mm: Distance of the point behind the faces that the object wave runs to; by
            default as far for their width as on a plate of 40 mm.

    Returns:
        The material, and the names of the render settings that were changed.

    Raises:
        HoeError: The faces cannot be a hologram; nothing is changed then.
    """
    mesh = elements.own_mesh(item, Role.SLAB, Role.GLASS)
    chosen = np.arange(len(mesh.polygons)) if faces is None else np.asarray(faces, dtype=int)
    if chosen.size == 0:
        raise HoeError(f"object {item.name}: has no face selected; select faces in Edit Mode")
    with guest_of(scene) as settings, slot_given(item, chosen) as slot:
        patch = patch_of(scene, item, slot)
        elements.begin(scene)
        back = elements.facts_of(item).get("medium", "air")
        spec = plain_hologram(
            patch.surface,
            wavelength_nm=wavelength_nm,
            distance_mm=distance_mm or DISTANCE_MM * patch.width_mm / SIZE_MM[0],
            back=back,
            name=f"{item.name} Hologram",
        )
        material = hologram_material(
            spec, elements.spectrum(scene), patch.frame, patch.units_per_mm
        )
        item.material_slots[slot].material = material
        _smooth(mesh, chosen, patch)
        elements.settle(scene)
    return material, tuple(settings)


def _smooth(mesh: bpy.types.Mesh, faces: np.ndarray, patch: Patch) -> None:
    """A curved hologram takes its normal from the mesh."""
    if not patch.is_flat:
        for face in faces.tolist():
            mesh.polygons[face].use_smooth = True
        mesh.update()
