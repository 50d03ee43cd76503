# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A lens of a scene: its two faces, bare or with a hologram, and a black rim between them."""

import bpy
import numpy as np

from ...core.shapes import MeshShape, Plane
from ...core.shapes.tessellate import ellipse_mesh
from ...core.units import m_to_mm, mm_to_m
from ...model.scene_lens import FACES, Face, LensElement
from ..room import shapes as shapes
from ..shaders.materials import absorber_material, dielectric_material, hologram_material
from ..shaders.spectral import SpectralScene
from . import meshes
from .element import hologram_element

_RINGS = 40
"""From vertex to rim. The interpolated normal of a hemisphere is then off by less than 1e-4."""

_RIM_SIDES = 256


def add_lens(
    collection: bpy.types.Collection, element: LensElement, spectral: SpectralScene
) -> bpy.types.Object:
    """Add a lens.

    Args:
        collection: Where it is linked.
        element: The lens; its place is set by the caller.
        spectral: The sampled spectrum of the scene; 1 scene unit is 1 mm.

    Returns:
        The rim; the faces are its children.
    """
    rim = meshes.add(collection, _rim(element), absorber_material(f"{element.name} Rim"))
    for face in FACES:
        _add_face(collection, element, face, spectral, rim)
    return rim


def _add_face(
    collection: bpy.types.Collection,
    element: LensElement,
    face: Face,
    spectral: SpectralScene,
    rim: bpy.types.Object,
) -> None:
    name = f"{element.name} {face}"
    place = (0.0, 0.0, element.vertex_z_mm(face))
    hologram = element.hologram(face)
    if hologram is None:
        material = dielectric_material(name, element.medium, element.outside, spectral)
        mesh = meshes.smooth(name, _outward(element, face), m_to_mm(1.0))
        meshes.add(collection, mesh, material, parent=rim, location=place)
    else:
        material = hologram_material(hologram, spectral)
        hologram_element(collection, hologram, material, parent=rim, location=place)


def _outward(element: LensElement, face: Face) -> MeshShape:
    """Facets of a face, in metres, with normals that point out of the lens."""
    shape = element.face(face).surface(element.diameter_mm).core_shape()
    diameter = mm_to_m(element.diameter_mm)
    mesh = ellipse_mesh(shape, diameter, diameter, 1 if isinstance(shape, Plane) else _RINGS)
    if face == "front":
        return mesh
    return MeshShape(mesh.vertices, mesh.faces[:, ::-1], -mesh.normals)


def _rim(element: LensElement) -> bpy.types.Mesh:
    radius = 0.5 * element.diameter_mm
    low, high = (float(element.sag_mm(face, np.asarray(radius))) for face in ("back", "front"))
    return shapes.lathe([(radius, low), (radius, high)], _RIM_SIDES).mesh(f"{element.name} Rim")
