# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What added elements do to light, in small renders."""

import math
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector

from hoe_addon.blender.add import bodies, elements, emitters, eye, hologram
from hoe_addon.blender.api import device_of, render_view
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.core.media import by_name
from hoe_addon.model.device_parts import EyeSpec
from hoe_addon.model.scene_spectra import LineSpec

LINE_NM = 532.0
LAMP_CD_M2 = 1000.0
INDEX = float(by_name("N-BK7").index(LINE_NM * 1e-9))
NOISE = 0.1
"""Of a mean over 64 pixels of 32 samples; the light is on all of them."""

type Point = tuple[float, float, float]


@pytest.fixture
def scene(registered: Any) -> Any:
    """An empty scene in millimetres, for small pictures."""
    registered.unit_settings.scale_length = 1e-3
    registered.render.resolution_x = registered.render.resolution_y = 8
    registered.cycles.samples = 32
    return registered


def look(scene: Any, place: Point, target: Point) -> None:
    """Put a sharp eye of a narrow field somewhere."""
    ahead = Vector(target) - Vector(place)
    turn = ahead.to_track_quat("-Z", "Y").to_matrix().to_4x4()
    spec = EyeSpec(pupil_diameter_mm=0.01, field_deg=0.2)
    eye.give_eye(scene, spec, Matrix.Translation(place) @ turn)


def lamp(scene: Any, *place: float, diameter: float = 4.0) -> None:
    """Put a green laser lamp somewhere; it shines all around."""
    light = LineSpec(centre_nm=LINE_NM, fwhm_nm=1.0)
    size = (diameter, diameter)
    emitters.add_lamp(scene, "sphere", size, LAMP_CD_M2, light, elements.upright(place))


def seen(scene: Any) -> float:
    """Mean luminance of the picture over that of the lamp."""
    picture = render_view(device_of(scene)).picture
    unit = scene.hologram.render.luminance_per_unit_cd_m2
    return float((picture @ (0.2126, 0.7152, 0.0722)).mean() * unit / LAMP_CD_M2)


@pytest.mark.render
def test_plate_diffracts(scene: Any) -> None:
    """A lens of 100 mm brings a ray that comes parallel to its axis to the focus."""
    hologram.add_hologram(scene, matrix=elements.upright((0.0, 100.0, 0.0)))
    lamp(scene, 0.0, 200.0, 0.0)
    look(scene, (10.0, 0.0, 0.0), (10.0, 1.0, 0.0))
    assert seen(scene) > 0.8


@pytest.mark.render
def test_faces_diffract_and_their_neighbours_do_not(scene: Any) -> None:
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4, size=80.0)
    grid = bpy.context.object
    grid.matrix_world = elements.upright((0.0, 100.0, 0.0))
    bpy.context.view_layer.update()
    middle = [face.index for face in grid.data.polygons if face.center.xy.length < 20.0]
    assert len(middle) == 4
    material, _ = hologram.hologram_on_faces(scene, grid, middle)
    assert tuple(material.hologram.surface.size_mm) == pytest.approx((40.0, 40.0))
    lamp(scene, 0.0, 200.0, 0.0)
    look(scene, (10.0, 0.0, 0.0), (10.0, 1.0, 0.0))
    assert seen(scene) > 0.8
    scene.hologram.eye.camera.location.x = 30.0
    assert seen(scene) < 0.01


