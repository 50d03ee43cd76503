# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through a hologram whose object has any matrix: in 50 digits, in numpy, and in Cycles.

What is decided: places and the surface go with the object's matrix; the recording's directions are
components along unit axes at right angles, of which x is the mapped x axis and z the true normal of
the mapped plane z = 0. So the light at a point of the object is bent by the fringes recorded there,
whatever the object's scale, and a plane always acts as the plane that is seen.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from mpmath import mp, mpf

from hoe_addon.blender.build.element import hologram_element
from hoe_addon.blender.shaders import nodes
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.units import mm_to_m, nm_to_m
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.element import element_shape
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.shading.hologram import Frame, hologram_sockets, unit_efficiency_shader
from hoe_addon.shading.probe import first_hit_only
from tests.hard_cases import exact_rays
from tests.hard_cases.exact_rays import Vector
from tests.hard_cases.ray_scene import Floats, RayScene

NM = 600.0
RECORDING_NM = 532.0
BACK, FRONT = 1.5, 1.0

PLANE: dict[str, Any] = {"shape": "plane", "size_mm": [20, 20]}
SPHERE: dict[str, Any] = {"shape": "sphere", "size_mm": [20, 20], "radius_mm": 40}
RECORDING: dict[str, Any] = {
    "object": {"kind": "point", "position_mm": [6, 3, -60]},
    "reference": {"kind": "plane", "direction": [0.1, -0.05, 1]},
}


@dataclass(frozen=True)
class Element:
    """A hologram that lets all light go into one order.

    Attributes:
        surface: Its shape, a plane or a sphere.
        recording: Its two waves.
        branch: The order.
        scale: Factor on all lengths of the two above.
    """

    surface: dict[str, Any]
    recording: dict[str, Any]
    branch: Branch
    scale: float = 1.0

    @property
    def scaled_recording(self) -> dict[str, Any]:
        """The waves at their size."""
        return {
            role: {
                key: [self.scale * number for number in value] if key == "position_mm" else value
                for key, value in wave.items()
            }
            for role, wave in self.recording.items()
        }

    def spec(self) -> HologramSpec:
        """The hologram."""
        lengths = {"size_mm": [self.scale * side for side in self.surface["size_mm"]]}
        if "radius_mm" in self.surface:
            lengths["radius_mm"] = self.scale * self.surface["radius_mm"]
        side = "R" if self.branch.reflected else "T"
        return hologram_from(
            {
                "schema": 1,
                "name": "mapped",
                "surface": self.surface | lengths,
                "media": {"back": BACK, "front": FRONT},
                "recording": {"wavelength_nm": RECORDING_NM, **self.scaled_recording},
                "efficiency": {
                    "model": "constant",
                    "table": {side: {str(self.branch.order): 1.0}},
                },
                "orders": [self.branch.order],
            }
        )

    def material(self, units_per_mm: float = 1.0, *, once: bool = True) -> bpy.types.Material:
        """Its material, by which a ray that comes back goes straight on, or not."""
        spec = self.spec()
        source = unit_efficiency_shader(spec, self.branch)
        source = first_hit_only(source) if once else source
        values = hologram_sockets(spec, Frame(), units_per_mm) | {"wavelength_nm": NM}
        known = nodes.socket_names(source)
        values = {name: value for name, value in values.items() if name in known}
        return nodes.script_material("mapped", source, values)

    def in_cycles(
        self, scene: RayScene, placed: Sequence[Floats], units_per_mm: float = 1.0
    ) -> bpy.types.Object:
        """Put it into a scene.

        Args:
            scene: The scene.
            placed: Matrix of the object, and then of its parents, from the nearest on.
            units_per_mm: Scene units in one mm.
        """
        spec, material = self.spec(), self.material(units_per_mm)
        item = hologram_element(scene.scene.collection, spec, material, units_per_mm=units_per_mm)
        child = item
        for matrix in placed:
            # Blender takes matrices by columns, and makes turn, place and scale of this one.
            child.matrix_basis = matrix.T.tolist()
            parent = bpy.data.objects.new("parent", None)
            scene.scene.collection.objects.link(parent)
            child.parent = parent
            child = parent
        scene.scene.view_layers[0].update()
        return item


def exactly(element: Element, matrix: Floats, origin: Floats, direction: Floats) -> Floats:
    """Directions in the world in 50 digits; NaN where an order is evanescent.

    Args:
        element: The hologram; its lengths are in scene units.
        matrix: From its object to the world, shape ``(4, 4)``.
        origin: Starts of rays in the world, shape ``(n, 3)``.
        direction: Their directions, of any length, shape ``(n, 3)``.
    """
    with mp.workdps(exact_rays.DIGITS):
        map_ = mp.matrix(matrix.tolist())
        axes = [[map_[row, column] for row in range(3)] for column in range(3)]
        back = map_**-1
        rows = zip(origin.tolist(), direction.tolist(), strict=True)
        return np.array([_one(element, axes, back, start, way) for start, way in rows])


