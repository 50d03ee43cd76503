# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms on objects that are turned, mirrored, unevenly scaled and sheared by their parents."""

import numpy as np
import pytest

from hoe_addon.core.orders import Branch
from tests.hard_cases.mapped_rays import PLANE, RECORDING, SPHERE, Element, exactly, in_numpy
from tests.hard_cases.ray_scene import Floats, float32, ray_scene

RAYS = 200

DIRECTION = 6e-7
"""rad times the cosine against the normal: some ten roundings of float32, in the matrix, the
normal, the hit and the ray law, each of 6e-8."""

ROUNDING = 1e-12
"""numpy: a hundred roundings of float64, over a cosine of at least 0.05 squared."""


def turned(about_x: float, about_y: float, about_z: float) -> Floats:
    """Rotations by these angles in radians, the one about x first."""
    matrix = np.eye(4)
    for axis, angle in enumerate((about_x, about_y, about_z)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(4)
        step[first, first] = step[second, second] = np.cos(angle)
        step[second, first], step[first, second] = np.sin(angle), -np.sin(angle)
        matrix = step @ matrix
    return matrix


def scaled(x: float, y: float, z: float) -> Floats:
    return np.diag((x, y, z, 1.0))


def moved(x: float, y: float, z: float) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


TURN, OTHER = turned(0.5, -0.8, 2.0), turned(-1.1, 0.3, 0.7)
STRETCH = scaled(1.5, 0.5, 0.8)

PLACED: dict[str, tuple[Floats, ...]] = {
    "as it is": (np.eye(4),),
    "turned and moved": (moved(12.0, -7.0, 3.0) @ TURN,),
    "mirrored": (TURN @ scaled(-1.0, 1.0, 1.0),),
    "inside out": (TURN @ scaled(-1.0, -1.0, -1.0),),
    "mirrored through its plane": (TURN @ scaled(1.0, 1.0, -1.0),),
    "a thousandth": (TURN @ scaled(1e-3, 1e-3, 1e-3),),
    "a thousand times": (TURN @ scaled(1e3, 1e3, 1e3),),
    "unevenly scaled": (TURN @ STRETCH,),
    "sheared by its parent": (TURN, STRETCH),
    "sheared by two parents": (TURN, STRETCH, OTHER @ scaled(0.7, 1.0, 1.4)),
    "sheared and mirrored": (TURN, STRETCH @ scaled(-1.0, 1.0, 1.0), OTHER),
}
SURFACES = {"plane": PLANE, "sphere": SPHERE}
BRANCHES = {"transmitted": Branch(1), "reflected": Branch(-1, reflected=True)}


def composed(placed: tuple[Floats, ...]) -> Floats:
    matrix = np.eye(4)
    for part in placed:
        matrix = part @ matrix
    return matrix


def rays_to(matrix: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Rays to places on the element, from both sides, as float32 has them; in the world."""
    place = np.column_stack((rng.uniform(-8.0, 8.0, (RAYS, 2)), np.zeros(RAYS)))
    tilt = np.tan(np.radians(rng.uniform(0.0, 45.0, RAYS)))
    azimuth = rng.uniform(0.0, 2.0 * np.pi, RAYS)
    side = np.where(rng.random(RAYS) < 0.5, -1.0, 1.0)
    inside = np.column_stack((tilt * np.cos(azimuth), tilt * np.sin(azimuth), side))
    origin = (place - 4.0 * inside) @ matrix[:3, :3].T + matrix[:3, 3]
    direction = inside @ matrix[:3, :3].T
    return float32(origin), float32(direction / np.linalg.norm(direction, axis=1)[:, None])


def misses(found: Floats, right: Floats, matrix: Floats) -> Floats:
    """Angle between directions, times their cosine against the mapped plane."""
    upward = np.array((0.0, 0.0, 1.0)) @ np.linalg.inv(matrix[:3, :3])
    cosine = np.abs(right @ (upward / np.linalg.norm(upward)))
    return np.linalg.norm(found - right, axis=1) * cosine


@pytest.mark.parametrize("branch", BRANCHES)
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("name", PLACED)
def test_numpy(name: str, surface: str, branch: str, rng: np.random.Generator) -> None:
    element = Element(SURFACES[surface], RECORDING, BRANCHES[branch])
    matrix = composed(PLACED[name])
    rays = (values[:40] for values in rays_to(matrix, rng))
    origin, direction = rays
    right = exactly(element, matrix, origin, direction)
    found = in_numpy(element, matrix, origin, direction)
    met = np.isfinite(right[:, 0])
    assert met.sum() > 10
    assert misses(found, right, matrix)[met].max() < ROUNDING


@pytest.mark.render
@pytest.mark.parametrize(
    "branch", ["transmitted", pytest.param("reflected", marks=pytest.mark.slow)]
)
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("name", PLACED)
def test_cycles(name: str, surface: str, branch: str, rng: np.random.Generator) -> None:
    element = Element(SURFACES[surface], RECORDING, BRANCHES[branch])
    origin, direction = rays_to(composed(PLACED[name]), rng)
    with ray_scene() as scene:
        item = element.in_cycles(scene, PLACED[name])
        # The matrix that Blender composes, in float32, is the one that Cycles has.
        matrix = np.array(item.matrix_world, dtype=np.float64)
        np.testing.assert_allclose(matrix, composed(PLACED[name]), rtol=1e-5, atol=1e-5)
        found = scene.leave(origin, direction)
    right = exactly(element, matrix, origin, direction)
    met = np.isfinite(right[:, 0])
    np.testing.assert_array_equal(np.isfinite(found.direction[:, 0]), met)
    assert misses(found.direction, right, matrix)[met].max() < DIRECTION
