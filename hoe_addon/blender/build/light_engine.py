# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light engine: a display, its collimating lens, and the black housing around both."""

import bpy
import numpy as np

from ...core.spectrum import Spectrum
from ...model.device_parts import DisplaySpec, LensSpec
from ...model.device_surfaces import HOUSING_MARGIN_MM
from ..shaders.materials import absorber_material, display_material, thin_lens_material
from ..shaders.spectral import SpectralScene
from . import meshes

_HOUSING_SIDES = 64


def add_light_engine(
    collection: bpy.types.Collection,
    display: DisplaySpec,
    lens: LensSpec,
    image: bpy.types.Image,
    primaries: tuple[Spectrum, Spectrum, Spectrum],
    white_luminance: float,
    spectral: SpectralScene,
    parent: bpy.types.Object,
) -> bpy.types.Object:
    """Add display, lens and housing; light leaves along -z of the parent.

    Args:
        collection: Where they are linked.
        display: The display; 1 scene unit is 1 mm.
        lens: The lens; its plane goes through the origin of the parent.
        image: Picture on the display.
        primaries: Spectra of red, green and blue, the first emitters of ``spectral``.
        white_luminance: Luminance of white in scene units.
        spectral: The sampled spectrum of the scene.
        parent: Object whose frame the engine is in.

    Returns:
        The display, in the focal plane of the lens, its front toward the lens.
    """
    focal = lens.focal_length_mm
    meshes.add(
        collection,
        meshes.disk("Lens", lens.diameter_mm),
        thin_lens_material(focal),
        parent=parent,
    )
    panel = meshes.add(
        collection,
        _panel_mesh(display),
        display_material(image, primaries, display.white, white_luminance, spectral),
        parent=parent,
        location=(0.0, 0.0, focal),
    )
    panel.lightgroup = "display"
    widest = max(lens.diameter_mm, float(np.hypot(*display.size_mm)))
    meshes.add(
        collection,
        _housing_mesh(lens.diameter_mm / 2.0, widest / 2.0 + HOUSING_MARGIN_MM, focal),
        absorber_material("Housing"),
        parent=parent,
    )
    return panel


def _panel_mesh(display: DisplaySpec) -> bpy.types.Mesh:
    """A rectangle whose front is -z, its picture upright for an eye behind a light guide.

    The lens sends a pixel at (x, y) into the direction (-x, -y, -f). The guide keeps the first
    two and turns the third, so an eye that looks along -z sees it in the direction (x, y, -f).
    """
    width, height = display.size_mm
    x, y = width / 2.0, height / 2.0
    corners = [(-x, -y, 0.0), (-x, y, 0.0), (x, y, 0.0), (x, -y, 0.0)]
    mesh = meshes.from_polygons("Display", corners, [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name="UVMap")
    uv = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)]
    layer.uv.foreach_set("vector", np.asarray(uv, dtype=np.float32).ravel())
    return mesh


def _housing_mesh(lens_radius: float, radius: float, length: float) -> bpy.types.Mesh:
    """A can around lens and display, open at the lens: no light enters but through it."""
    angle = np.arange(_HOUSING_SIDES) * (2.0 * np.pi / _HOUSING_SIDES)
    circle = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    back = length + HOUSING_MARGIN_MM
    rings = ((lens_radius, 0.0), (radius, 0.0), (radius, back))
    corners = [(r * x, r * y, z) for r, z in rings for x, y in circle]
    polygons: list[tuple[int, ...]] = []
    for ring in range(len(rings) - 1):
        for k in range(_HOUSING_SIDES):
            following = (k + 1) % _HOUSING_SIDES
            base, above = ring * _HOUSING_SIDES, (ring + 1) * _HOUSING_SIDES
            polygons.append((base + k, base + following, above + following, above + k))
    last = (len(rings) - 1) * _HOUSING_SIDES
    polygons.append(tuple(last + k for k in range(_HOUSING_SIDES)))
    return meshes.from_polygons("Housing", corners, polygons)