def _one(
    element: Element, axes: list[Vector], back: Any, start: list[float], way: list[float]
) -> list[float]:
    first = back * mp.matrix([*start, 1])
    step = back * mp.matrix([*way, 0])
    place = _hit(element, [first[i] for i in range(3)], [step[i] for i in range(3)])
    curvature = _curvature(element)
    upright = [-curvature * place[0], -curvature * place[1], 1 - curvature * place[2]]
    pairs = (_cross(axes[1], axes[2]), _cross(axes[2], axes[0]), _cross(axes[0], axes[1]))
    hand = 1 if exact_rays.along(pairs[2], axes[2]) > 0 else -1
    normal = exact_rays.unit(
        [hand * sum(upright[i] * pairs[i][k] for i in range(3)) for k in range(3)]
    )
    axis_x = exact_rays.unit(axes[0])
    axis_z = exact_rays.times(mpf(hand), exact_rays.unit(pairs[2]))
    frame = (axis_x, exact_rays.times(mpf(hand), _cross(axis_z, axis_x)), axis_z)
    recorded = exact_rays.gradient(element.scaled_recording, [float(value) for value in place])
    vector = [sum(recorded[i] * frame[i][k] for i in range(3)) for k in range(3)]
    east = exact_rays.unit(exact_rays.without(axis_x, normal))
    local = (east, _cross(normal, east), normal)
    heading = exact_rays.exact(way)
    _squared, found = exact_rays.diffracted(
        [exact_rays.along(heading, axis) for axis in local],
        [exact_rays.along(vector, axis) for axis in local],
        element.branch.order * mpf(NM) / mpf(RECORDING_NM),
        (BACK, FRONT),
        reflected=element.branch.reflected,
    )
    if found is None:
        return [np.nan] * 3
    return [float(sum(found[i] * local[i][k] for i in range(3))) for k in range(3)]


def _curvature(element: Element) -> mpf:
    radius = element.surface.get("radius_mm")
    return mpf(0) if radius is None else 1 / (mpf(radius) * mpf(element.scale))


def _hit(element: Element, start: Vector, way: Vector) -> Vector:
    """The hit nearest to the plane z = 0 on c (x^2 + y^2 + z^2) = 2 z."""
    curvature = _curvature(element)
    half = curvature * exact_rays.along(start, way) - way[2]
    rest = curvature * exact_rays.along(start, start) - 2 * start[2]
    root = mp.sqrt(half**2 - curvature * exact_rays.along(way, way) * rest)
    step = -rest / (half + root if half > 0 else half - root)
    return [a + step * b for a, b in zip(start, way, strict=True)]


def _cross(a: Vector, b: Vector) -> Vector:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def in_numpy(element: Element, matrix: Floats, origin: Floats, direction: Floats) -> Floats:
    """The same as `exactly` with the package's own shapes, patterns and ray law."""
    spec = element.spec()
    shape, linear, back = element_shape(spec), matrix[:3, :3], np.linalg.inv(matrix)
    inside = direction @ back[:3, :3].T
    inside /= np.linalg.norm(inside, axis=1)[:, None]
    start = mm_to_m(origin @ back[:3, :3].T + back[:3, 3])
    hit = start + shape.intersect(start, inside)[:, None] * inside
    normal = shape.normal(hit) @ np.linalg.inv(linear)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    upward = np.array((0.0, 0.0, 1.0)) @ np.linalg.inv(linear)
    axis_x, axis_z = linear[:, 0] / np.linalg.norm(linear[:, 0]), upward / np.linalg.norm(upward)
    axis_y = np.sign(np.linalg.det(linear)) * np.cross(axis_z, axis_x)
    vector = pattern_from(spec.pattern).gradient(hit) @ np.stack((axis_x, axis_y, axis_z))
    unit = direction / np.linalg.norm(direction, axis=1)[:, None]
    forward = np.sum(unit * normal, axis=1) >= 0.0
    found, status = diffract(
        unit,
        normal,
        vector,
        element.branch.order,
        nm_to_m(NM) / nm_to_m(RECORDING_NM),
        np.where(forward, BACK, FRONT),
        np.where(forward, FRONT, BACK),
        element.branch.reflected,
    )
    return np.where((status == Status.OK)[:, None], found, np.nan)
