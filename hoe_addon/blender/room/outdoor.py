# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Backdrops under the sky: open land with a target at 50 m, and a road seen from a car."""

import math

import bpy
import numpy as np

from ..build import meshes
from ..shaders import nodes
from . import materials as materials
from . import shapes as shapes
from .lights import AMBIENT

_SUN_SHARE, _SKY_SHARE = 0.6, 0.4
_CARD_SHARE = 0.67
"""Luminance of an upright white card before the eye, of that of one square to the sun."""

_SUN_TURN = (math.radians(50.0), 0.0, math.radians(-35.0))
_HORIZON: materials.Colour = (0.95, 0.98, 1.0)
_ZENITH: materials.Colour = (0.30, 0.52, 0.95)
_EYE_HEIGHT, _SEAT_HEIGHT = 1500.0, 1200.0
_TARGET_AT, _TARGET_RADIUS = 50_000.0, 500.0
_FAR = 400_000.0
_SEED = 11


def add_range(scene: bpy.types.Scene, collection: bpy.types.Collection, white: float) -> None:
    """Add a meadow with hills, trees, and a round target of 1 m at 50 m.

    Args:
        scene: The scene, which gets a sky.
        collection: Where its objects are linked.
        white: Scene-linear value of white in the sun.
    """
    _add_sky(scene, collection, white / _CARD_SHARE)
    grass = materials.mottled(
        "Grass", ((0.045, 0.10, 0.022), (0.10, 0.15, 0.04)), (2500.0, 6000.0, 2500.0)
    )
    _add_ground(collection, -_EYE_HEIGHT, grass)
    _add_hills(collection, -_EYE_HEIGHT)
    _add_trees(collection, -_EYE_HEIGHT, nearest=60_000.0, clear=9000.0)
    rings = [(1.0, (0.75, 0.75, 0.72)), (0.72, (0.03, 0.03, 0.03))]
    rings += [(0.46, (0.75, 0.75, 0.72)), (0.22, (0.03, 0.03, 0.03))]
    for number, (share, colour) in enumerate(rings):
        disk = meshes.disk(f"Target {number + 1}", 2.0 * share * _TARGET_RADIUS)
        item = meshes.add(collection, disk, materials.matte(disk.name, colour))
        item.location = (0.0, _TARGET_AT - 30.0 * number, 0.0)
        item.rotation_euler = (math.radians(90.0), 0.0, 0.0)
    wood = materials.matte("Post", (0.12, 0.075, 0.04))
    posts = [
        shapes.box(
            (x - 60.0, _TARGET_AT + 30.0, -_EYE_HEIGHT), (x + 60.0, _TARGET_AT + 150.0, 450.0)
        )
        for x in (-330.0, 330.0)
    ]
    meshes.add(collection, shapes.joined(posts).mesh("Posts"), wood)


def add_road(scene: bpy.types.Scene, collection: bpy.types.Collection, white: float) -> None:
    """Add a road to the horizon, fields beside it, a car ahead, and the own car's bonnet.

    Args:
        scene: The scene, which gets a sky.
        collection: Where its objects are linked.
        white: Scene-linear value of white in the sun.
    """
    _add_sky(scene, collection, white)
    ground = -_SEAT_HEIGHT
    field = materials.mottled(
        "Fields", ((0.07, 0.12, 0.03), (0.14, 0.16, 0.05)), (9000.0, 20000.0, 2500.0)
    )
    _add_ground(collection, ground, field)
    asphalt = materials.mottled(
        "Asphalt", ((0.060, 0.062, 0.066), (0.078, 0.080, 0.084)), (900.0, 4000.0, 900.0)
    )
    lane = shapes.box((-5600.0, -5000.0, ground), (1900.0, _FAR, ground + 20.0))
    meshes.add(collection, lane.mesh("Road"), asphalt)
    paint = materials.matte("Road Paint", (0.72, 0.72, 0.70))
    marks = [
        shapes.box((x - 75.0, -5000.0, ground), (x + 75.0, 250_000.0, ground + 30.0))
        for x in (-5300.0, 1600.0)
    ]
    marks += [
        shapes.box((-1925.0, start, ground), (-1775.0, start + 4000.0, ground + 30.0))
        for start in np.arange(2000.0, 250_000.0, 12_000.0)
    ]
    meshes.add(collection, shapes.joined(marks).mesh("Lines"), paint)
    _add_hills(collection, ground)
    _add_trees(collection, ground, nearest=25_000.0, clear=12_000.0)
    _add_car(collection, ground)
    _add_bonnet(collection)


def _add_sky(scene: bpy.types.Scene, collection: bpy.types.Collection, white: float) -> None:
    """A sun from behind on the right, and a sky that is bluer higher up."""
    light = bpy.data.lights.new("Sun", "SUN")
    # A white card square to the sun has the radiance strength / pi.
    light.energy = math.pi * _SUN_SHARE * white
    light.color = (1.0, 0.96, 0.88)
    light.angle = math.radians(1.0)
    sun = bpy.data.objects.new("Sun", light)
    sun.rotation_euler = _SUN_TURN
    sun.lightgroup = AMBIENT
    collection.objects.link(sun)
    world = bpy.data.worlds.new("Sky")
    scene.world = world
    world.lightgroup = AMBIENT
    tree = nodes.new_tree(world)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    glow = tree.nodes.new("ShaderNodeBackground")
    glow.inputs["Strength"].default_value = 2.0 * _SKY_SHARE * white
    place = tree.nodes.new("ShaderNodeTexCoord")
    height = tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    low, high = ramp.color_ramp.elements
    low.position, low.color = 0.0, (*_HORIZON, 1.0)
    high.position, high.color = 0.5, (*_ZENITH, 1.0)
    tree.links.new(place.outputs["Generated"], height.inputs[0])
    tree.links.new(height.outputs["Z"], ramp.inputs[0])
    tree.links.new(ramp.outputs["Color"], glow.inputs["Color"])
    tree.links.new(glow.outputs["Background"], output.inputs["Surface"])


