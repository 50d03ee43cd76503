# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture of the living room: sofa, lamp, side table, plant, picture."""

import bpy
import numpy as np

from ..build import meshes
from . import materials as materials
from . import shapes as shapes
from .lights import AMBIENT, add_ball_light

FLOOR = -1150.0
"""Height of the floor in scene units: the eyes of someone who sits."""

WALL = 4400.0
"""Distance of the wall opposite."""

_SEED = 5
_WARM: materials.Colour = (1.0, 0.72, 0.44)
_LAMP = (955.0, 4080.0)
_SHADE = (235.0, 495.0)
"""Lower and upper edge of the lampshade."""


def add_sofa(collection: bpy.types.Collection) -> None:
    """Add a two-seater below the middle of the view, and its cushions."""
    cloth = materials.mottled(
        "Sofa Cloth", ((0.19, 0.20, 0.21), (0.27, 0.28, 0.29)), (9.0, 9.0, 9.0)
    )
    seat, top, half = FLOOR + 430.0, FLOOR + 800.0, 690.0
    parts = [
        shapes.rounded_box((2 * half, 800.0, 200.0), 40.0).moved(0.0, 3900.0, seat - 200.0),
        shapes.rounded_box((2 * half, 190.0, 560.0), 70.0).moved(0.0, 4240.0, top - 280.0),
    ]
    for side in (-1.0, 1.0):
        arm = shapes.rounded_box((170.0, 830.0, 420.0), 65.0)
        parts.append(arm.moved(side * half, 3900.0, seat - 50.0))
        cushion = shapes.rounded_box((590.0, 700.0, 160.0), 60.0, 22.0)
        parts.append(cushion.moved(side * 300.0, 3860.0, seat - 50.0))
        rest = shapes.rounded_box((580.0, 190.0, 430.0), 75.0, 30.0).turned("x", -10.0)
        parts.append(rest.moved(side * 300.0, 4090.0, seat + 205.0))
    mesh = shapes.joined(parts).mesh("Sofa", smooth=True)
    meshes.add(collection, mesh, cloth)
    _add_cushions(collection, seat + 30.0)


def _add_cushions(collection: bpy.types.Collection, seat: float) -> None:
    colours: list[tuple[materials.Colour, materials.Colour]] = [
        ((0.42, 0.21, 0.045), (0.50, 0.27, 0.07)),
        ((0.46, 0.43, 0.38), (0.56, 0.53, 0.47)),
        ((0.045, 0.13, 0.14), (0.07, 0.18, 0.19)),
    ]
    places = [
        (-445.0, 3945.0, -18.0, 9.0),
        (-165.0, 3965.0, -15.0, -6.0),
        (410.0, 3940.0, -17.0, -11.0),
    ]
    for number, (colour, (x, y, lean, twist)) in enumerate(zip(colours, places, strict=True)):
        body = shapes.pillow(430.0, 400.0, 170.0).turned("y", twist).turned("x", lean)
        mesh = body.mesh(f"Cushion {number + 1}", smooth=True)
        cloth = materials.mottled(mesh.name, colour, (14.0, 14.0, 14.0))
        meshes.add(collection, mesh, cloth, location=(x, y, seat + 190.0))


def add_lamp(collection: bpy.types.Collection, white: float) -> None:
    """Add a floor lamp with a warm light.

    Args:
        collection: Where it is linked.
        white: Radiance that its strength refers to.
    """
    x, y = _LAMP
    low, high = _SHADE
    brass = materials.polished("Brass", (0.50, 0.36, 0.17), 0.45, 1.0)
    rod = shapes.tube(np.asarray([(0.0, 0.0, FLOOR), (0.0, 0.0, high)]), 9.0)
    foot = shapes.lathe([(150.0, FLOOR), (150.0, FLOOR + 15.0), (10.0, FLOOR + 30.0)])
    mesh = shapes.joined([rod, foot]).mesh("Lamp Stand", smooth=True)
    meshes.add(collection, mesh, brass, location=(x, y, 0.0))
    shade = shapes.lathe([(205.0, low), (150.0, high)], 64).mesh("Lampshade", smooth=True)
    cloth = materials.glowing("Lampshade", _WARM, 0.34 * white)
    # The eye sees the shade; what it gives to the room comes from the ball inside it, which is one
    # light instead of many small faces, and so much less noisy.
    cloth.cycles.emission_sampling = "NONE"
    item = meshes.add(collection, shade, cloth, location=(x, y, 0.0))
    item.visible_diffuse = item.visible_shadow = False
    item.lightgroup = AMBIENT
    add_ball_light(collection, (x, y, (low + high) / 2.0), 110.0, _WARM, 2.6 * white)