@pytest.mark.render
def test_slab_shifts_a_ray(scene: Any) -> None:
    thick, angle = 10.0, math.radians(45.0)
    slow = math.cos(angle) / math.sqrt(INDEX**2 - math.sin(angle) ** 2)
    shift = thick * math.sin(angle) * (1.0 - slow)
    turned = Matrix.Rotation(angle, 4, "Z")
    place = Matrix.Translation((0.0, 100.0, 0.0)) @ turned @ elements.upright()
    bodies.add_slab(scene, (50.0, 30.0), thick, "N-BK7", place)
    for side in (-1.0, 1.0):
        lamp(scene, side * shift, 200.0, 0.0, diameter=2.0)
    look(scene, (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert seen(scene) == pytest.approx(0.9, abs=NOISE)
    bpy.data.objects.remove(scene.objects["Slab"])
    assert seen(scene) < 0.01


@pytest.mark.render
def test_ideal_lens_bends_a_ray(scene: Any) -> None:
    bodies.add_ideal_lens(scene, 100.0, 30.0, elements.upright((0.0, 100.0, 0.0)))
    lamp(scene, 0.0, 200.0, 0.0)
    look(scene, (10.0, 0.0, 0.0), (10.0, 1.0, 0.0))
    assert seen(scene) == pytest.approx(1.0, abs=NOISE)


@pytest.mark.render
def test_prism_deviates_least(scene: Any) -> None:
    """At the least deviation of a prism of 60 degrees the ray inside is parallel to its base."""
    half = math.asin(INDEX / 2.0) - math.radians(30.0)
    # Its corner to +x, its edges upright.
    turned = Matrix.Rotation(math.radians(90.0), 4, "Z") @ elements.upright()
    bodies.add_glass(scene, "prism", 30.0, "N-BK7", Matrix.Translation((0.0, 100.0, 0.0)) @ turned)
    aside = -90.0 * math.tan(half)
    lamp(scene, -100.0 * math.tan(half), 210.0, 0.0)
    look(scene, (aside, 0.0, 0.0), (0.0, 90.0, 0.0))
    assert seen(scene) == pytest.approx(0.87, abs=NOISE)


@pytest.mark.render
def test_ball_refracts(scene: Any) -> None:
    bodies.add_glass(scene, "ball", 30.0, "N-BK7", elements.upright((0.0, 100.0, 0.0)))
    lamp(scene, 0.0, 100.0 + 15.0 * INDEX / (2.0 * (INDEX - 1.0)), 0.0, diameter=0.4)
    look(scene, (1.0, 0.0, 0.0), (1.0, 1.0, 0.0))
    assert seen(scene) == pytest.approx(0.92, abs=NOISE)


@pytest.mark.render
def test_display_is_seen_in_its_colours(scene: Any) -> None:
    spec = emitters.plain_display("white", (64.0, 36.0), 500.0)
    emitters.add_display(scene, spec, elements.upright((0.0, 100.0, 0.0)))
    scene.cycles.samples = 256
    look(scene, (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    colour = render_view(device_of(scene)).picture.mean(axis=(0, 1))
    assert colour == pytest.approx(np.full(3, 5.0), rel=0.05)


@pytest.mark.render
def test_display_has_colours_without_an_eye(scene: Any) -> None:
    """The user's own camera, before there is an eye: the preview."""
    spec = emitters.plain_display("reticle", (64.0, 64.0), 500.0)
    emitters.add_display(scene, spec, elements.upright((0.0, 100.0, 0.0)))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    camera.matrix_world = elements.upright()
    scene.camera = camera
    red, green, blue = render_layers(scene, [COMBINED])[COMBINED].mean(axis=(0, 1))
    assert red > 0.01
    assert max(green, blue) < 0.1 * red


@pytest.mark.render
def test_eye_sees_a_scene_without_elements(scene: Any) -> None:
    """A white lamp of the user's own, through a lens; every path draws a wavelength."""
    bodies.add_ideal_lens(scene, 100.0, 30.0, elements.upright((0.0, 50.0, 0.0)))
    look(scene, (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    bpy.ops.mesh.primitive_plane_add(size=100.0)
    bpy.context.object.matrix_world = elements.upright((0.0, 100.0, 0.0))
    paint = bpy.data.materials.new("Paint")
    glow = paint.node_tree.nodes["Principled BSDF"].inputs
    glow["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    glow["Emission Color"].default_value = (1.0, 0.5, 0.25, 1.0)
    glow["Emission Strength"].default_value = 1.0
    bpy.context.object.data.materials.append(paint)
    scene.cycles.samples = 256
    colour = render_layers(scene, [COMBINED])[COMBINED].mean(axis=(0, 1))
    assert colour == pytest.approx(np.array((1.0, 0.5, 0.25)), rel=0.1)