def _add_ground(
    collection: bpy.types.Collection, height: float, material: bpy.types.Material
) -> None:
    mesh = meshes.rectangle("Ground", 4.0 * _FAR, 4.0 * _FAR)
    meshes.add(collection, mesh, material, location=(0.0, 0.0, height - 20.0))


def _add_hills(collection: bpy.types.Collection, ground: float) -> None:
    """Two ridges behind each other, the farther one paler."""
    for number, (distance, tall, colour) in enumerate(
        [(0.75 * _FAR, 24_000.0, (0.12, 0.17, 0.13)), (1.5 * _FAR, 60_000.0, (0.30, 0.38, 0.44))]
    ):
        x = np.linspace(-2.0, 2.0, 161)
        wave = 0.5 + 0.3 * np.sin(2.1 * x + 1.7 * number) + 0.12 * np.sin(7.3 * x + number)
        wave += 0.05 * np.sin(19.0 * x)
        low = np.stack((x * distance, 0.0 * x + distance, 0.0 * x + ground), axis=1)
        high = low + np.array((0.0, 0.2 * distance, 0.0))
        high[:, 2] += tall * wave
        mesh = shapes.grid(np.stack((low, high))).mesh(f"Hills {number + 1}")
        meshes.add(collection, mesh, materials.matte(mesh.name, colour))


def _add_trees(
    collection: bpy.types.Collection, ground: float, nearest: float, clear: float
) -> None:
    """Round trees on both sides; the middle stays clear."""
    rng = np.random.default_rng(_SEED)
    crown = shapes.lathe(
        [(0.0, 0.0), (0.34, 0.12), (0.50, 0.42), (0.42, 0.75), (0.20, 0.95), (0.0, 1.0)], 20
    )
    parts = []
    for _ in range(36):
        distance = nearest * (1.0 + 2.5 * rng.random())
        side = rng.choice((-1.0, 1.0))
        x = side * (clear + 0.55 * distance * rng.random())
        tall = 5500.0 + 4500.0 * rng.random()
        corners = crown.corners * (0.75 * tall, 0.75 * tall, tall)
        parts.append(shapes.Shape(corners, crown.faces).moved(x, distance, ground + 400.0))
    leaves = materials.mottled(
        "Leaves", ((0.02, 0.055, 0.015), (0.06, 0.10, 0.03)), (1400.0, 1400.0, 1400.0)
    )
    meshes.add(collection, shapes.joined(parts).mesh("Trees", smooth=True), leaves)


def _add_car(collection: bpy.types.Collection, ground: float) -> None:
    """A car ahead in the own lane, seen from behind."""
    red = materials.polished("Car Paint", (0.30, 0.02, 0.02), 0.45)
    dark = materials.matte("Car Glass", (0.015, 0.018, 0.02))
    lights = materials.matte("Tail Lights", (0.45, 0.01, 0.01))
    y = 32_000.0
    body = shapes.rounded_box((1750.0, 4000.0, 750.0), 120.0).moved(0.0, y, ground + 640.0)
    cabin = shapes.rounded_box((1500.0, 2200.0, 620.0), 180.0).moved(
        0.0, y + 100.0, ground + 1180.0
    )
    meshes.add(collection, shapes.joined([body, cabin]).mesh("Car", smooth=True), red)
    window = shapes.box((-600.0, y - 1030.0, ground + 1050.0), (600.0, y - 990.0, ground + 1380.0))
    wheels = [
        shapes.box((x - 120.0, y - 1500.0, ground), (x + 120.0, y - 900.0, ground + 500.0))
        for x in (-720.0, 720.0)
    ]
    meshes.add(collection, shapes.joined([window, *wheels]).mesh("Car Glass"), dark)
    lamps = [
        shapes.box((x - 150.0, y - 2030.0, ground + 700.0), (x + 150.0, y - 1980.0, ground + 850.0))
        for x in (-680.0, 680.0)
    ]
    meshes.add(collection, shapes.joined(lamps).mesh("Tail Lights"), lights)


def _add_bonnet(collection: bpy.types.Collection) -> None:
    """The own car's bonnet below the view."""
    paint = materials.polished("Bonnet", (0.035, 0.045, 0.075), 0.4)
    across, along = np.meshgrid(np.linspace(-1.0, 1.0, 33), np.linspace(0.0, 1.0, 17))
    height = -430.0 - 60.0 * across**2 - 230.0 * along**2
    points = np.stack((780.0 * across, 1300.0 + 1150.0 * along, height), axis=-1)
    # The driver sits on the left, beside the middle of the car.
    points[..., 0] += 370.0
    meshes.add(collection, shapes.grid(points).mesh("Bonnet", smooth=True), paint)