def add_plant(collection: bpy.types.Collection) -> None:
    """Add a leafy plant in a pot on a round wooden stool, before the lamp."""
    x, y, top = 940.0, 3720.0, FLOOR + 430.0
    wood = materials.mottled("Stool", ((0.22, 0.12, 0.06), (0.33, 0.19, 0.10)), (30.0, 400.0, 30.0))
    board = shapes.lathe([(0.1, top - 28.0), (150.0, top - 28.0), (150.0, top), (0.1, top)])
    legs = [
        shapes.tube(
            np.asarray([(160.0 * c, 160.0 * s, FLOOR), (100.0 * c, 100.0 * s, top - 28.0)]), 15.0
        )
        for c, s in ((np.cos(a), np.sin(a)) for a in (0.5, 2.6, 4.7))
    ]
    meshes.add(collection, shapes.joined([board, *legs]).mesh("Stool"), wood, location=(x, y, 0.0))
    pot = shapes.lathe(
        [(85.0, 0.0), (118.0, 165.0), (122.0, 175.0), (108.0, 175.0), (104.0, 150.0), (0.1, 150.0)]
    )
    clay = materials.mottled("Pot", ((0.50, 0.47, 0.43), (0.58, 0.55, 0.50)), (40.0, 40.0, 12.0))
    meshes.add(collection, pot.mesh("Pot"), clay, location=(x, y, top))
    green = materials.mottled(
        "Leaves", ((0.025, 0.085, 0.028), (0.06, 0.17, 0.05)), (90.0, 90.0, 90.0)
    )
    meshes.add(
        collection, _leaves().mesh("Plant", smooth=True), green, location=(x, y, top + 150.0)
    )


def _leaves() -> shapes.Shape:
    """Stems that arch outward from the origin, each with one leaf."""
    rng = np.random.default_rng(_SEED)
    parts: list[shapes.Shape] = []
    along = np.linspace(0.0, 1.0, 8)
    for number in range(22):
        height = 120.0 + 300.0 * (1.0 - number / 22.0) + rng.uniform(0.0, 60.0)
        reach = rng.uniform(50.0, 110.0) + 70.0 * number / 22.0
        path = np.stack((reach * along**2, 0.0 * along, height * along), axis=1)
        leaf = _leaf(rng.uniform(170.0, 240.0), rng.uniform(85.0, 115.0)).turned(
            "x", rng.uniform(-25.0, 25.0)
        )
        leaf = leaf.turned("y", rng.uniform(-50.0, 5.0)).moved(reach, 0.0, height)
        heading = 137.5 * number
        parts += [shapes.tube(path, 3.5, 6).turned("z", heading), leaf.turned("z", heading)]
    return shapes.joined(parts)


def _leaf(length: float, width: float) -> shapes.Shape:
    """An oval leaf along +x that droops and is folded at its midrib."""
    u, v = np.meshgrid(np.linspace(0.0, 1.0, 10), np.linspace(-1.0, 1.0, 5))
    half = 0.5 * width * np.sin(np.pi * u**0.8) ** 0.75
    droop = -0.35 * length * u**2.2 + 0.28 * half * np.abs(v)
    return shapes.grid(np.stack((length * u, half * v, droop), axis=-1))


def add_picture(collection: bpy.types.Collection) -> None:
    """Add a framed print over the sofa: hills before a low sun."""
    centre, half_x, half_z, rim = (-90.0, 650.0), 330.0, 205.0, 18.0
    bars = [
        ((-half_x, -half_z), (half_x, rim - half_z)),
        ((-half_x, half_z - rim), (half_x, half_z)),
        ((-half_x, rim - half_z), (rim - half_x, half_z - rim)),
        ((half_x - rim, rim - half_z), (half_x, half_z - rim)),
    ]
    frame = shapes.joined([shapes.box((a, -26.0, b), (c, 0.0, d)) for (a, b), (c, d) in bars])
    place = (centre[0], WALL, centre[1])
    oak = materials.mottled("Frame", ((0.20, 0.11, 0.05), (0.30, 0.17, 0.09)), (60.0, 60.0, 8.0))
    meshes.add(collection, frame.mesh("Picture Frame"), oak, location=place)
    card = shapes.box((rim - half_x, -4.0, rim - half_z), (half_x - rim, 0.0, half_z - rim))
    meshes.add(
        collection,
        card.mesh("Passe-partout"),
        materials.matte("Card", (0.62, 0.60, 0.56)),
        location=place,
    )
    _add_print(collection, place, 240.0, 125.0)


def _add_print(
    collection: bpy.types.Collection,
    place: tuple[float, float, float],
    half_x: float,
    half_z: float,
) -> None:
    """Sheets of colour, each a little before the last."""
    x = np.linspace(-half_x, half_x, 41)
    ridges = [
        (half_z + 0.0 * x, (0.52, 0.36, 0.25)),
        (4.0 + 26.0 * np.sin(x / 62.0 + 0.4) + 8.0 * np.sin(x / 19.0), (0.33, 0.19, 0.14)),
        (-28.0 + 24.0 * np.sin(x / 75.0 + 2.6) + 4.0 * np.sin(x / 23.0), (0.12, 0.13, 0.13)),
        (-72.0 + 20.0 * np.sin(x / 90.0 + 4.4), (0.035, 0.065, 0.075)),
    ]
    for number, (ridge, colour) in enumerate(ridges):
        rows = np.stack((np.full_like(x, -half_z), ridge))
        points = np.stack((np.stack((x, x)), np.full_like(rows, -5.0 - number), rows), axis=-1)
        mesh = shapes.grid(points).mesh(f"Print {number + 1}")
        meshes.add(collection, mesh, materials.matte(mesh.name, colour), location=place)
    sun = shapes.lathe([(0.1, 0.0), (40.0, 0.0)]).turned("x", 90.0).moved(85.0, -5.5, 58.0)
    meshes.add(
        collection,
        sun.mesh("Print Sun"),
        materials.matte("Print Sun", (0.72, 0.55, 0.34)),
        location=place,
    )
