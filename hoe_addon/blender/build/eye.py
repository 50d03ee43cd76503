# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The eye: a camera with a pupil, and the spectral filter in front of it."""

import math

import bpy

from ...model.device_parts import EyeSpec
from ..shaders.materials import filter_material
from ..shaders.spectral import SpectralScene
from . import meshes

_FILTER_DISTANCE = 0.5
_F_NUMBER = 0.2
_LEAST_MM = 100.0
"""Least focal length and sensor width. Blender takes neither below 1 mm, without a word, and a
measurement narrows the sensor to the display's field."""
_FAR = 1e7


def add_eye(
    collection: bpy.types.Collection,
    spec: EyeSpec,
    spectral: SpectralScene,
    parent: bpy.types.Object | None = None,
) -> bpy.types.Object:
    """Add a camera that is an eye: it looks along -z of its parent, with y up.

    Args:
        collection: Where it is linked.
        spec: Pupil, focus, field and place; 1 scene unit is 1 mm.
        spectral: The sampled spectrum of the scene.
        parent: Object whose frame the place is in.

    Returns:
        The camera object; the filter is its child, where paths draw wavelengths.
    """
    camera = bpy.data.cameras.new("Eye")
    set_pupil(camera, spec)
    eye = bpy.data.objects.new("Eye", camera)
    eye.location = spec.position_mm
    eye.parent = parent
    collection.objects.link(eye)
    if spectral.drawn:
        add_filter(collection, eye, spec, spectral)
    return eye


def set_pupil(camera: bpy.types.Camera, spec: EyeSpec, units_per_mm: float = 1.0) -> None:
    """Give a camera the field, the pupil and the focus of an eye.

    Blender's aperture is focal length over f-number. The focal length is chosen freely, in the
    camera's own millimetres, the f-number for the pupil, and the sensor for the field. Cycles takes
    lengths of a camera in scene units, whatever the scale of its object.

    Args:
        camera: The camera.
        spec: Pupil, focus and field.
        units_per_mm: Scene units in one mm where the camera stands.
    """
    # aperture radius (scene units) = focal length (mm) * 1e-3 / (2 * f-number)
    width = 2.0 * math.tan(math.radians(spec.field_deg) / 2.0)
    lens = max(spec.pupil_diameter_mm * _F_NUMBER * 1e3, _LEAST_MM, _LEAST_MM / width)
    camera.lens = lens
    camera.dof.aperture_fstop = lens * 1e-3 / (spec.pupil_diameter_mm * units_per_mm)
    camera.sensor_fit = "HORIZONTAL"
    camera.sensor_width = lens * width
    camera.dof.use_dof = True
    focus_mm = _FAR if spec.focus_mm is None else spec.focus_mm
    camera.dof.focus_distance = focus_mm * units_per_mm
    # Just before the spectral filter: nearer, and far hills would flicker.
    camera.clip_start = 0.8 * _FILTER_DISTANCE * units_per_mm
    camera.clip_end = _FAR


def add_filter(
    collection: bpy.types.Collection,
    eye: bpy.types.Object,
    spec: EyeSpec,
    spectral: SpectralScene,
) -> bpy.types.Object:
    """Add the spectral filter in front of a camera.

    Args:
        collection: Where it is linked.
        eye: The camera object.
        spec: Its pupil and field.
        spectral: The sampled spectrum of the scene.

    Returns:
        The filter, a child of the camera.
    """
    screen = meshes.add(
        collection,
        filter_mesh(spec),
        filter_material(spectral),
        parent=eye,
        location=(0.0, 0.0, -_FILTER_DISTANCE),
    )
    screen.visible_diffuse = screen.visible_glossy = screen.visible_transmission = False
    screen.visible_shadow = screen.visible_volume_scatter = False
    screen.hide_select = True
    screen.display_type = "WIRE"
    return screen


def filter_mesh(spec: EyeSpec) -> bpy.types.Mesh:
    """The plane of the spectral filter: square, for a picture up to twice as high as it is wide."""
    half = spec.pupil_diameter_mm / 2.0
    half += 2.5 * _FILTER_DISTANCE * math.tan(math.radians(spec.field_deg) / 2.0)
    return meshes.rectangle("Spectral Filter", 2.0 * half, 2.0 * half)
